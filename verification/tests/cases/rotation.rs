//! The spinning block.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Rotation;

#[test]
fn gates_hold() {
    holds(&Rotation::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = Rotation {
        reference_spin: 1.02,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
