//! Loads on the bodies from outside: base motion, forces, tractions.

use super::{Mesh, Vector};
use std::ops::Range;

/// A vector given at times, linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Times \[s\], strictly increasing.
    pub times: Vec<f64>,
    /// Values at the times; constant before the first and after the last.
    pub values: Vec<Vector>,
}

impl History {
    /// The value, where it is one at all times.
    #[must_use]
    pub fn constant(&self) -> Option<Vector> {
        match self.values[..] {
            [value] => Some(value),
            _ => None,
        }
    }

    /// True where all values are zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.values.iter().all(|value| *value == [0.0; 3])
    }

    /// True where values change at a time or after it.
    #[must_use]
    pub fn changes_from(&self, time: f64) -> bool {
        let last = self.times.last();
        self.constant().is_none() && last.is_some_and(|last| time <= *last)
    }
}

impl From<Vector> for History {
    /// A value that is one at all times.
    fn from(value: Vector) -> Self {
        Self {
            times: vec![0.0],
            values: vec![value],
        }
    }
}

/// Prescribed motion of one boundary plane of the mesh. Along its normal the plane takes the mesh with it, and with
/// the mesh the plane opposite and all loads that are fixed to nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseMotion {
    /// Axis of the normal of the plane.
    pub axis: usize,
    /// 0 the lower, 1 the upper plane of that axis.
    pub side: usize,
    /// Motion that is prescribed.
    pub motion: Motion,
}

/// The ground that goes on beyond the absorbing planes of the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundBeyond {
    /// The wave that comes in through one of them: its plane, and the motion of the ground in that wave alone, which is half of
    /// that of an outcrop.
    pub incoming: Option<BaseMotion>,
    /// Thickness of the ground for which springs stand, beside the dashpots \[m\]; `None` without springs.
    pub thickness: Option<f64>,
}

/// A prescribed motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Acceleration \[m/s²\], linear between the times, zero before the first and after the last: velocity
    /// is kept when the record ends. Velocity starts at zero.
    Acceleration(History),
    /// Velocity \[m/s\], linear between the times, constant outside.
    Velocity(History),
}

/// A box in which all nodes of the mesh, those on its faces too, stand still whatever acts on them: a clamp that is
/// smaller than a plane of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldBox {
    /// Lower corner \[m\].
    pub p1: Vector,
    /// Upper corner \[m\]; may equal `p1`.
    pub p2: Vector,
}

/// Force on one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLoad {
    /// Position of the node \[m\].
    pub position: Vector,
    /// Force \[N\]; per metre of thickness in two dimensions.
    pub force: Vector,
}

/// Traction on an axis-aligned rectangle (a segment in two dimensions) fixed in space, uniform there.
#[derive(Clone, Debug, PartialEq)]
pub struct Traction {
    /// Lower corner \[m\].
    pub p1: Vector,
    /// Upper corner \[m\]; equal to `p1` along exactly one axis, the normal.
    pub p2: Vector,
    /// Traction \[Pa\].
    pub traction: History,
}

/// Total force spread by volume over the particles in a box at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxLoad {
    /// Lower corner \[m\].
    pub p1: Vector,
    /// Upper corner \[m\].
    pub p2: Vector,
    /// Total force \[N\].
    pub force: Vector,
}

impl HeldBox {
    /// Numbers along an axis of the nodes of the mesh that the box holds.
    #[must_use]
    pub fn nodes_along(&self, mesh: &Mesh, axis: usize) -> Range<usize> {
        let cells = |x: f64| (x - mesh.origin[axis]) / mesh.cell[axis];
        let tolerance = mesh.tolerance(axis) / mesh.cell[axis];
        let first = (cells(self.p1[axis]) - tolerance).ceil().max(0.0);
        let last = (cells(self.p2[axis]) + tolerance).floor();
        let last = last.min(mesh.cells[axis] as f64);
        first as usize..(last + 1.0).max(first) as usize
    }
}
