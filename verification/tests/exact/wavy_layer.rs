//! The layer under a wavy load: balance, its planes, and Hooke's law with the water in it.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::wavy_layer::WavyLayer;

const LAYER: WavyLayer = WavyLayer {
    height: 0.5,
    wave_number: 3.0,
    load: 2.0,
    shear: 4.0,
    bulk: 7.0,
    storage: 50.0,
};
const AT: [f64; 2] = [0.3, 0.2];

#[test]
fn stresses_balance_and_meet_the_planes() {
    let along = |i: usize, axis: usize| {
        derivative(
            |d| {
                let mut at = AT;
                at[axis] += d;
                LAYER.stress(at)[i]
            },
            2e-3,
        )
    };
    assert!((along(0, 0) + along(2, 1)).abs() < 1e-8);
    assert!((along(2, 0) + along(1, 1)).abs() < 1e-8);
    let [_, pressed, sheared] = LAYER.stress([0.4, 0.5]);
    assert_relative_eq!(pressed, -2.0 * (1.2_f64).cos(), max_relative = 1e-12);
    assert!(sheared.abs() < 1e-14);
    assert_eq!(
        (LAYER.stress([0.4, 0.0])[2], LAYER.rise([0.4, 0.0])),
        (0.0, 0.0)
    );
}

#[test]
fn strains_are_those_of_the_stress_and_the_water_keeps_its_share() {
    let [xx, yy, _] = LAYER.stress(AT);
    let nu = LAYER.poisson();
    let strain = |own: f64| (own - nu * (xx + yy)) / (2.0 * LAYER.shear);
    let up = derivative(|d| LAYER.rise([AT[0], AT[1] + d]), 2e-3);
    assert_relative_eq!(up, strain(yy), max_relative = 1e-8);
    let volume = strain(xx) + strain(yy);
    assert_relative_eq!(LAYER.pressure(AT), -50.0 * volume, max_relative = 1e-10);
    // Stiff water bears all of the mean stress: half of the stress across and along.
    let stiff = WavyLayer {
        storage: 1e9,
        ..LAYER
    };
    assert_relative_eq!(stiff.pressure(AT), -0.5 * (xx + yy), max_relative = 1e-6);
}
