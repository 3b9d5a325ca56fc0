//! A particle and where it is, for errors and events.

use std::fmt;

/// A particle and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleAt {
    /// Identifier.
    pub id: u64,
    /// Identifier of its body.
    pub body: i64,
    /// Position \[m\].
    pub position: [f64; 3],
    /// Volume \[m³\].
    pub volume: f64,
    /// Mass \[kg\].
    pub mass: f64,
}

impl fmt::Display for ParticleAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.position;
        write!(
            f,
            "particle {} of body {} at ({x}, {y}, {z}) m",
            self.id, self.body
        )
    }
}
