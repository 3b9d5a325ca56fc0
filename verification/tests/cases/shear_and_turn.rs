//! Stress under prescribed shear and rotation.

use super::{holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::ShearAndTurn;

#[test]
fn gates_hold() {
    holds(&ShearAndTurn::GIVEN);
}

/// A stiffness that is off breaks what is in proportion to it; the other rate breaks every closed form.
#[test]
fn wrong_references_break_the_gates() {
    let stiff = ShearAndTurn {
        reference_stiffness: 1.05,
        ..ShearAndTurn::GIVEN
    };
    let verdict = stiff.judge(Size::Quick, &solve(&stiff));
    for gate in verdict.gates.iter().filter(|g| g.name.contains("shear,")) {
        let sees = gate.name.contains("off by") || gate.name.contains("closed form");
        assert!(!sees || !gate.passed(), "{}: {}", gate.name, gate.value);
    }
    let exchanged = ShearAndTurn {
        reference_exchanged: true,
        ..ShearAndTurn::GIVEN
    };
    let verdict = exchanged.judge(Size::Quick, &solve(&exchanged));
    for gate in verdict
        .gates
        .iter()
        .filter(|g| g.name.contains("closed form"))
    {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}
