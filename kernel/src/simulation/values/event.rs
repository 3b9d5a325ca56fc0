//! Events of a run that went on.

use super::invariants::{LEAST_VOLUME_RATIO, MOST_VOLUME_RATIO};
use super::particle_at::ParticleAt;
use crate::model::Vector;
use std::fmt;

/// Something that happened in a run that went on.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Number of the step.
    pub step: u64,
    /// Time \[s\].
    pub time: f64,
    /// Kind of the event.
    pub kind: EventKind,
}

/// Kinds of events.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// A particle left the mesh and was removed.
    Removed(ParticleAt),
    /// The base record ended; the plane keeps its velocity.
    RecordEnded,
    /// Particle domains outgrew half a cell; from here on the stencil has four nodes per axis.
    WiderStencil,
    /// The first particle whose volume is less than a tenth of that of the start, or more than ten times it.
    VolumeRatio {
        /// The particle.
        particle: ParticleAt,
        /// Its volume over that of the start.
        ratio: f64,
    },
    /// Two bodies in contact on the grid overlap by more than a quarter of a cell, for the first time or by another quarter.
    Overlap {
        /// Identifiers of master and slave.
        bodies: [i64; 2],
        /// Node where they overlap deepest \[m\].
        position: Vector,
        /// Depth \[m\].
        depth: f64,
    },
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            EventKind::Removed(p) => {
                write!(f, "{p} left the mesh and was removed, mass {} kg", p.mass)
            }
            EventKind::RecordEnded => {
                write!(
                    f,
                    "the base record ended; zero acceleration from here, velocity kept"
                )
            }
            EventKind::WiderStencil => {
                write!(
                    f,
                    "a particle domain exceeded h/2; four nodes per axis from here"
                )
            }
            EventKind::VolumeRatio { particle, ratio } => write!(
                f,
                "{particle} has {ratio:.4e} of its volume at the start, the first one outside {LEAST_VOLUME_RATIO} to \
                 {MOST_VOLUME_RATIO}"
            ),
            EventKind::Overlap {
                bodies: [master, slave],
                position,
                depth,
            } => write!(
                f,
                "bodies {master} and {slave}, which are in contact, overlap by {depth:.4e} m at {position:?} m, more than a \
                 quarter of a cell; contact still drives them apart"
            ),
        }
    }
}
