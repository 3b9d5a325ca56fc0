//! Prelude for a program that simulates a scene of its own: `use proctor_scene::prelude::*;`.

pub use crate::running::Simulation;
pub use crate::setup::{InitialState, Options};
pub use crate::values::{Body, BodyEntry, Scene};
pub use proctor_contact::{Contact, ContactHandle, ContactNormal, SurfaceHandle};
pub use proctor_kernel::lanes::Lanes;
pub use proctor_kernel::laws::{AnyLaw, Component, Increment, Law, Particle, Stress};
pub use proctor_kernel::layout::Variable;
pub use proctor_kernel::model::{
    Damping, Dimension, History, Mesh, PlaneCondition, Shape, StressScheme, TimeStep, Transfer,
    TransferKind, Vector, VolumetricStrain, Weighting,
};
pub use proctor_kernel::simulation::{
    BodyHandle, BodyList, Condition, EmptyNode, ExactStepSums, FieldNodes, Grid, Interaction,
    InteractionError, InteractionFault, NodalConditions, Node, PairList, Slab, SlabInteraction,
    SlabPart, StepContext, StepError, StepInfo, StepSum, StepSums, StepUpdate, StepView,
    VelocityMapping,
};
pub use proctor_laws::{Hencky, LinearElastic, NeoHookean, ObjectiveRate, Point, check_law};
