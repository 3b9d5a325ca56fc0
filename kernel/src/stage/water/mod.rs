//! Pore water of particles and nodes: the stages beside those of the skeleton, in plain numbers.

mod mapping;
mod point;

pub use mapping::{WaterP2g, map};
pub use point::PointNodes;
