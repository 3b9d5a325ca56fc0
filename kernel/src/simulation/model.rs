//! The model of a scene: immutable in a step, changed only between two stages.

use super::{BaseVelocity, BodyForce};
use crate::lanes::Selected;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::simulation::context::Condition;
use crate::simulation::values::BodyRun;
use crate::weights::Family;
use std::sync::Arc;

/// The model: a step reads it and leaves it as it is.
pub(crate) struct Model {
    pub(crate) scene: Scene,
    pub(crate) plan: Plan,
    pub(crate) lanes: Selected,
    /// The bodies, in the order of the scene.
    pub(crate) bodies: Vec<BodyRun>,
    /// Conditions at the nodes; those of the user come last.
    pub(crate) conditions: Vec<Arc<dyn Condition>>,
    pub(crate) own_conditions: Vec<Arc<dyn Condition>>,
    /// True if the user has added conditions or interactions.
    pub(crate) has_own: bool,
    pub(crate) base: Option<BaseVelocity>,
    pub(crate) body_force: Option<BodyForce>,
    /// Largest acceleration of a particle by box loads \[m/s²\].
    pub(crate) load_acceleration: f64,
}

impl Model {
    /// Weighting functions of all bodies.
    pub(crate) fn family(&self) -> Family {
        self.scene.weighting.kind().family
    }
}
