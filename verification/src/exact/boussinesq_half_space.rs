//! The manual's Boussinesq formula: a point load on the surface of a half-space.
//!
//! Kept for the record. Against a box on rollers it is wrong by +3.5 % close to the load and by several times
//! deep down; the gate is [`super::boussinesq_box`].

use std::f64::consts::PI;

/// Vertical displacement `u_z` (m, upwards positive, so negative under a downward load).
///
/// * `young`, `poisson`: elastic constants, Pa and 1;
/// * `load`: downward force, N;
/// * `radius`: horizontal distance from the load, m;
/// * `depth`: distance below the surface, m.
///
/// `u_z = -P (1 + nu) / (2 pi E R) [2 (1 - nu) + (depth / R)^2]`, `R^2 = radius^2 + depth^2`
/// (Boussinesq 1885; technical manual, section 20.1). Infinite at the load itself.
#[must_use]
pub fn vertical_displacement(young: f64, poisson: f64, load: f64, radius: f64, depth: f64) -> f64 {
    let distance = libm::hypot(radius, depth);
    if distance == 0.0 {
        return f64::NEG_INFINITY * load.signum();
    }
    let slope = depth / distance;
    -load * (1.0 + poisson) / (2.0 * PI * young * distance)
        * (2.0 * (1.0 - poisson) + slope * slope)
}
