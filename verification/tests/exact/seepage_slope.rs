//! The slope with seepage: balance of soil and water in both directions, and the textbook's factor of safety.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::seepage_slope::SeepageSlope;

const SLOPE: SeepageSlope = SeepageSlope {
    angle: 0.2,
    depth: 3.0,
    density: 2000.0,
    density_water: 1000.0,
    gravity: 10.0,
};

#[test]
fn weight_of_both_is_carried() {
    let across = derivative(
        |d| SLOPE.effective_stress(1.0 + d) - SLOPE.pressure(1.0 + d),
        1e-2,
    );
    assert_relative_eq!(across, -2e4 * 0.2_f64.cos(), max_relative = 1e-9);
    let along = derivative(|d| SLOPE.shear_stress(1.0 + d), 1e-2);
    assert_relative_eq!(along, 2e4 * 0.2_f64.sin(), max_relative = 1e-9);
    // Drag rho_w g/k times the flux is the weight of the water along the slope.
    let drag = 1e4 / 1e-3 * SLOPE.flux(1e-3);
    assert_relative_eq!(drag, 1e4 * 0.2_f64.sin(), max_relative = 1e-12);
    let strain = derivative(|d| SLOPE.displacement(1.0 + d, 1e6), 1e-2);
    assert_relative_eq!(-1e6 * strain, SLOPE.shear_stress(1.0), max_relative = 1e-9);
    assert_eq!(SLOPE.displacement(3.0, 1e6), 0.0);
}

/// Without cohesion water halves the factor, `(rho'/rho) tan phi/tan b` with rho' = rho/2.
#[test]
fn water_halves_the_safety_of_sand() {
    let friction = 0.5_f64;
    let dry = friction.tan() / 0.2_f64.tan();
    assert_relative_eq!(
        SLOPE.safety(2.0, 0.0, friction),
        0.5 * dry,
        max_relative = 1e-12
    );
    let more = SLOPE.safety(2.0, 1e3, friction) - SLOPE.safety(2.0, 0.0, friction);
    let exact = 1e3 / (2e4 * 2.0 * 0.2_f64.sin());
    assert_relative_eq!(more, exact, max_relative = 1e-12);
}
