//! The disk on the inclined plane.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::RollingDisk;

#[test]
fn gates_hold() {
    holds(&RollingDisk::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_the_gates_on_the_way() {
    let wrong = RollingDisk {
        reference_gravity: 1.05,
        ..RollingDisk::GIVEN
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 2, "{failing:?}");
    assert!(failing.iter().all(|line| line.contains("way")));
}
