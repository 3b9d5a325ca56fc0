//! The colliding rings.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Rings;

#[test]
fn gates_hold() {
    holds(&Rings::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_the_gates_on_the_impulse() {
    let wrong = Rings {
        reference_speed: 1.05,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 2, "{failing:?}");
    assert!(failing.iter().all(|line| line.contains("impulse")));
}
