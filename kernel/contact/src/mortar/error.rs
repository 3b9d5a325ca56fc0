//! Errors of mortar contact in a step.

use proctor_kernel::simulation::InteractionFault;
use std::fmt;

/// An error of mortar contact, by which a step cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub enum MortarError {
    /// The boundaries of a contact come closer in one step by more than half the critical gap.
    ClosingTooFast {
        /// Identifiers of master and slave.
        bodies: [i64; 2],
        /// Vertex of the slave, from 0, and where it is \[m\]; `None` where the boundaries move too fast to be compared
        /// vertex by vertex.
        vertex: Option<(usize, [f64; 3])>,
        /// Approach in the step \[m\].
        approach: f64,
        /// Largest approach that cannot be missed \[m\].
        allowed: f64,
    },
    /// The boundaries of a contact are deeper in each other than the critical gap.
    Penetration {
        /// Identifiers of master and slave.
        bodies: [i64; 2],
        /// Vertex of the slave, from 0.
        vertex: usize,
        /// Position of the vertex of the slave \[m\].
        position: [f64; 3],
        /// Weighted gap \[m\].
        gap: f64,
    },
    /// Sharp edges of two boundaries meet, which mortar contact between faces does not see (3D).
    EdgesMeet {
        /// Identifiers of master and slave.
        bodies: [i64; 2],
        /// Place on the edge of the slave \[m\].
        position: [f64; 3],
        /// Distance of the edges, negative when past each other \[m\].
        distance: f64,
    },
    /// A vertex of a boundary has no node with mass near it, or particles that it is tied to are gone.
    VertexLost {
        /// Identifier of the body.
        body: i64,
        /// Number of the vertex, from 0.
        vertex: usize,
        /// Place of the vertex \[m\].
        position: [f64; 3],
    },
}

impl InteractionFault for MortarError {
    fn bodies(&self) -> Option<[i64; 2]> {
        match self {
            Self::ClosingTooFast { bodies, .. }
            | Self::Penetration { bodies, .. }
            | Self::EdgesMeet { bodies, .. } => Some(*bodies),
            Self::VertexLost { .. } => None,
        }
    }
}

impl std::error::Error for MortarError {}

impl fmt::Display for MortarError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ClosingTooFast {
                bodies: [master, slave],
                vertex,
                approach,
                allowed,
            } => {
                let place = vertex.map_or_else(String::new, |(vertex, [x, y, z])| {
                    format!(" at vertex {vertex} of {slave}, ({x}, {y}, {z}) m")
                });
                write!(
                    f,
                    "{slave} closes on {master} by {approach} m in one step{place}, more than the {allowed} m that cannot be \
                     missed; accepted: a smaller time step or a larger critical gap"
                )
            }
            Self::Penetration {
                bodies: [master, slave],
                vertex,
                position: [x, y, z],
                gap,
            } => write!(
                f,
                "bodies {master} and {slave} are in each other at vertex {vertex} of {slave}, ({x}, {y}, {z}) m: the gap is \
                 {gap} m; accepted: a stiffer contact, a larger critical gap or a smaller time step"
            ),
            Self::EdgesMeet {
                bodies: [master, slave],
                position: [x, y, z],
                distance,
            } => write!(
                f,
                "a sharp edge of {slave} crosses one of {master} at ({x}, {y}, {z}) m, {distance} m apart; accepted: faces \
                 that meet faces, since mortar contact does not see edges"
            ),
            Self::VertexLost {
                body,
                vertex,
                position: [x, y, z],
            } => write!(
                f,
                "vertex {vertex} of the boundary of body {body} at ({x}, {y}, {z}) m has lost its body: no node with mass is near it, or particles around it are gone; accepted: \
                 vertices that lie on the body, and a body that does not fall apart"
            ),
        }
    }
}
