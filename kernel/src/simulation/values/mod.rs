//! Values of a simulation: its state, what a step reports, errors, events and balances. None of them knows the cycle.

mod absorbing;
mod body;
mod clock;
mod energy;
mod error;
mod event;
mod extremes;
mod free_ground;
mod handle;
mod invariants;
mod mass_center;
mod nodal_force;
mod particle_at;
mod sharing_refusal;
mod spin;
mod state;
mod tension;

pub use absorbing::AbsorbingNode;
pub use body::BodyRun;
pub use clock::{Bound, Clock, Drift, StepInfo};
pub use energy::{BodyEnergy, Energy};
pub use error::{
    InitialOverlap, InteractionError, InteractionFault, MESH, SetupError, StepError, StepErrorKind,
    TimeStepAboveCritical,
};
pub use event::{Event, EventKind};
pub use extremes::{Extremes, MOST_STRETCH_RATIO};
pub use free_ground::FreeGroundNode;
pub use handle::BodyHandle;
pub(super) use invariants::ROUND_OFF;
pub use invariants::{Invariant, InvariantMonitor, Violation};
pub(crate) use invariants::{MOST_GAIN, MOST_INCREMENT, MOST_LOST_MOMENTUM, MOST_VOLUME_RATIO};
pub use mass_center::MassCenter;
pub use nodal_force::NodalForce;
pub use particle_at::ParticleAt;
pub use sharing_refusal::SharingRefusal;
pub use spin::Spin;
pub use state::{EnergyLedger, Groups, RestoreError, SavedArrays, SavedState, State};
pub(crate) use tension::MOST_UNSEEN;
pub use tension::Tension;
