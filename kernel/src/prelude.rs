//! What a program that simulates a scene of its own needs: `use proctor_kernel::prelude::*;`.

pub use crate::scene::{
    Body, Contact, ContactNormal, Damping, Dimension, History, Law, Mesh, PlaneCondition, Scene,
    Shape, StartError, StressScheme, TimeStep, Transfer, TransferKind, Vector, Weighting,
};
pub use crate::simulation::{
    Acting, Condition, FieldNodes, Grid, Interaction, Node, Now, OnSlab, Options, Simulation, Slab,
    StepError, StepInfo, Visit,
};
pub use crate::stage::solve::{EmptyNode, PlaneSums};
