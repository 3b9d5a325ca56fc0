//! Colliding bodies.

use super::{holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::CollidingBlocks;

#[test]
fn gates_hold() {
    holds(&CollidingBlocks::GIVEN);
}

/// Stiffer bars part sooner, with the same velocities.
#[test]
fn a_wrong_reference_breaks_the_gates_on_the_duration() {
    let wrong = CollidingBlocks {
        reference_stiffness: 0.7,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let durations = verdict.gates.iter().filter(|g| g.name.contains("duration"));
    assert_eq!(durations.clone().count(), 13);
    for gate in durations {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}
