//! Rigid rotation of a stressed body (verification notes, A9): the exact stress, and what forward Euler makes of it.

use std::f64::consts::TAU;

use libm::{exp, log1p, sincos};
use nalgebra::Matrix3;

/// Stress (Pa) after a rigid rotation of the body by `angle` (rad) about the z axis: `Q s Q^T`.
#[must_use]
pub fn rotated_stress(stress: &Matrix3<f64>, angle: f64) -> Matrix3<f64> {
    let (sin, cos) = sincos(angle);
    let q = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    q * stress * q.transpose()
}

/// Growth of the in-plane stress deviator over one turn in `steps` equal steps of the forward Jaumann
/// update `s + dt (w s - s w)` (equation 14 of the mortar paper): `(1 + 16 pi^2/N^2)^(N/2)`.
///
/// The deviator turns by twice the angle, so each step multiplies it by `|1 + 2 i dtheta|`.
#[must_use]
pub fn forward_jaumann_growth(steps: u32) -> f64 {
    let twice = 2.0 * TAU / f64::from(steps);
    exp(0.5 * f64::from(steps) * log1p(twice * twice))
}

/// Growth of `det F` over one turn in `steps` equal steps of `F <- (I + dt L) F`: `(1 + 4 pi^2/N^2)^N`.
#[must_use]
pub fn forward_deformation_growth(steps: u32) -> f64 {
    let angle = TAU / f64::from(steps);
    exp(f64::from(steps) * log1p(angle * angle))
}
