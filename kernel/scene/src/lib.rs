//! Scenes: what is simulated, and the way from there to a simulation.
//!
//! Flow: [`Scene`] (checked values) -> [`plan`](plan::plan) (only what is needed) -> [`simulation::Simulation`] (particles, laws and
//! contact, put into the explicit cycle of the kernel).
//!
//! ```
//! use proctor_scene::prelude::*;
//!
//! // A block of 0.2 m falls freely for a tenth of a second.
//! let mut scene = Scene::plane([8, 16], 0.05).with_gravity([0.0, -10.0]);
//! let rubber = scene.add_material(LinearElastic::new(1e6, 0.3), 1000.0);
//! let block = scene.add_body(Shape::rectangle([0.1, 0.5], [0.3, 0.7]), rubber).handle();
//!
//! let mut simulation = scene.simulate(&Options::default())?;
//! simulation.run_until(0.1)?;
//! let center = simulation.center(block);
//! assert!((center.mass - 40.0).abs() < 1e-9);
//! assert!((center.position[1] - (0.6 - 0.5 * 10.0 * 0.1 * 0.1)).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! It reads and writes no files: `proctor-files`, the package above it, does, and needs nothing of it that another user of the
//! library could not have.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod plan;
pub mod prelude;
mod queries;
mod residual_motion;
mod result_warnings;
mod running;
mod setup;
mod start_error;
mod values;

pub use values::{
    Body, BodyEntry, Field, HeldPressure, InitialPressure, InitialStress, Location, MOST_CREEP,
    Material, NodalField, Overburden, Probe, ProbeTarget, ProbedQuantity, Problem, Results, Scene,
    SceneError, StateFile,
};
// What a scene is made of beside its own values.
pub use proctor_contact::{
    BodyBoundary, BoundaryHandle, Contact, ContactHandle, ContactNormal, Enforcement, Mortar,
    MortarContact, RigidFacets, RigidLine, RigidSurface, SurfaceHandle, Vertices,
};
pub use proctor_kernel::model::{
    BaseMotion, BoxLoad, Damping, Dimension, DomainUpdate, GroundBeyond, HeldBox, History, Mesh,
    Motion, OnImbalance, Outside, ParticleSeed, Permeability, PlaneCondition, PlanePressure,
    PointLoad, PoreWater, Shape, Shore, StandingWater, StressScheme, TimeStep, Traction, Transfer,
    TransferKind, Vector, VolumetricStrain, Weighting,
};

/// Simulations of scenes, with what the kernel and contact have for them.
pub mod simulation {
    pub use crate::plan::plan;
    pub use crate::residual_motion::ResidualMotion;
    pub use crate::result_warnings::ResultWarning;
    pub use crate::running::Simulation;
    pub use crate::setup::{
        InitialField, InitialState, MemoryEstimate, Options, StartBody, StartState,
        estimate_memory, missing_column,
    };
    pub use crate::start_error::StartError;
    pub use proctor_contact::{
        BoundaryDrift, BoundaryMesh, BoundaryVertex, MortarError, SurfaceContactError, Tunnelling,
        VertexState,
    };
    pub use proctor_kernel::simulation::*;
}
