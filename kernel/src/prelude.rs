//! Prelude for a program that simulates a scene of its own: `use proctor_kernel::prelude::*;`.

pub use crate::lanes::Lanes;
pub use crate::laws::{AnyLaw, Increment, Law, Particle};
pub use crate::layout::Variable;
pub use crate::scene::{
    Body, Contact, ContactNormal, Damping, Dimension, History, Mesh, PlaneCondition, Scene, Shape,
    StressScheme, TimeStep, Transfer, TransferKind, Vector, VolumetricStrain, Weighting,
};
pub use crate::simulation::{
    BodyList, Condition, EmptyNode, FieldNodes, Grid, InitialState, Interaction, InteractionError,
    InteractionFault, NodalConditions, Node, Options, PairList, PlaneSums, Simulation, Slab,
    SlabInteraction, SlabPart, StepContext, StepError, StepInfo, StepUpdate, StepView,
    VelocityMapping,
};
