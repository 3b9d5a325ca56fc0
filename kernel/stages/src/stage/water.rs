//! Pore water in the stages: factors of its sums, and boundary planes of the mesh at which its pressure is given.

mod factors;

pub(super) use factors::{Derivatives, FactorKind, Factors, MOST, Weights, WholeFactors};

use crate::grid::{GHOSTS_BELOW, GridShape};

/// A boundary plane at which the pressure of the pore water is given; the water flows through it freely.
///
/// Tractions are total: what the surroundings push the water with, n of the pressure, they take from the skeleton.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressedPlane {
    /// Axis of the normal.
    pub axis: usize,
    /// 0 the lower, 1 the upper plane.
    pub side: usize,
    /// True where the surface of the ground is found beside the plane: the skeleton ends freely there, in domains that it fills.
    pub finds_surface: bool,
    /// Pressure.
    pub pressure: NodalPressure,
}

/// Pressure of the pore water at the nodes of a plane, compression positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodalPressure {
    /// The same at all of them \[Pa\].
    Uniform(f64),
    /// That of water at rest below a level.
    Rest {
        /// Axis that the level is a coordinate along.
        along: usize,
        /// The level from the lower boundary of the mesh \[m\].
        level: f64,
        /// Increase of the pressure along the axis, which gravity gives it \[Pa/m\].
        slope: f64,
    },
}

impl NodalPressure {
    /// Pressure at a node \[Pa\], by its storage indices.
    #[must_use]
    #[inline]
    pub fn at(&self, shape: &GridShape, at: [usize; 3]) -> f64 {
        match *self {
            Self::Uniform(pressure) => pressure,
            Self::Rest {
                along,
                level,
                slope,
            } => {
                let layer = at[shape.direction(along)] as f64 - GHOSTS_BELOW as f64;
                (slope * (layer * shape.cell[along] - level)).max(0.0)
            }
        }
    }
}
