//! The shaken column: tabulated values, the modal solution, the wave equation and its boundary conditions.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use proctor_verification::exact::base_column::{BaseColumn, CubedSine, SineRecord};

/// The input file's column: E = 10 `MPa`, nu = 0.25, `c_S` = 40 m/s, hence 2500 kg/m^3; `c_P` is sqrt(3) times `c_S`.
const DENSITY: f64 = 2500.0;

fn shear(height: f64, wave_speed: f64) -> BaseColumn {
    BaseColumn {
        height,
        wave_speed,
        density: DENSITY,
    }
}

fn record(frequency: f64) -> SineRecord {
    SineRecord {
        amplitude: 0.3,
        frequency,
        phase: PI,
    }
}

/// Verification notes, table of section 3 (A = 0.3 m/s, alpha = pi, t = 0.2 s).
#[test]
fn tabulated_velocities() {
    let (c_s, c_p) = (40.0, 40.0 * 3.0_f64.sqrt());
    // height, wave speed, frequency, v(H/2), v(H), steady top over base
    let table = [
        (1.0, c_s, 1.0, -0.287_983, -0.288_873, 1.0125),
        (1.0, c_p, 1.0, -0.282_281, -0.282_572, 1.0041),
        (
            0.8,
            c_s * 10.0_f64.sqrt(),
            1.0,
            -0.289_986,
            -0.290_043,
            1.0008,
        ),
        (1.0, c_s, 6.0, -0.432_504, -0.485_410, 1.7013),
        (1.0, c_p, 15.0, 0.216_715, 0.278_746, 4.787),
    ];
    for (height, c, frequency, middle, top, steady) in table {
        let column = shear(height, c);
        let v_b = |t: f64| record(frequency).velocity(t);
        let found = [
            column.velocity(0.5 * height, 0.2, v_b),
            column.velocity(height, 0.2, v_b),
        ];
        assert!(
            (found[0] - middle).abs() < 1e-6,
            "c = {c}, f = {frequency}: v(H/2) = {}",
            found[0]
        );
        assert!(
            (found[1] - top).abs() < 1e-6,
            "c = {c}, f = {frequency}: v(H) = {}",
            found[1]
        );
        assert_relative_eq!(
            column.steady_amplification(height, frequency),
            steady,
            max_relative = 1e-4
        );
    }
    assert_relative_eq!(
        shear(1.0, c_s).fundamental_frequency(),
        10.0,
        max_relative = 1e-14
    );
}

/// Velocity by modes: base plus `sum sin(b_n z) dq_n/dt`, an independent formula.
fn modal_velocity(column: &BaseColumn, record: &SineRecord, z: f64, t: f64, modes: u32) -> f64 {
    let w = TAU * record.frequency;
    let a0 = record.amplitude * w;
    let (sin_al, cos_al) = record.phase.sin_cos();
    let relative: f64 = (1..=modes)
        .rev()
        .map(|n| {
            let b_n = (f64::from(n) - 0.5) * PI / column.height;
            let w_n = b_n * column.wave_speed;
            let participation = 2.0 / (b_n * column.height);
            let rate = -w * (w * t + record.phase).sin()
                + cos_al * w_n * (w_n * t).sin()
                + w * sin_al * (w_n * t).cos();
            -participation * a0 * rate / (w_n * w_n - w * w) * (b_n * z).sin()
        })
        .sum();
    record.velocity(t) + relative
}

#[test]
fn images_agree_with_modes() {
    let column = shear(1.0, 40.0);
    let mut worst = 0.0_f64;
    for motion in [
        record(6.0),
        SineRecord {
            amplitude: 0.3,
            frequency: 7.3,
            phase: 0.4,
        },
    ] {
        for z in [0.13, 0.5, 0.81, 1.0] {
            for t in [0.004, 0.0333, 0.11, 0.2] {
                let images = column.velocity(z, t, |s| motion.velocity(s));
                let difference = (images - modal_velocity(&column, &motion, z, t, 200_000)).abs();
                assert!(difference < 1e-8, "z {z}, t {t}: {difference:e} m/s");
                worst = worst.max(difference);
            }
        }
    }
    println!("images - modes: at most {worst:e} m/s");
}

/// A motion that starts smoothly, so that differences across wave fronts are harmless.
const SMOOTH: CubedSine = CubedSine {
    amplitude: 0.3,
    frequency: 5.0,
};

#[test]
fn the_wave_equation_and_the_momentum_balance_hold() {
    let column = shear(1.0, 40.0);
    let h = 1e-3;
    let v = |z: f64, t: f64| column.velocity(z, t, |s| SMOOTH.velocity(s));
    let u = |z: f64, t: f64| column.displacement(z, t, |s| SMOOTH.displacement(s));
    let stress = |z: f64, t: f64| column.stress(z, t, |s| SMOOTH.velocity(s));
    let modulus = DENSITY * 40.0 * 40.0;
    for z in [0.2, 0.51, 0.93] {
        for t in [0.013, 0.071, 0.142, 0.29] {
            let dt = h / 40.0;
            let v_tt = (v(z, t + dt) - 2.0 * v(z, t) + v(z, t - dt)) / (dt * dt);
            let v_zz = (v(z + h, t) - 2.0 * v(z, t) + v(z - h, t)) / (h * h);
            // The acceleration rate scales with A W^2 = 300 m/s^3.
            assert!(
                (v_tt - 1600.0 * v_zz).abs() < 0.5,
                "z {z}, t {t}: {v_tt} and {}",
                1600.0 * v_zz
            );
            let u_z = (u(z + h, t) - u(z - h, t)) / (2.0 * h);
            let u_t = (u(z, t + dt) - u(z, t - dt)) / (2.0 * dt);
            assert!((stress(z, t) - modulus * u_z).abs() < 1e-4 * DENSITY * 40.0 * 0.3);
            assert!((u_t - v(z, t)).abs() < 1e-6);
            let v_t = (v(z, t + dt) - v(z, t - dt)) / (2.0 * dt);
            let s_z = (stress(z + h, t) - stress(z - h, t)) / (2.0 * h);
            let a = column.velocity(z, t, |s| SMOOTH.acceleration(s));
            assert!((DENSITY * v_t - s_z).abs() < 1e-4 * DENSITY * 10.0);
            assert!((v_t - a).abs() < 1e-4 * 10.0);
        }
    }
}

#[test]
fn the_base_follows_and_the_top_is_free() {
    let column = shear(0.8, 70.0);
    for i in 0..60 {
        let t = 0.005 * f64::from(i) + 1e-4;
        let v_b = |s: f64| SMOOTH.velocity(s);
        assert_relative_eq!(column.velocity(0.0, t, v_b), v_b(t), epsilon = 1e-12);
        assert!(column.stress(0.8, t, v_b).abs() < 1e-9 * DENSITY * 70.0 * 0.3);
    }
}

#[test]
fn nothing_moves_before_the_first_wave() {
    let column = shear(1.0, 40.0);
    let v_b = |s: f64| {
        assert!(s >= 0.0, "asked about the time {s}");
        SMOOTH.velocity(s)
    };
    assert_eq!(column.velocity(0.8, 0.0199, v_b), 0.0);
    assert!(column.velocity(0.8, 0.0201, v_b) != 0.0);
    assert!(column.velocity(0.3, 0.4, v_b).is_finite());
}

/// Velocity and displacement are the integrals of the acceleration, from rest.
#[test]
fn motions_are_their_own_derivatives() {
    fn check(a: impl Fn(f64) -> f64, v: impl Fn(f64) -> f64, u: impl Fn(f64) -> f64) {
        assert!(v(0.0).abs() < 1e-15 && u(0.0).abs() < 1e-15);
        let h = 1e-5;
        for t in [0.01, 0.1, 0.123, 0.37] {
            assert_relative_eq!((v(t + h) - v(t - h)) / (2.0 * h), a(t), epsilon = 1e-5);
            assert_relative_eq!((u(t + h) - u(t - h)) / (2.0 * h), v(t), epsilon = 1e-7);
        }
    }
    check(
        |t| SMOOTH.acceleration(t),
        |t| SMOOTH.velocity(t),
        |t| SMOOTH.displacement(t),
    );
    for phase in [PI, 0.3] {
        let sine = SineRecord {
            amplitude: 0.3,
            frequency: 2.0,
            phase,
        };
        check(
            |t| sine.acceleration(t),
            |t| sine.velocity(t),
            |t| sine.displacement(t),
        );
    }
}
