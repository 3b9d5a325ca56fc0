//! The model of a scene: immutable in a step, changed only between two stages.

use super::conditions::Condition;
use super::{BaseVelocity, BodyForce};
use crate::lanes::Selected;
use crate::laws::AnyLaw;
use crate::plan::Plan;
use crate::scene::{DomainUpdate, History, Scene, Vector};
use crate::stage::Mapping;
use crate::weights::Family;
use std::sync::Arc;

/// The model: a step reads it and leaves it as it is.
pub(crate) struct Model {
    pub(crate) scene: Scene,
    pub(crate) plan: Plan,
    pub(crate) lanes: Selected,
    /// The bodies, in the order of the scene.
    pub(crate) bodies: Vec<BodyRun>,
    /// What acts at the nodes from outside; those of the user come last.
    pub(crate) conditions: Vec<Arc<dyn Condition>>,
    pub(crate) own_conditions: Vec<Arc<dyn Condition>>,
    /// Whether the user has added conditions or interactions.
    pub(crate) has_own: bool,
    pub(crate) base: Option<BaseVelocity>,
    pub(crate) body_force: Option<BodyForce>,
    /// What box loads accelerate a particle by, at most \[m/s²\].
    pub(crate) load_acceleration: f64,
}

impl Model {
    /// Weighting functions of all bodies.
    pub(crate) fn family(&self) -> Family {
        self.scene.weighting.kind().family
    }
}

/// A body in the cycle, beside its particles.
#[derive(Clone, Debug)]
pub struct BodyRun {
    /// Identifier.
    pub id: i64,
    /// Identifier of its material.
    pub material_id: i64,
    /// Its law.
    pub law: AnyLaw,
    /// Initial density \[kg/m³\].
    pub density: f64,
    /// Its weighting functions.
    pub mapping: Mapping,
    /// Update of its particle domains, where they follow the deformation.
    pub domain_update: Option<DomainUpdate>,
    /// Its prescribed velocity, where it has one.
    pub motion: Option<History>,
    /// Whether its motion has been prescribed since the start, so that its shape has only moved.
    pub keeps_shape: bool,
    /// Rate of viscous damping \[1/s\].
    pub viscous_rate: f64,
    /// Half-lengths of its particles at the start \[m\], the mean where they differ.
    pub particle_half_length: Vector,
    /// Half-lengths of the particle domains \[m\] where all have the same; `None` where they differ or the weighting
    /// function has no domain.
    pub reach: Option<[f64; 3]>,
}
