//! The column that is let go: its modes, its equation, its base and its top.

use approx::assert_relative_eq;
use proctor_verification::exact::sudden_weight::SuddenWeight;
use std::f64::consts::PI;

const COLUMN: SuddenWeight = SuddenWeight {
    height: 1.5,
    wave_speed: 40.0,
    gravity: 9.81,
};
const DENSITY: f64 = 1200.0;

/// The same by separation of variables: `u = -sum b_n/w_n^2 (1 - cos w_n t) sin k_n z`, `b_n = 2 g/(k_n H)`.
fn series(z: f64, t: f64) -> f64 {
    let SuddenWeight {
        height,
        wave_speed,
        gravity,
    } = COLUMN;
    (1..20_000)
        .map(|n| {
            let k = (f64::from(n) - 0.5) * PI / height;
            let w = k * wave_speed;
            -2.0 * gravity / (k * height * w * w) * (1.0 - (w * t).cos()) * (k * z).sin()
        })
        .sum()
}

#[test]
fn it_is_the_sum_of_its_modes() {
    let scale = COLUMN.at_rest(COLUMN.height).abs();
    for z in [0.0, 0.2, 0.75, 1.31, 1.5] {
        for t in [0.0, 0.004, 0.02, 0.0375, 0.07, 0.4] {
            let difference = COLUMN.displacement(z, t) - series(z, t);
            assert!(difference.abs() < 1e-8 * scale, "{z} {t} {difference}");
        }
    }
}

#[test]
fn at_first_everything_but_the_base_falls_freely() {
    let t = 0.01;
    let fallen = COLUMN.displacement(1.2, t);
    assert!((fallen + 0.5 * COLUMN.gravity * t * t).abs() < 1e-15);
}

/// Between fronts the displacement is of second order, and second differences are exact: `u_tt = c² u_zz - g`. With gravity
/// turned round, or a wave speed that is off by a percent, it is not so.
#[test]
fn momentum_balances() {
    let residual = |z: f64, t: f64, speed: f64, gravity: f64| {
        let (h, k) = (1e-3, 1e-5);
        let u = |z: f64, t: f64| COLUMN.displacement(z, t);
        let u_tt = (u(z, t + k) - 2.0 * u(z, t) + u(z, t - k)) / (k * k);
        let stress = |z: f64| COLUMN.stress(z, t, DENSITY) / DENSITY;
        let s_z = (stress(z + h) - stress(z - h)) / (2.0 * h);
        let ratio = (speed / COLUMN.wave_speed).powi(2);
        (u_tt - ratio * s_z + gravity) / COLUMN.gravity
    };
    for (z, t) in [
        (0.3, 0.004),
        (0.3, 0.02),
        (1.1, 0.05),
        (0.9, 0.111),
        (1.2, 0.2),
    ] {
        let (c, g) = (COLUMN.wave_speed, COLUMN.gravity);
        assert!(residual(z, t, c, g).abs() < 1e-5, "{z} {t}");
        assert!(residual(z, t, c, -g).abs() > 1.0, "{z} {t}");
    }
    // Where the stress varies along the column, a wrong speed shows.
    let (c, g) = (COLUMN.wave_speed, COLUMN.gravity);
    assert!(residual(0.3, 0.02, 1.01 * c, g).abs() > 1e-2);
}

#[test]
fn the_stress_is_the_slope_of_the_displacement() {
    let d = 1e-6;
    for z in [0.1, 0.6, 1.0, 1.4] {
        for t in [0.003, 0.021, 0.052, 0.09, 0.131] {
            let slope = (COLUMN.displacement(z + d, t) - COLUMN.displacement(z - d, t)) / (2.0 * d);
            let stress = DENSITY * COLUMN.wave_speed.powi(2) * slope;
            let scale = DENSITY * COLUMN.gravity * COLUMN.height;
            let found = COLUMN.stress(z, t, DENSITY);
            assert!((found - stress).abs() < 1e-5 * scale, "{z} {t}");
        }
    }
}

/// The notes: a triangle from 0 to 2 rho g H, four transits long; the top sinks to twice its static displacement.
#[test]
fn the_pressure_on_the_base_is_a_triangle() {
    let transit = COLUMN.height / COLUMN.wave_speed;
    assert_relative_eq!(COLUMN.period(), 4.0 * transit);
    let weight = DENSITY * COLUMN.gravity * COLUMN.height;
    for (transits, share) in [
        (0.0, 0.0),
        (0.5, 0.5),
        (1.0, 1.0),
        (1.5, 1.5),
        (2.0, 2.0),
        (2.5, 1.5),
        (3.0, 1.0),
        (3.5, 0.5),
        (4.0, 0.0),
        (5.5, 1.5),
    ] {
        let pressure = -COLUMN.stress(0.0, transits * transit, DENSITY);
        assert!(
            (pressure - share * weight).abs() < 1e-9 * weight,
            "{transits}"
        );
    }
    let top = COLUMN.displacement(COLUMN.height, 2.0 * transit);
    let at_rest = COLUMN.at_rest(COLUMN.height);
    assert_relative_eq!(top, 2.0 * at_rest, max_relative = 1e-12);
    for i in 0..400 {
        let t = 0.01 * f64::from(i) * transit;
        let u = COLUMN.displacement(COLUMN.height, t);
        assert!(u <= 1e-15 && u >= 2.0 * at_rest * (1.0 + 1e-12));
        assert!(COLUMN.displacement(0.0, t).abs() < 1e-15);
        assert!(COLUMN.stress(COLUMN.height, t, DENSITY).abs() < 1e-9 * weight);
    }
}
