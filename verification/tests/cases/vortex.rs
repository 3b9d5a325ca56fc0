//! The generalized vortex.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Vortex;

#[test]
fn gates_hold() {
    holds(&Vortex::GIVEN);
}

/// Twice the bound on the displacement of 12 cells.
#[test]
fn a_wrong_reference_breaks_every_gate_on_the_displacement() {
    let wrong = Vortex {
        reference_angle: 1.06,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in verdict
        .gates
        .iter()
        .filter(|g| g.name.contains("error of L2(u)"))
    {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
    assert!(failing(&verdict).len() >= 4);
}
