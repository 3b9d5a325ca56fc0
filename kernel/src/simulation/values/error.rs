//! Errors at set-up and in a step.

use super::invariants::Violation;
use super::sharing_refusal::SharingRefusal;
use super::tension::Tension;
use crate::memory::OutOfMemory;
use crate::model::POROSITIES;
use crate::number::Number;
use crate::simulation::values::ParticleAt;
use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// Key of the number of nodes in a scene.
pub const MESH: &str = "mesh.cells_number";

/// A simulation cannot be set up from this scene. All are faults of the input.
#[derive(Clone, Debug, PartialEq)]
pub enum SetupError {
    /// A body could not be filled with particles.
    Body {
        /// Name of the body.
        body: String,
        /// Reason.
        reason: String,
    },
    /// The machine lacks the lanes that were asked for.
    Lanes(crate::lanes::LanesUnavailable),
    /// The prescribed time step is above the critical one at the start.
    UnstableTimeStep(TimeStepAboveCritical),
    /// A load does not fit the mesh, or a material does not bear an initial stress.
    Load {
        /// The load, as a path into the scene.
        path: String,
        /// Reason.
        reason: String,
    },
    /// The mesh has more nodes or the scene more particles than can be numbered.
    TooLarge {
        /// The items that are too many, and their number.
        what: String,
    },
    /// Something needs more memory than there is.
    Memory {
        /// Key that decides the size, as a path into the scene.
        path: String,
        /// Shortage: the purpose, the bytes needed, and the bytes there are.
        error: OutOfMemory,
    },
    /// Ranks that were to share the simulation cannot.
    Ranks(SharingRefusal),
    /// The thread pool could not be made.
    Threads(String),
    /// Pairs of contact whose bodies overlap at the start.
    Overlap(Vec<InitialOverlap>),
    /// An interaction that cannot be set up, such as a boundary of contact.
    Interaction {
        /// Its place, as in the scene.
        path: String,
        /// Reason.
        reason: String,
    },
    /// A change between two stages that cannot be made.
    Change {
        /// The value that was to be changed.
        what: String,
        /// Reason of the refusal.
        reason: String,
    },
}

/// Two bodies in contact that overlap at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialOverlap {
    /// Name of the contact, as a path into the scene.
    pub contact: String,
    /// Identifiers of master and slave.
    pub bodies: [i64; 2],
    /// Depth \[m\].
    pub depth: f64,
    /// Place of the deepest overlap \[m\].
    pub position: [f64; 3],
}

/// A time step above the critical one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeStepAboveCritical {
    /// Time step \[s\].
    pub dt: f64,
    /// Critical time step of the scheme \[s\].
    pub critical: f64,
    /// Largest wave speed \[m/s\].
    pub wave_speed: f64,
    /// Largest particle speed \[m/s\].
    pub particle_speed: f64,
    /// Largest acceleration of a particle by gravity and box loads \[m/s²\].
    pub acceleration: f64,
    /// Largest rate of viscous damping \[1/s\].
    pub viscous_rate: f64,
    /// Factor of local damping.
    pub local_damping: f64,
}

impl fmt::Display for TimeStepAboveCritical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "time step {:e} s is above the critical time step {:e} s of this scheme (wave speed {} m/s, \
             particle speed {} m/s",
            self.dt,
            self.critical,
            Number(self.wave_speed),
            Number(self.particle_speed)
        )?;
        if self.acceleration > 0.0 {
            write!(f, ", acceleration {} m/s2", Number(self.acceleration))?;
        }
        if self.viscous_rate > 0.0 {
            let rate = Number(self.viscous_rate);
            write!(f, ", viscous damping at a rate of {rate} 1/s")?;
        }
        if self.local_damping > 0.0 {
            let factor = Number(self.local_damping);
            write!(f, ", local damping with a factor of {factor}")?;
        }
        let less = if self.viscous_rate > 0.0 || self.local_damping > 0.0 {
            " or less damping"
        } else {
            ""
        };
        write!(
            f,
            "); accepted: a smaller step{less}, or \"allow_unstable\": true"
        )
    }
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body { body, reason } => write!(f, "body \"{body}\": {reason}"),
            Self::Lanes(lanes) => lanes.fmt(f),
            Self::UnstableTimeStep(unstable) => unstable.fmt(f),
            Self::Load { path, reason } | Self::Interaction { path, reason } => {
                write!(f, "{path}: {reason}")
            }
            Self::TooLarge { what } => write!(f, "{what}"),
            Self::Memory { path, error } if path == MESH => {
                write!(f, "{path}: {error}: fewer cells, or larger ones")
            }
            Self::Memory { path, error } => write!(f, "{path}: {error}"),
            Self::Ranks(refusal) => refusal.fmt(f),
            Self::Threads(reason) => write!(f, "threads: {reason}"),
            Self::Overlap(all) => {
                for (
                    i,
                    InitialOverlap {
                        contact,
                        bodies: [master, slave],
                        depth,
                        position,
                    },
                ) in all.iter().enumerate()
                {
                    let line = if i > 0 { "\n" } else { "" };
                    write!(
                        f,
                        "{line}{contact}: the bodies {master} and {slave} overlap by {} m at {position:?} m; \
                         accepted: bodies that touch at most",
                        Number(*depth)
                    )?;
                }
                Ok(())
            }
            Self::Change { what, reason } => write!(f, "{what}: {reason}"),
        }
    }
}

impl std::error::Error for SetupError {}

/// A step failed. The state is not to be used after it.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// Number of the step that failed, from 1.
    pub step: u64,
    /// Time at its beginning \[s\].
    pub time: f64,
    /// Kind of the error.
    pub kind: StepErrorKind,
}

/// Kind of an error in a step.
#[derive(Clone, Debug, PartialEq)]
pub enum StepErrorKind {
    /// A particle has a value that is not finite.
    NotFinite(ParticleAt),
    /// A law gave a particle a stress or an internal variable that is not finite, where all else of it is.
    Law {
        /// The particle.
        particle: ParticleAt,
        /// Name of the law.
        law: &'static str,
        /// The stress component, or the internal variable by its name.
        column: String,
    },
    /// A particle's volume is zero or negative.
    Inverted(ParticleAt),
    /// A particle left the mesh.
    Outside(ParticleAt),
    /// The prescribed time step exceeds the critical one.
    UnstableTimeStep(TimeStepAboveCritical),
    /// A time step so short that the time stays what it is.
    TimeStands {
        /// Time step \[s\].
        dt: f64,
    },
    /// All particles have left the mesh, and there is no time to step to.
    NothingLeft,
    /// A load acts where no particle reaches.
    LoadOnEmptyNode {
        /// The load, as a path into the scene; `None` where it is none of the scene's.
        load: Option<String>,
        /// Position of the node \[m\].
        position: [f64; 3],
    },
    /// An interaction cannot go on.
    Interaction(InteractionError),
    /// A balance does not hold, and the scene asks to stop then.
    NotTrusted(Violation),
    /// A body is in tension, which FLIP does not hold with MUSL or USF.
    Tension(Tension),
    /// The material at an absorbing plane moved off it by half a cell.
    OffAbsorbingPlane {
        /// Axis of the normal, and 0 for the lower or 1 for the upper plane.
        plane: (usize, usize),
        /// Mean displacement along the normal \[m\].
        displacement: f64,
    },
    /// The porosity of a particle became one that no soil has.
    Porosity {
        /// The particle.
        particle: ParticleAt,
        /// Its porosity.
        porosity: f64,
    },
    /// Particles reach nodes for which there is no memory.
    Memory(OutOfMemory),
    /// Another rank cannot go on; it has the error.
    OtherRank {
        /// Its number, from 0.
        rank: usize,
    },
    /// Copies of particles have other values than their owner has: memory is wrong, or programs differ.
    RanksDisagree {
        /// The rank that found it.
        rank: usize,
    },
    /// A cpGIMP domain grew beyond one cell, where the weights are no longer a partition of unity.
    DomainTooLarge {
        /// Half-length in cells.
        half_length: f64,
    },
}

impl StepErrorKind {
    /// The fault of an interaction, if it is one of this type.
    #[must_use]
    pub fn fault<T: InteractionFault>(&self) -> Option<&T> {
        match self {
            Self::Interaction(error) => error.fault(),
            _ => None,
        }
    }

    /// True if particles are left outside the mesh or with values that no step can go on with.
    pub(in crate::simulation) fn breaks_particles(&self) -> bool {
        matches!(
            self,
            Self::NotFinite(_)
                | Self::Law { .. }
                | Self::Inverted(_)
                | Self::Outside(_)
                | Self::DomainTooLarge { .. }
        )
    }
}

/// A fault that an interaction finds in a step: an error type of its own.
pub trait InteractionFault: std::error::Error + Any + Send + Sync {
    /// Identifiers of master and slave, where the fault lies between two bodies of a contact.
    fn bodies(&self) -> Option<[i64; 2]> {
        None
    }
}

/// An error of an interaction, by which a step cannot go on.
#[derive(Clone, Debug)]
pub struct InteractionError(Arc<dyn InteractionFault>);

impl InteractionError {
    /// The fault, if it is of this type.
    #[must_use]
    pub(crate) fn fault<T: InteractionFault>(&self) -> Option<&T> {
        let fault: &dyn Any = &*self.0;
        fault.downcast_ref()
    }

    /// Identifiers of master and slave, where the fault lies between two bodies of a contact.
    #[must_use]
    pub fn bodies(&self) -> Option<[i64; 2]> {
        self.0.bodies()
    }
}

impl<F: InteractionFault> From<F> for InteractionError {
    fn from(fault: F) -> Self {
        Self(Arc::new(fault))
    }
}

impl PartialEq for InteractionError {
    /// Faults of one type that say the same.
    fn eq(&self, other: &Self) -> bool {
        let [one, two] = [self, other].map(|error| {
            let fault: &dyn Any = &*error.0;
            fault.type_id()
        });
        one == two && self.to_string() == other.to_string()
    }
}

impl fmt::Display for InteractionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for InteractionError {}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}, time {} s: ", self.step, self.time)?;
        match &self.kind {
            StepErrorKind::NotFinite(p) => write!(f, "{p} has a value that is not finite"),
            StepErrorKind::Law {
                particle,
                law,
                column,
            } => write!(
                f,
                "the law {law} gave {particle} a {column} that is not finite"
            ),
            StepErrorKind::Inverted(p) => write!(f, "{p} is inverted: volume {} m3", p.volume),
            StepErrorKind::Outside(p) => {
                write!(
                    f,
                    "{p} left the mesh; accepted: a larger mesh, or \"outside\": \"remove\""
                )
            }
            StepErrorKind::UnstableTimeStep(unstable) => unstable.fmt(f),
            StepErrorKind::TimeStands { dt } => write!(
                f,
                "a time step of {dt:e} s does not move the time on; accepted: longer steps or a shorter time"
            ),
            StepErrorKind::NothingLeft => write!(
                f,
                "all particles have left the mesh; accepted: a larger mesh, or a time that ends before"
            ),
            StepErrorKind::LoadOnEmptyNode {
                load,
                position: [x, y, z],
            } => {
                let load = load.as_deref().unwrap_or("a load");
                write!(
                    f,
                    "{load} acts at ({x}, {y}, {z}) m, where no particle reaches; accepted: a load that bodies stay under, \
                     or a `box_load`, which moves with its particles"
                )
            }
            StepErrorKind::Interaction(error) => write!(f, "{error}"),
            StepErrorKind::NotTrusted(violation) => write!(f, "{violation}"),
            StepErrorKind::Tension(tension) => write!(f, "{tension}"),
            StepErrorKind::OffAbsorbingPlane {
                plane: (axis, side),
                displacement,
            } => write!(
                f,
                "the material at the absorbing plane {}{} has moved by {displacement} m along its normal, more than half a cell; \
                 its dashpots stay at the nodes. Waves of smaller amplitude, larger cells, or springs (\"absorbing_springs\") \
                 keep it there",
                ["X", "Y", "Z"][*axis],
                ["0", "n"][*side]
            ),
            StepErrorKind::Porosity { particle, porosity } => write!(
                f,
                "{particle} has a porosity of {porosity}; accepted: from {} to {}",
                POROSITIES[0], POROSITIES[1]
            ),
            StepErrorKind::Memory(error) => write!(f, "{error}"),
            StepErrorKind::OtherRank { rank } => write!(f, "rank {rank} cannot go on"),
            StepErrorKind::RanksDisagree { rank } => write!(
                f,
                "copies of particles on rank {rank} have other values than on the rank that owns them; accepted: the same program \
                 on all ranks, and memory without errors"
            ),
            StepErrorKind::DomainTooLarge { half_length } => write!(
                f,
                "a particle domain has a half-length of {half_length} cells; cpGIMP needs at most 1"
            ),
        }
    }
}

impl std::error::Error for StepError {}
