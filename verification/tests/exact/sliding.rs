//! Sliding blocks: the manual's numbers, limits, and a Coulomb block integrated in time.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use proctor_verification::exact::sliding::{Slope, time_of_meeting};

fn slope(friction: f64) -> Slope {
    Slope {
        along: 7.07,
        into: 7.07,
        friction,
    }
}

#[test]
fn the_manuals_displacements() {
    for (friction, d) in [(0.0, 14.14), (0.2, 11.312), (0.5, 7.07)] {
        assert_relative_eq!(slope(friction).displacement(2.0), d, max_relative = 1e-12);
    }
}

#[test]
fn sticks_from_the_tangent_of_the_angle_on() {
    assert!(!slope(0.999).sticks());
    assert!(slope(1.0).sticks() && slope(1.2).sticks());
    assert_abs_diff_eq!(slope(1.2).displacement(5.0), 0.0);
    let uphill = Slope {
        along: -7.07,
        ..slope(0.5)
    };
    assert_relative_eq!(
        uphill.acceleration(),
        -slope(0.5).acceleration(),
        max_relative = 1e-15
    );
}

#[test]
fn lifts_off_where_gravity_points_away() {
    let lifted = Slope {
        into: -7.07,
        ..slope(0.5)
    };
    assert!(!lifted.sticks());
    assert_abs_diff_eq!(lifted.normal(), 0.0);
    assert_relative_eq!(lifted.acceleration(), 7.07, max_relative = 1e-15);
}

/// Coulomb's law integrated: friction as large as it takes to stop, at most mu N.
#[test]
fn agrees_with_the_law_integrated_in_time() {
    for friction in [0.0, 0.3, 0.95, 1.3] {
        let slope = slope(friction);
        let (mut x, mut v, dt) = (0.0, 0.0, 1e-5);
        for _ in 0..200_000 {
            let trial = v + slope.along * dt;
            let most = friction * slope.into * dt;
            let next = trial - trial.clamp(-most, most);
            x += 0.5 * (v + next) * dt;
            v = next;
        }
        assert_abs_diff_eq!(x, slope.displacement(2.0), epsilon = 1e-9);
    }
}

#[test]
fn blocks_meet_when_the_one_behind_is_faster() {
    let (fast, slow) = (slope(0.0), slope(0.2));
    assert_eq!(time_of_meeting(&slow, &fast, 5.0), None);
    let t = time_of_meeting(&fast, &slow, 5.0).expect("they meet");
    assert_relative_eq!(
        fast.displacement(t) - slow.displacement(t),
        5.0,
        max_relative = 1e-14
    );
}
