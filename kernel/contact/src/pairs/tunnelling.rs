//! Tunnelling: bodies that would pass each other in one step without being seen by contact.

use proctor_kernel::simulation::InteractionFault;
use std::fmt;

/// Two bodies of a contact approach each other in one step by more than the distance at which they touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Tunnelling {
    /// Identifiers of master and slave.
    pub bodies: [i64; 2],
    /// Position of the node \[m\]; `None` where they move too fast to be compared node by node.
    pub position: Option<[f64; 3]>,
    /// Approach in the step \[m\].
    pub approach: f64,
    /// Distance at which they touch, or without a position one cell \[m\].
    pub distance: f64,
}

impl fmt::Display for Tunnelling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            bodies: [master, slave],
            position,
            approach,
            distance,
        } = self;
        let place = position.map_or_else(String::new, |[x, y, z]| format!(" at ({x}, {y}, {z}) m"));
        write!(
            f,
            "bodies {master} and {slave} approach by {approach} m in one step{place}, more than the {distance} m \
             at which that is seen; accepted: a smaller time step"
        )
    }
}

impl std::error::Error for Tunnelling {}

impl InteractionFault for Tunnelling {
    fn bodies(&self) -> Option<[i64; 2]> {
        Some(self.bodies)
    }
}
