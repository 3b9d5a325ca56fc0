//! Pore water of particles and nodes: the stages beside those of the skeleton, in plain numbers.

mod mapping;
mod planes;
mod point;

pub(crate) use mapping::{WaterP2g, map};
pub use planes::PressedPlane;
pub(crate) use point::PointNodes;
