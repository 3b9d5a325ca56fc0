//! A body that has yielded and spins.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Spin;

#[test]
fn gates_hold() {
    holds(&Spin::GIVEN);
}

/// A wrong angle breaks what says where the stress points and no more; a strain that is not there in a rigid body loads what
/// is on its yield surface, and breaks all.
#[test]
fn wrong_references_break_the_gates() {
    let far = Spin {
        reference_angle: 1.001,
        ..Spin::GIVEN
    };
    let verdict = far.judge(Size::Quick, &solve(&far));
    for gate in &verdict.gates {
        let sees = gate.name.contains("turned");
        assert_eq!(gate.passed(), !sees, "{}: {}", gate.name, gate.value);
    }
    let strained = Spin {
        strained: 1e-5,
        ..Spin::GIVEN
    };
    let verdict = strained.judge(Size::Quick, &solve(&strained));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
