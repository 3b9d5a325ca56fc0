//! The broad phase: which pairs of bodies may share a node before the next sort.

use super::Pair;
use crate::grid::GridShape;
use crate::particles::{Layout, ParticleSet};
use crate::weights::base_offset;

/// Nodes per axis of the scene that the particles of a body can reach until the next sort, first and last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeBox {
    first: [f64; 3],
    last: [f64; 3],
}

impl NodeBox {
    /// The box of a body. A particle may cross one cell before the next sort, so it is widened by one cell each way.
    /// Nodes that mirror its ghosts lie within it.
    #[must_use]
    pub fn new(set: &ParticleSet, shape: &GridShape, stencil: usize) -> Self {
        let (mut first, mut last) = ([0.0; 3], [0.0; 3]);
        for axis in 0..shape.axes {
            let x = &set.columns[Layout::POSITION + axis];
            let (low, high) = x
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
                    (low.min(x), high.max(x))
                });
            let base = |x: f64| (x * (1.0 / shape.cell[axis]) - base_offset(stencil)).floor();
            first[axis] = base(low) - 1.0;
            last[axis] = base(high) + stencil as f64;
        }
        Self { first, last }
    }

    /// Whether two boxes share a node.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| {
            self.first[axis] <= other.last[axis] && other.first[axis] <= self.last[axis]
        })
    }
}

/// Which pairs are near, and the bodies of near pairs.
#[must_use]
pub fn near(pairs: &[Pair], sets: &[ParticleSet], shape: &GridShape, stencil: usize) -> Vec<bool> {
    let mut boxes: Vec<Option<NodeBox>> = vec![None; sets.len()];
    pairs
        .iter()
        .map(|pair| {
            let [a, b] = [pair.master, pair.slave].map(|body| {
                *boxes[body].get_or_insert_with(|| NodeBox::new(&sets[body], shape, stencil))
            });
            a.meets(&b)
        })
        .collect()
}
