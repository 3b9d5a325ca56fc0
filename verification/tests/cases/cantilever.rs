//! The cantilever under its weight.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Cantilever;

#[test]
fn gates_hold() {
    holds(&Cantilever::GIVEN);
}

/// A tenth more: four times the bound on the small swing; the large one is held by its length, and its history alone is
/// within 5 % still.
#[test]
fn a_wrong_reference_breaks_the_gates_on_the_tip() {
    let wrong = Cantilever {
        reference_gravity: 1.1,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 3, "{failing:?}");
    assert!(
        failing
            .iter()
            .all(|line| line.contains("tip") || line.contains("trough"))
    );
}
