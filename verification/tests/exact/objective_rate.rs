//! Objective rates: the rate equation, the published errors and growth, and closed forms against the updates step by step.

use approx::assert_relative_eq;
use nalgebra::Matrix2;
use proctor_verification::exact::objective_rate::{
    PlaneStress, Update, deviator, growth_per_turn, sheared, sheared_by, turned_by,
};
use proctor_verification::exact::rotation::forward_jaumann_growth;
use std::f64::consts::TAU;

const LAMBDA: f64 = 1.5;
const START: PlaneStress = [3.0, -2.0, 1.0];

fn matrix([xx, yy, xy]: PlaneStress) -> Matrix2<f64> {
    Matrix2::new(xx, xy, xy, yy)
}

/// One step of an update with the velocity gradient times the step, as published, G = 1.
fn updated(update: Update, s: Matrix2<f64>, g: Matrix2<f64>) -> Matrix2<f64> {
    let one = Matrix2::identity();
    let split = |g: Matrix2<f64>| (0.5 * (g + g.transpose()), 0.5 * (g - g.transpose()));
    match update {
        Update::Forward => {
            let (d, w) = split(g);
            s + w * s - s * w + LAMBDA * d.trace() * one + 2.0 * d
        }
        Update::HughesWinget => {
            let midpoint = g * (one + 0.5 * g).try_inverse().expect("no inversion");
            let (d, w) = split(midpoint);
            let back = (one - 0.5 * w).try_inverse().expect("no inversion");
            let q = back * (one + 0.5 * w);
            q * s * q.transpose() + LAMBDA * d.trace() * one + 2.0 * d
        }
    }
}

const UPDATES: [Update; 2] = [Update::HughesWinget, Update::Forward];

#[test]
fn closed_forms_are_what_the_updates_do() {
    for update in UPDATES {
        for steps in [7, 100, 500] {
            let gamma = 3.0;
            let g = Matrix2::new(0.0, gamma / f64::from(steps), 0.0, 0.0);
            let s = (0..steps).fold(Matrix2::zeros(), |s, _| updated(update, s, g));
            let closed = matrix(sheared_by(update, gamma, steps));
            assert!(
                (s - closed).amax() < 1e-12 * closed.amax(),
                "{update:?} {steps}"
            );

            let (sin, cos) = (TAU / f64::from(steps)).sin_cos();
            let g = Matrix2::new(cos - 1.0, -sin, sin, cos - 1.0);
            let turned = 3 * steps;
            let s = (0..turned).fold(matrix(START), |s, _| updated(update, s, g));
            let closed = matrix(turned_by(update, START, [LAMBDA, 1.0], steps, turned));
            let scale = closed.amax().max(1.0);
            assert!(
                (s - closed).amax() < 1e-11 * scale,
                "{update:?} {steps}\n{s}{closed}"
            );
        }
    }
}

/// `sigma' = w sigma - sigma w + 2 d` with G = 1 in simple shear; without the spin, or with its sign turned round, it is
/// not so.
#[test]
fn shear_follows_the_rate_equation() {
    let (d, w) = (
        Matrix2::new(0.0, 0.5, 0.5, 0.0),
        Matrix2::new(0.0, 0.5, -0.5, 0.0),
    );
    for gamma in [0.3, 1.1, 2.9, 6.0] {
        let h = 1e-4;
        let rate = (matrix(sheared(gamma + h)) - matrix(sheared(gamma - h))) / (2.0 * h);
        let s = matrix(sheared(gamma));
        let spun = w * s - s * w;
        let residual = |sign: f64| -> f64 { (rate - spun * sign - d * 2.0).amax() };
        assert!(residual(1.0) < 1e-8, "{gamma}");
        assert!(residual(0.0) > 0.1 && residual(-1.0) > 0.1, "{gamma}");
    }
}

/// The notes: in 1000 steps to gamma = 3 the forward update is off by 6.5e-4 and 4.5e-3 G.
#[test]
fn published_errors_of_simple_shear() {
    let exact = sheared(3.0);
    let forward = sheared_by(Update::Forward, 3.0, 1000);
    assert_relative_eq!(exact[2], 3.0_f64.sin(), max_relative = 1e-14);
    assert_relative_eq!((forward[2] - exact[2]).abs(), 6.5e-4, max_relative = 2e-2);
    assert_relative_eq!((forward[0] - exact[0]).abs(), 4.5e-3, max_relative = 2e-2);
    for update in UPDATES {
        let error = |steps| {
            let s = sheared_by(update, 3.0, steps);
            (s[0] - exact[0]).hypot(s[2] - exact[2])
        };
        // Both add the strain of a step without turning it: order 1.
        assert_relative_eq!(error(4000) / error(8000), 2.0, max_relative = 1e-2);
    }
}

#[test]
fn a_turn_leaves_the_stress_or_makes_it_grow() {
    for steps in [250, 1000] {
        let kept = turned_by(
            Update::HughesWinget,
            START,
            [LAMBDA, 1.0],
            steps,
            10 * steps,
        );
        for (a, b) in kept.iter().zip(START) {
            assert!((a - b).abs() < 1e-11);
        }
        let grown = turned_by(Update::Forward, START, [LAMBDA, 1.0], steps, 10 * steps);
        let per_turn = (deviator(grown) / deviator(START)).ln() / 10.0;
        let n = f64::from(steps);
        let rate = growth_per_turn(Update::Forward, steps);
        assert_relative_eq!(rate, 8.0 * std::f64::consts::PI.powi(2) / n);
        // The next term is 74.7 pi^4/N^3.
        assert_relative_eq!(per_turn, rate, max_relative = 100.0 / (n * n));
        // As with the gradient of the spin alone, but for the sine of the angle.
        assert_relative_eq!(
            per_turn,
            forward_jaumann_growth(steps).ln(),
            max_relative = 20.0 / (n * n)
        );
        // A pressure of (lambda + G) 4 pi²/N per turn, from chords taken for a strain.
        let mean = 0.5 * (grown[0] + grown[1] - START[0] - START[1]);
        let expected = -10.0 * (LAMBDA + 1.0) * TAU * TAU / n;
        assert_relative_eq!(mean, expected, max_relative = 10.0 / (n * n));
    }
    assert_eq!(growth_per_turn(Update::HughesWinget, 100), 0.0);
}
