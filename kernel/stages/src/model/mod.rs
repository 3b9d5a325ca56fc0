//! Values that the cycle reads: the method, the mesh, loads and prescribed motions, in SI units.
//!
//! Vectors always have three components; in two dimensions (plane strain, x-y) the third is zero.

mod load;
mod method;
mod settings;
mod water;

pub use load::{BaseMotion, BoxLoad, GroundBeyond, HeldBox, History, Motion, PointLoad, Traction};
pub use method::{
    Damping, DomainUpdate, StressScheme, TimeStep, Transfer, TransferKind, VolumetricStrain,
    Weighting,
};
pub use proctor_geometry::mesh::{Mesh, PlaneCondition};
pub use proctor_geometry::shape::{Dimension, ParticleSeed, Shape, Vector};
pub use settings::{CycleSettings, OnImbalance, Outside, plane_acts};
pub use water::POROSITIES;
pub use water::{Permeability, PlanePressure, PoreWater, Shore, StandingWater};
