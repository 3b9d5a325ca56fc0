//! Factors of the numbers of a node of the pore water; lanes = numbers of a node, one particle after the other.
//!
//! A gradient of products of weights has, for its component along an axis, the derivative along this axis and the weights along
//! the others. A line of factors along an axis has one factor for each component: so the product of the lines along all axes is that
//! of all components. Its last number goes with the weights alone.
//!
//! Where a node is one register, its factors are formed when they are needed: weights, but for the number of the derivative.

use crate::lanes::{Lanes, Quad};
use crate::stage::{Block, Mapping, block_at, weights_of};
use crate::weights::cell_mean_weights;

/// Most particles of a block.
pub(in crate::stage) const MOST: usize = 8;

/// Numbers of a line.
const NUMBERS: usize = 4;

/// Factors of a block of particles.
#[repr(align(64))]
pub(in crate::stage) struct Factors<const N: usize> {
    /// Lines, `[axis][node][particle][number]`; derivatives in 1/m.
    lines: [[[[f64; NUMBERS]; MOST]; N]; 3],
    /// Weights, `[axis][node][particle]`.
    weights: [[[f64; MOST]; N]; 3],
    /// Derivatives in 1/m, `[axis][node][particle]`.
    derivatives: [[[f64; MOST]; N]; 3],
}

impl<const N: usize> Factors<N> {
    #[inline(always)]
    pub(in crate::stage) fn new() -> Self {
        Self {
            lines: [[[[0.0; NUMBERS]; MOST]; N]; 3],
            weights: [[[0.0; MOST]; N]; 3],
            derivatives: [[[0.0; MOST]; N]; 3],
        }
    }

    /// Weights and derivatives of a block that begins at particle `at`, without lines.
    #[inline(always)]
    pub(in crate::stage) fn fill_whole<L: Lanes, C: AsRef<[f64]>, const D: usize>(
        &mut self,
        columns: &[C],
        mapping: &Mapping,
        block: &Block<L>,
        at: usize,
    ) {
        let (w, g) = weights_of::<L, _, D, N, false, false>(columns, mapping, block, at);
        for axis in 0..D {
            let scale = L::splat(mapping.inverse_cell[axis]);
            for n in 0..N {
                w[axis][n].store(&mut self.weights[axis][n]);
                (scale * g[axis][n]).store(&mut self.derivatives[axis][n]);
            }
        }
    }

    /// Those of `count` particles from `at`. With `averaged` the weights beside a derivative are means over cells.
    #[inline(always)]
    pub(in crate::stage) fn fill<Q: Quad, C: AsRef<[f64]>, const D: usize>(
        &mut self,
        columns: &[C],
        mapping: &Mapping,
        averaged: bool,
        at: usize,
        count: usize,
    ) {
        let mut done = 0;
        while done < count {
            let block = block_at::<Q, _, D, N>(columns, mapping, at + done, at + count);
            let (w, g) =
                weights_of::<Q, _, D, N, false, false>(columns, mapping, &block, at + done);
            for axis in 0..D {
                let scale = Q::splat(mapping.inverse_cell[axis]);
                let mut beside = w[axis];
                if averaged {
                    beside = cell_mean_weights::<Q, N>(&g[axis]);
                }
                for n in 0..N {
                    let weight = w[axis][n];
                    weight.store(&mut self.weights[axis][n][done..done + NUMBERS]);
                    let mut numbers = [beside[n], beside[n], beside[n], weight];
                    numbers[axis] = scale * g[axis][n];
                    let lines = Q::transpose(numbers);
                    let of_node = &mut self.lines[axis][n][done..done + NUMBERS];
                    for p in 0..NUMBERS {
                        lines[p].store(&mut of_node[p]);
                    }
                }
            }
            done += NUMBERS;
        }
    }
}

/// Kind of the factors of a sum.
pub(in crate::stage) trait FactorKind {
    /// Factors of a particle for a node along an axis.
    fn of<L: Lanes, const N: usize>(factors: &Factors<N>, axis: usize, node: usize, p: usize) -> L;
}

/// The weights, for all numbers alike.
pub(in crate::stage) struct Weights;

impl FactorKind for Weights {
    #[inline(always)]
    fn of<L: Lanes, const N: usize>(factors: &Factors<N>, axis: usize, node: usize, p: usize) -> L {
        L::splat(factors.weights[axis][node][p])
    }
}

/// The lines of derivatives.
pub(in crate::stage) struct Derivatives;

impl FactorKind for Derivatives {
    #[inline(always)]
    fn of<L: Lanes, const N: usize>(factors: &Factors<N>, axis: usize, node: usize, p: usize) -> L {
        L::load(&factors.lines[axis][node][p])
    }
}

/// Weights for the lower half of a node, the lines of derivatives for the upper one; from weights and derivatives.
pub(in crate::stage) struct WholeFactors;

impl FactorKind for WholeFactors {
    #[inline(always)]
    fn of<L: Lanes, const N: usize>(factors: &Factors<N>, axis: usize, node: usize, p: usize) -> L {
        let [weight, derivative] =
            [&factors.weights, &factors.derivatives].map(|of| of[axis][node][p]);
        L::splat_two(weight, derivative, 1 << (NUMBERS + axis))
    }
}
