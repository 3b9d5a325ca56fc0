//! Angular momentum of the bodies.

use crate::model::Vector;

/// Angular momentum of all particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// About the centre of mass \[kg m²/s\].
    pub about_centre: Vector,
    /// Sum of the magnitudes, mass times distance times speed, both from the centre of mass \[kg m²/s\].
    pub scale: f64,
}
