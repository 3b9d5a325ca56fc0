//! The explicit cycle of a model: its state, its steps, and queries of them.

mod change;
mod clock;
pub(crate) mod conditions;
mod context;
mod ground;
pub(crate) mod interactions;
mod mapping;
mod model;
mod monitor;
mod nodes;
mod phase;
mod ranks;
mod start;
mod state;
mod state_hash;
mod step;
mod step_view;
mod tension;
mod values;
mod water;
mod work_state;

pub use crate::fields::{Grid, Owner, Slab, SlabField, VelocityField};
pub use crate::grid::{GridShape, Line};
pub use crate::history::{BaseVelocity, Displacement, value as history_value};
pub use crate::stage::solve::{DashpotNode, EmptyNode, ExactStepSums, Planes, StepSum, StepSums};
pub use conditions::{describe as describe_conditions, nodes_of_traction, of as conditions};
pub use context::{
    Condition, FieldNodes, NOT_LOCAL, NodalConditions, Node, Remap, StepContext, VelocityMapping,
    at_half_step_after,
};
pub use interactions::{
    BalanceTraits, BodyList, Interaction, InteractionClone, Interactions, OwnLines, PairList,
    SharedSlabInteraction, SlabInteraction, SlabMemory, SlabPart,
};
pub use mapping::{NodeWeights, node_weights, node_weights_touching};
pub use monitor::result_quality::{MOST_REMAINDER, ResultQuality};
pub use nodes::NodeValues;
pub use phase::Phase;
use ranks::Share;
pub use ranks::{OwnPart, PartOfSet, RankForecast};
pub use start::Start;
pub use step::rehearsal::{Part, Rehearsal};
pub use step_view::{StepUpdate, StepView};
pub use values::{
    AbsorbingNode, BodyEnergy, BodyHandle, BodyRun, Bound, Clock, Drift, Energy, EnergyLedger,
    Event, EventKind, Extremes, FreeGroundNode, Groups, InitialOverlap, InteractionError,
    InteractionFault, Invariant, InvariantMonitor, MESH, MOST_STRETCH_RATIO, MassCenter,
    NodalForce, ParticleAt, RestoreError, SavedArrays, SavedState, SetupError, SharingRefusal,
    Spin, State, StepError, StepErrorKind, StepInfo, Tension, TimeStepAboveCritical, Violation,
};

pub use model::Model;
use work_state::WorkState;

use crate::model::Vector;
use crate::particles::ParticleSet;
use std::sync::Arc;

/// Body force per mass \[m/s²\] of a particle that began at `x_0` and is at `x` at time `t`.
pub type BodyForce = Arc<dyn Fn(&Vector, &Vector, f64) -> Vector + Send + Sync>;

/// The explicit cycle of a model: the model, its state, and the work state of a step.
pub struct Cycle {
    pub(crate) model: Model,
    pub(crate) state: State,
    pub(crate) work: WorkState,
}

impl Cycle {
    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Particle sets, one per body, in the order of the scene.
    #[must_use]
    pub fn sets(&self) -> &[ParticleSet] {
        &self.state.sets
    }

    /// Number of particles; of all ranks, where they share the simulation.
    #[must_use]
    pub fn particles(&self) -> usize {
        let here = || self.state.sets.iter().map(ParticleSet::len).sum();
        self.work.share.as_ref().map_or_else(here, Share::particles)
    }

    /// Number of nodes that particles can reach until the next sort.
    #[must_use]
    pub fn nodes_active(&self) -> usize {
        self.work.grid.fields[0].rows.count()
    }

    /// Time of positions and stresses \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.clock.time
    }

    /// Time of the velocities, half a step before that of the positions \[s\] (leapfrog).
    #[must_use]
    pub fn velocity_time(&self) -> f64 {
        self.state.clock.time - 0.5 * self.state.clock.dt_before
    }

    /// Number of steps done.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.state.clock.step
    }

    /// Events so far.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.state.events
    }

    /// Time and step counter, with the smallest and largest time step so far.
    #[must_use]
    pub fn clock(&self) -> &Clock {
        &self.state.clock
    }

    /// Takes steps up to a time \[s\]; a constant time step may pass it by less than half a step.
    ///
    /// # Errors
    /// The first error of a step: see [`Cycle::step`].
    pub fn run_until(&mut self, time: f64) -> Result<(), StepError> {
        self.led(|cycle| {
            while cycle.time() < time {
                cycle.step(time)?;
            }
            Ok(())
        })
    }

    /// The body with this identifier in the scene.
    #[must_use]
    pub fn body_with_id(&self, id: i64) -> Option<BodyHandle> {
        let place = self.model.bodies.iter().position(|body| body.id == id);
        place.map(BodyHandle::from)
    }

    /// A body: its identifiers, law and motion.
    #[must_use]
    pub fn body(&self, body: impl Into<BodyHandle>) -> &BodyRun {
        &self.model.bodies[body.into().place()]
    }

    /// Particles of a body.
    #[must_use]
    pub fn particles_of(&self, body: impl Into<BodyHandle>) -> &ParticleSet {
        &self.state.sets[body.into().place()]
    }

    /// Lower corner of the mesh now \[m\]. A base that moves along its normal takes the mesh with it.
    #[must_use]
    pub fn origin(&self) -> Vector {
        std::array::from_fn(|axis| {
            self.model.settings.mesh.origin[axis] + self.state.mesh_shift[axis]
        })
    }

    /// Position of a particle in the coordinates of the scene \[m\].
    #[must_use]
    pub fn position(&self, body: impl Into<BodyHandle>, p: usize) -> Vector {
        let x = self.particles_of(body).position(p);
        std::array::from_fn(|axis| x[axis] + self.origin()[axis])
    }
}
