//! Pore water in the stages: factors of its sums, and boundary planes of the mesh at which its pressure is given.

mod factors;

pub(super) use factors::{Derivatives, FactorKind, Factors, MOST, Weights};

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
    /// Pressure, compression positive \[Pa\].
    pub pressure: f64,
}

impl PressedPlane {
    /// Force along the axis with which the pressure pushes into a node \[N\], by its storage indices and the volume around it
    /// \[m³\], which fills half a cell; `None` for a node beside the plane.
    #[must_use]
    #[inline]
    pub(crate) fn force(&self, shape: &GridShape, at: [usize; 3], volume: f64) -> Option<f64> {
        let (plane, inwards) = if self.side == 0 {
            (GHOSTS_BELOW, 1.0)
        } else {
            (GHOSTS_BELOW + shape.cells[self.axis], -1.0)
        };
        let is_there = at[shape.direction(self.axis)] == plane;
        is_there.then(|| inwards * self.pressure * (2.0 * volume / shape.cell[self.axis]))
    }
}
