//! Spin by the impulse of friction.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::SpinningCollision;

#[test]
fn gates_hold() {
    holds(&SpinningCollision::GIVEN);
}

/// An arm that is 4 % longer, as one through the mean of the nodes is shorter on a coarse mesh.
#[test]
fn a_wrong_arm_breaks_the_gates() {
    let wrong = SpinningCollision {
        reference_arm: 1.04,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert!(!failing(&verdict).is_empty());
}
