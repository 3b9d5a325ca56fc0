//! The ball on a rigid plane.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::HertzSphere;

#[test]
fn gates_hold() {
    holds(&HertzSphere::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_the_gate_on_the_force() {
    let wrong = HertzSphere {
        reference_load: 1.02,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert!(
        failing.iter().any(|line| line.contains("force")),
        "{failing:?}"
    );
}
