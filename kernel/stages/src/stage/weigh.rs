//! The weights of all particles and nothing else: what the mapping stages compute on the way, alone.
//!
//! The cycle never calls it, since keeping weights costs more than computing them twice; it exists to be measured.

use super::{Mapping, block_at, weights_of};
use crate::lanes::{Backend, Kernel, Lanes, SelectedLanes};
use crate::particles::ParticleSet;
use std::ops::Range;

/// Base node, weights and derivatives of the particles of a range, in lanes as the cycle has them. Returns a sum that
/// depends on every one of them, so that no compiler leaves them out.
#[must_use]
pub fn weights(
    lanes: SelectedLanes,
    axes: usize,
    stencil: usize,
    set: &ParticleSet,
    mapping: &Mapping,
    range: Range<usize>,
) -> f64 {
    match (axes, stencil) {
        (2, 3) => lanes.run(WeightKernel::<2, 3>(set, mapping, range)),
        (2, _) => lanes.run(WeightKernel::<2, 4>(set, mapping, range)),
        (_, 3) => lanes.run(WeightKernel::<3, 3>(set, mapping, range)),
        _ => lanes.run(WeightKernel::<3, 4>(set, mapping, range)),
    }
}

struct WeightKernel<'a, const D: usize, const N: usize>(&'a ParticleSet, &'a Mapping, Range<usize>);

impl<const D: usize, const N: usize> Kernel for WeightKernel<'_, D, N> {
    type Output = f64;

    #[inline(always)]
    fn run<B: Backend>(self) -> f64 {
        let Self(set, mapping, range) = self;
        let columns = &set.columns;
        let mut all = B::Line::splat(0.0);
        let mut at = range.start;
        while at < range.end {
            let block = block_at::<B::Line, _, D, N>(columns, mapping, at, range.end);
            let (w, g) = weights_of::<B::Line, _, D, N, false, false>(columns, mapping, &block, at);
            for axis in 0..D {
                for n in 0..N {
                    all = w[axis][n].mul_add(g[axis][n], all);
                }
            }
            at += block.count;
        }
        let mut lanes = [0.0; 8];
        all.store(&mut lanes);
        lanes.iter().sum()
    }
}
