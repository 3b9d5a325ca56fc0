//! The half disk on a rigid plane.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Hertz;

#[test]
fn gates_hold() {
    holds(&Hertz::GIVEN);
}

/// Twice the bound on the force; width and pressure follow its root.
#[test]
fn a_wrong_reference_breaks_the_gate_on_the_force() {
    let wrong = Hertz {
        reference_load: 1.03,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 1, "{failing:?}");
    assert!(failing[0].contains("contact force"), "{failing:?}");
}
