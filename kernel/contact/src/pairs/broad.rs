//! The broad phase: which pairs of bodies may share a node before the next sort.

use super::Pair;
use proctor_kernel::grid::{GHOSTS_BELOW, GridShape};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::weights::base_node;
use smallvec::SmallVec;

/// Nodes along an axis of the scene that the particles of a body can reach until the next sort, first and last.
///
/// A particle may cross one cell before the next sort, so they are widened by one cell each way. Nodes that mirror its
/// ghosts lie between them.
#[must_use]
pub fn reach(set: &ParticleSet, shape: &GridShape, stencil: usize, axis: usize) -> (f64, f64) {
    let (low, high) = if axis == 0 {
        // The order of the particles knows their layers along the slow axis.
        let occupied = |layer: &usize| set.layers[*layer] < set.layers[*layer + 1];
        let layers = 0..set.layers.len() - 1;
        let first = layers.clone().find(occupied).unwrap_or(0);
        let last = layers.rev().find(occupied).unwrap_or(0);
        let base = |layer: usize| layer as f64 - GHOSTS_BELOW as f64;
        (base(first), base(last))
    } else {
        let x = &set.columns[Layout::POSITION + axis];
        let base = |x: f64| base_node(x * (1.0 / shape.cell[axis]), stencil);
        (
            base(x.iter().copied().fold(f64::INFINITY, f64::min)),
            base(x.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
        )
    };
    (low - 1.0, high + stencil as f64)
}

/// Finds which pairs are near: their boxes of nodes meet. One axis after the other, so that bodies far apart along the first
/// cost next to nothing.
pub fn near(
    pairs: &[Pair],
    sets: &[ParticleSet],
    shape: &GridShape,
    stencil: usize,
    near: &mut Vec<bool>,
) {
    let none: [Option<(f64, f64)>; 3] = [None; 3];
    let mut known: SmallVec<[_; 8]> = SmallVec::from_elem(none, sets.len());
    let mut meet = |pair: &Pair, axis: usize| {
        let [a, b] = [pair.master, pair.slave].map(|body| {
            *known[body][axis].get_or_insert_with(|| reach(&sets[body], shape, stencil, axis))
        });
        a.0 <= b.1 && b.0 <= a.1
    };
    near.clear();
    near.extend(
        pairs
            .iter()
            .map(|pair| (0..shape.axes).all(|axis| meet(pair, axis))),
    );
}
