//! Source of the quantities that are mapped, and the lines in which they stand.

use super::{Carry, SumForm};
use crate::layout::Layout;
use crate::stage::Mapping;

/// Source of the quantities, and the choice of them.
pub(super) struct P2gSource<'a> {
    /// Columns of the set.
    pub columns: &'a [Vec<f64>],
    /// Layout of the columns.
    pub layout: &'a Layout,
    /// View of the grid by the set.
    pub mapping: &'a Mapping,
    /// Quantities that are carried.
    pub carry: Carry,
    /// Rate of viscous damping \[1/s\]; 0 for none.
    pub viscous_rate: f64,
    /// Form of the sums.
    pub sums: SumForm,
    /// Factor of the stress.
    pub stress_factor: f64,
}

/// Line of the terms that go with the derivative along an axis: 1 slow, 2 middle, 3 fast.
#[inline(always)]
pub(super) const fn line_of<const D: usize>(axis: usize) -> usize {
    if axis + 1 == D { 3 } else { axis + 1 }
}

/// Line and upper lane of component `c` of what goes with the derivative along an axis. Without affine terms the slow axis
/// shares line 0, whose upper lanes are free. In the plane what goes with the fast axis lies in lanes of its own
/// ([`join`](super::join)), and without affine terms in line 0 as well.
#[inline(always)]
pub(super) const fn place_of<const D: usize, const FULL: bool>(
    axis: usize,
    c: usize,
) -> (usize, usize) {
    let lane = if D == 2 && axis == 1 { 2 + c } else { c };
    let line = if !FULL && (D == 2 || axis == 0) {
        0
    } else {
        line_of::<D>(axis)
    };
    (line, lane)
}
