//! Consolidation: the table of degrees, both differential equations, and the load that comes on.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::consolidation::{Layer, degree};

const LAYER: Layer = Layer {
    height: 2.0,
    confined_modulus: 1e6,
    storage: 5e8,
    mobility: 1e-9,
    load: 8e5,
};

#[test]
fn degrees_of_the_table() {
    for (factor, exact) in [
        (0.02, 0.159_577),
        (0.1, 0.356_823),
        (0.197, 0.500_338),
        (0.5, 0.763_950),
        (0.848, 0.899_979),
        (1.0, 0.931_260),
    ] {
        assert_relative_eq!(degree(factor), exact, epsilon = 6e-7);
    }
}

/// `p_t = c_v p_zz` after the load, with its source while it comes on.
#[test]
fn pressure_obeys_diffusion() {
    let ramp = 600.0;
    let source = LAYER.undrained_pressure() / ramp;
    // The source is a series that falls as 1/M: 400 terms leave 2e-3 of it.
    for (t, source, share) in [(400.0, source, 3e-3), (900.0, 0.0, 1e-5)] {
        let rate = derivative(|d| LAYER.pressure(0.7, t + d, ramp), 1.0);
        let slope = |z: f64| derivative(|d| LAYER.pressure(z + d, t, ramp), 1e-3);
        let bend = derivative(|d| slope(0.7 + d), 1e-3);
        let exact = LAYER.consolidation() * bend + source;
        assert_relative_eq!(rate, exact, epsilon = share * source.max(rate.abs()));
    }
}

/// The mean strain settles: the integral of (Q - p)/`E_c`.
#[test]
fn settlement_is_the_integral_of_the_strain() {
    let (t, ramp, count) = (500.0, 600.0, 2000);
    let mean: f64 = (0..count)
        .map(|i| LAYER.pressure(2.0 * (f64::from(i) + 0.5) / f64::from(count), t, ramp))
        .sum::<f64>()
        / f64::from(count);
    let exact = -2.0 * (LAYER.load * t / ramp - mean) / LAYER.confined_modulus;
    assert_relative_eq!(LAYER.settlement(t, ramp), exact, max_relative = 1e-5);
}

/// Values at `Q/E_c` = 0.8, `T_v` = 0.3, and the equation of large strain in the height at the start.
#[test]
fn large_strain_settles_less_and_later() {
    let t = 0.3 * 4.0 / (LAYER.mobility * LAYER.confined_modulus);
    assert_relative_eq!(LAYER.large_settlement(t) / 2.0, -0.337_69, epsilon = 1e-5);
    let small = 0.8 * degree(0.3);
    assert_relative_eq!(small, 0.490_59, epsilon = 1e-5);
    // Continuity J_t = (k J^2/J p_Z)_Z/(rho_w g) with the pressure, J = exp((p - Q)/E_c).
    let z = 0.9;
    let j =
        |z: f64, t: f64| ((LAYER.large_pressure(z, t) - LAYER.load) / LAYER.confined_modulus).exp();
    let rate = derivative(|d| j(z, t + d), 10.0);
    let flux = |z: f64| {
        let slope = derivative(|d| LAYER.large_pressure(z + d, t), 1e-3);
        LAYER.mobility * j(z, t) * slope
    };
    let exact = derivative(|d| flux(z + d), 1e-3);
    assert_relative_eq!(rate, exact, epsilon = 1e-5 * rate.abs());
    // Little load: the small strain of incompressible water.
    let little = Layer {
        load: 1.0,
        storage: f64::INFINITY,
        ..LAYER
    };
    assert_relative_eq!(
        little.large_pressure(z, t),
        little.pressure(z, t, 0.0),
        max_relative = 1e-5
    );
}
