//! Centre of mass of a body.

use crate::model::Vector;

/// Mass, centre of mass and mean velocity of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassCenter {
    /// Mass \[kg\].
    pub mass: f64,
    /// Centre of mass in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Momentum over mass \[m/s\].
    pub velocity: Vector,
}
