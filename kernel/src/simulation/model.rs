//! The model of a simulation: immutable in a step, changed only between two stages.

use super::{BaseVelocity, BodyForce};
use crate::lanes::SelectedLanes;
use crate::model::CycleSettings;
use crate::plan::Plan;
use crate::simulation::context::Condition;
use crate::simulation::values::BodyRun;
use crate::weights::Family;
use std::sync::Arc;

/// The model: a step reads it and leaves it as it is.
#[derive(Clone)]
pub struct Model {
    /// Mesh, method, loads and boundary conditions.
    pub settings: CycleSettings,
    /// Plan of the simulation.
    pub plan: Plan,
    /// Lanes in use.
    pub lanes: SelectedLanes,
    /// The bodies.
    pub bodies: Vec<BodyRun>,
    /// Conditions at the nodes; those of the user come last. See [`conditions`](super::conditions).
    pub conditions: Vec<Arc<dyn Condition>>,
    /// Conditions of the user alone.
    pub own_conditions: Vec<Arc<dyn Condition>>,
    /// True if the user has added conditions or interactions.
    pub has_own: bool,
    /// Velocity of the base, where one moves.
    pub base: Option<BaseVelocity>,
    /// Velocity of the wave that comes in through an absorbing plane, where one does.
    pub incoming: Option<BaseVelocity>,
    /// Body force as a function, where one is given.
    pub body_force: Option<BodyForce>,
}

impl Model {
    /// Weighting functions of all bodies.
    pub(crate) fn family(&self) -> Family {
        self.settings.weighting.kind().family
    }
}
