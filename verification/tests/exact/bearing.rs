//! Strip footings, against tables and against both bounds of limit analysis, each integrated step by step.

use approx::assert_relative_eq;
use proctor_verification::exact::bearing::Ground;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

fn ground(friction: f64, cohesion: f64, surcharge: f64) -> Ground {
    Ground {
        friction,
        cohesion,
        surcharge,
    }
}

#[test]
fn factors_are_those_of_the_tables() {
    let clay = ground(0.0, 3.0, 2.0);
    assert_relative_eq!(clay.of_cohesion(), 5.141_592_653_6, max_relative = 1e-10);
    assert_relative_eq!(clay.of_surcharge(), 1.0, max_relative = 1e-12);
    assert_relative_eq!(clay.bearing(), 3.0 * (2.0 + PI) + 2.0, max_relative = 1e-12);
    for (friction, of_surcharge, of_cohesion) in [(20.0, 6.399, 14.835), (30.0, 18.401, 30.140)] {
        let soil = ground(friction, 1.0, 1.0);
        assert_relative_eq!(soil.of_surcharge(), of_surcharge, max_relative = 1e-4);
        assert_relative_eq!(soil.of_cohesion(), of_cohesion, max_relative = 1e-4);
    }
    // Friction that goes to zero.
    let nearly = ground(1e-4, 1.0, 0.0);
    assert_relative_eq!(nearly.of_cohesion(), 2.0 + PI, max_relative = 1e-4);
}

/// The lower bound: along the fan from the free side to the footing principal stresses turn by 90°, and the mean
/// compression s, with c cot phi added, grows by ds = 2 s tan(phi) d(theta); without friction by 2 c d(theta).
#[test]
fn stresses_that_the_ground_bears_carry_as_much() {
    for friction in [0.0, 5.0, 20.0, 30.0, 40.0_f64] {
        let (c, q) = (1.3, 0.7);
        let (sine, cosine) = friction.to_radians().sin_cos();
        // Beside the footing q is the least compression.
        let mut mean = (q + c * cosine) / (1.0 - sine);
        let steps = 100_000;
        let turn = FRAC_PI_2 / f64::from(steps);
        // The radius of Mohr's circle is mean sin(phi) + c cos(phi).
        let growth = |mean: f64| 2.0 * (mean * sine + c * cosine) / cosine;
        for _ in 0..steps {
            let half = mean + 0.5 * turn * growth(mean);
            mean += turn * growth(half);
        }
        let below = mean + mean * sine + c * cosine;
        assert_relative_eq!(below, ground(friction, c, q).bearing(), max_relative = 1e-8);
    }
}

/// The upper bound: a rigid wedge below a rough footing goes down by 1, the fan turns about the edge and the wedge beside
/// it is pushed out; every line of slip opens at the angle phi, and so takes c cos(phi) times its jump per length.
#[test]
fn moving_wedges_take_as_much() {
    for friction in [0.0, 5.0, 20.0, 30.0, 40.0_f64] {
        let (c, q, width) = (1.3, 0.7, 2.0);
        let phi = friction.to_radians();
        let (wedge, slope) = (FRAC_PI_4 + 0.5 * phi, phi.tan());
        // Half of a symmetric motion: the wedge falls by 1, and the fan begins along its side, across which it moves.
        let side = 0.5 * width / wedge.cos();
        // The jump along that side has the size of the fan's first velocity.
        let first = 0.5 / wedge.cos();
        let mut taken = c * phi.cos() * first * side;
        let steps = 100_000;
        let turn = FRAC_PI_2 / f64::from(steps);
        for k in 0..steps {
            let grown = ((f64::from(k) + 0.5) * turn * slope).exp();
            let (radius, speed) = (side * grown, first * grown);
            // Along the spiral, whose length is r/cos(phi) d(theta), and within the fan as much again.
            taken += 2.0 * c * phi.cos() * speed * radius / phi.cos() * turn;
        }
        let grown = (FRAC_PI_2 * slope).exp();
        let (radius, speed) = (side * grown, first * grown);
        taken += c * phi.cos() * speed * radius;
        // The last wedge lifts what lies on it.
        let aside = 2.0 * radius * (FRAC_PI_2 - wedge).cos();
        taken += q * aside * speed * wedge.sin();
        assert_relative_eq!(
            taken / (0.5 * width),
            ground(friction, c, q).bearing(),
            max_relative = 1e-8
        );
    }
}

/// Without friction the ground moves within one and a half widths of the middle and 0.707 deep; with 30° within 4.8 and 1.6.
#[test]
fn what_moves_reaches_as_far_as_its_wedges() {
    let near = |friction: f64, [aside, deep]: [f64; 2]| {
        let reach = ground(friction, 1.0, 0.0).reach();
        assert_relative_eq!(reach[0], aside, max_relative = 2e-3);
        assert_relative_eq!(reach[1], deep, max_relative = 2e-3);
    };
    near(0.0, [1.5, 0.5_f64.sqrt()]);
    // Measured along the spiral, point by point.
    for friction in [20.0, 30.0_f64] {
        let phi = friction.to_radians();
        let wedge = FRAC_PI_4 + 0.5 * phi;
        let points = (0..=10_000).map(|k| {
            let turn = FRAC_PI_2 * f64::from(k) / 1e4;
            let radius = 0.5 / wedge.cos() * (turn * phi.tan()).exp();
            let angle = wedge + turn;
            [0.5 - radius * angle.cos(), radius * angle.sin()]
        });
        let points: Vec<[f64; 2]> = points.collect();
        let deep = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        // From its end the last line of slip rises at 45° - phi/2.
        let [x, y] = points[points.len() - 1];
        near(friction, [x + y / (FRAC_PI_2 - wedge).tan(), deep]);
    }
}
