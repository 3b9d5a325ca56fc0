//! The axis-aligned manufactured solution against its own balance of momentum, by finite differences.

use std::f64::consts::{PI, TAU};

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::axis_aligned_mms::{AxisAlignedMms, Law};

fn solution<const D: usize>(law: Law, wave_number: f64, amplitude: f64) -> AxisAlignedMms<D> {
    AxisAlignedMms {
        law,
        lambda: 600.0,
        mu: 400.0,
        density: 2.0,
        amplitude,
        wave_number,
        angular_frequency: PI * 20.0,
        phases: std::array::from_fn(|i| TAU / 3.0 * i as f64),
    }
}

/// Diagonal nominal stress `P_i = sigma_i J / F_i` from the Cauchy stress the solution states.
fn nominal<const D: usize>(s: &AxisAlignedMms<D>, x: [f64; D], t: f64) -> [f64; D] {
    let f = s.stretches(x, t);
    let j: f64 = f.iter().product();
    let sigma = s.stress(x, t);
    std::array::from_fn(|i| sigma[i] * j / f[i])
}

fn check_balance<const D: usize>(law: Law, wave_number: f64) {
    let s = solution::<D>(law, wave_number, 0.05);
    let t = 0.0123;
    for x in [[0.21, 0.43, 0.77], [0.5, 0.05, 0.6]] {
        let x: [f64; D] = std::array::from_fn(|i| x[i]);
        let b = s.body_force(x, t);
        for i in 0..D {
            let along = |f: &dyn Fn([f64; D]) -> f64| {
                derivative(
                    |e| {
                        let mut y = x;
                        y[i] += e;
                        f(y)
                    },
                    1e-3,
                )
            };
            let in_time = |f: &dyn Fn(f64) -> f64| derivative(|e| f(t + e), 1e-5);
            let divergence = along(&|y| nominal(&s, y, t)[i]);
            let acceleration = in_time(&|time| s.velocity(x, time)[i]);
            let scale = s.density * s.angular_frequency.powi(2) * s.amplitude;
            let residual = s.density * acceleration - divergence - s.density * b[i];
            assert!(
                residual.abs() < 1e-7 * scale,
                "{law:?}, axis {i} of {D}: {residual:e} of {scale:e}"
            );
            assert_relative_eq!(
                in_time(&|time| s.displacement(x, time)[i]),
                s.velocity(x, t)[i],
                epsilon = 1e-8
            );
            assert_relative_eq!(
                1.0 + along(&|y| s.displacement(y, t)[i]),
                s.stretches(x, t)[i],
                epsilon = 1e-9
            );
        }
    }
}

#[test]
fn momentum_balances_in_one_to_three_dimensions() {
    for law in [Law::NeoHookean, Law::RateElastic] {
        for wave_number in [PI, TAU] {
            check_balance::<1>(law, wave_number);
            check_balance::<2>(law, wave_number);
            check_balance::<3>(law, wave_number);
        }
    }
}

/// The stresses against the laws as published: neo-Hookean `P = lambda ln J F^-T + mu (F - F^-T)`, and the rate law
/// `d sigma_i/dt = lambda tr D + 2 mu D_i` with `D_i = dF_i/dt / F_i`.
#[test]
fn stresses_are_those_of_the_laws() {
    let (x, t) = ([0.3, 0.1, 0.8], 0.02);
    let neo_hookean = solution::<3>(Law::NeoHookean, PI, 0.05);
    let f = neo_hookean.stretches(x, t);
    let j: f64 = f.iter().product();
    let p = nominal(&neo_hookean, x, t);
    let rate = solution::<3>(Law::RateElastic, PI, 0.05);
    let h = 1e-6;
    let d: [f64; 3] =
        std::array::from_fn(|i| derivative(|e| rate.stretches(x, t + e)[i], h) / f[i]);
    for i in 0..3 {
        assert_relative_eq!(
            p[i],
            600.0 * j.ln() / f[i] + 400.0 * (f[i] - 1.0 / f[i]),
            max_relative = 1e-12
        );
        let stress_rate = derivative(|e| rate.stress(x, t + e)[i], h);
        let expected = 600.0 * (d[0] + d[1] + d[2]) + 800.0 * d[i];
        assert_relative_eq!(stress_rate, expected, max_relative = 1e-7);
    }
}

/// In plane strain the third direction is held: its stress is `lambda` times the volume change for small strain.
#[test]
fn small_strain_is_hookes_law() {
    for law in [Law::NeoHookean, Law::RateElastic] {
        let s = solution::<2>(law, PI, 1e-8);
        let (x, t) = ([0.3, 0.1], 0.02);
        let f = s.stretches(x, t);
        let volume = f[0] - 1.0 + f[1] - 1.0;
        let stress = s.stress(x, t);
        assert_relative_eq!(stress[2], 600.0 * volume, max_relative = 1e-6);
        assert_relative_eq!(
            stress[0],
            600.0 * volume + 800.0 * (f[0] - 1.0),
            max_relative = 1e-6
        );
    }
}

#[test]
fn stretch_rates_are_the_derivatives_of_the_stretches() {
    let s = solution::<3>(Law::NeoHookean, PI, 0.05);
    let (x, t) = ([0.3, 0.6, 0.9], 0.013);
    let rates = s.stretch_rates(x, t);
    for i in 0..3 {
        let difference = derivative(|dt| s.stretches(x, t + dt)[i], 1e-5);
        assert_relative_eq!(rates[i], difference, max_relative = 1e-7);
    }
}
