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

/// A shear column by characteristics: waves take one of `n` elements per step.
#[test]
fn an_elastic_block_slips_late_by_its_shear_wave() {
    let (n, c_s, height) = (400, 100.0, 2.0);
    let dt = height / c_s / f64::from(n);
    for friction in [0.1, 0.5] {
        let slope = slope(friction);
        // v - s/Z going up and v + s/Z going down, s over rho c_s.
        let mut up = vec![0.0; n as usize];
        let mut down = up.clone();
        let limit = friction * slope.into * height / c_s;
        let (mut x, mut t, mut before) = (0.0, 0.0, 0.0);
        while t < 0.2 {
            for w in up.iter_mut().chain(&mut down) {
                *w += slope.along * dt;
            }
            // At the base v + s = down. It sticks, v = 0, while s is within the limit.
            let traction = down[0].min(limit);
            let velocity = down[0] - traction;
            let top = up[n as usize - 1];
            up.rotate_right(1);
            down.rotate_left(1);
            up[0] = velocity - traction;
            down[n as usize - 1] = top;
            let mean = up
                .iter()
                .zip(&down)
                .map(|(a, b)| 0.5 * (a + b))
                .sum::<f64>()
                / f64::from(n);
            x += 0.5 * (before + mean) * dt;
            before = mean;
            t += dt;
        }
        let exact = slope.elastic_displacement(t, height, c_s);
        let late = exact - slope.displacement(t);
        assert!(late > 0.0);
        assert_abs_diff_eq!(x, exact, epsilon = 0.02 * late + 2e-4 * exact);
    }
}
