//! The volumetric part of velocity gradients as the mean over cells.
//!
//! tr L of a particle becomes sum_I v_I . B_I, where the component of B_I along an axis is the derivative of S_I along it with
//! the other factors of S_I replaced by their means over the cells in which the particle domain lies: selective reduced
//! integration for particles (Hughes 1980; Nagtegaal, Parks and Rice 1974).

use super::G2p;
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes};
use crate::laws::{BLOCK, Gradients, MOST_LANES};
use crate::stage::{Mapping, group_at, layer_of, weights_of};
use crate::weights::cell_mean_weights;
use std::ops::Range;

/// By how much tr L of the particles of a block exceeds its mean, shared among the axes \[1/s\].
pub(super) struct Excess([f64; BLOCK + 2 * MOST_LANES]);

impl Excess {
    #[inline(always)]
    pub(super) fn none() -> Self {
        Self([0.0; BLOCK + 2 * MOST_LANES])
    }

    /// Finds it for the block that begins at particle `block`, at the positions of now; `upper` takes the velocities of the
    /// upper lanes.
    pub(super) fn find<const D: usize, const N: usize>(
        &mut self,
        call: &G2p<'_, '_>,
        upper: bool,
        block: usize,
    ) {
        // The last group of a block may reach beyond it.
        let end = call.columns[0].len().min(block + BLOCK + MOST_LANES);
        call.lanes.run(Find::<D, N> {
            columns: call.columns,
            mapping: call.mapping,
            nodes: call.nodes,
            source: if upper { 4 } else { 1 },
            range: block..end,
            excess: self,
        });
    }

    /// Takes it from the gradients.
    pub(super) fn take_from<const D: usize>(&self, gradients: &mut Gradients) {
        for axis in 0..D {
            for (component, excess) in gradients.0[(D + 1) * axis].iter_mut().zip(&self.0) {
                *component -= excess;
            }
        }
    }
}

/// Finds it in lanes.
struct Find<'a, 'b, const D: usize, const N: usize> {
    columns: &'a [&'b mut [f64]],
    mapping: &'a Mapping,
    nodes: &'a [Line],
    /// First lane of the velocity.
    source: usize,
    range: Range<usize>,
    excess: &'a mut Excess,
}

impl<const D: usize, const N: usize> Kernel for Find<'_, '_, D, N> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        let mut at = self.range.start;
        while at < self.range.end {
            let group =
                group_at::<B::Native, _, D, N>(self.columns, self.mapping, at, self.range.end);
            let (w, g) = weights_of::<B::Native, _, D, N>(self.columns, self.mapping, &group, at);
            let mut mean = w;
            let mut first = [0; 3];
            for axis in 0..D {
                mean[axis] = cell_mean_weights::<B::Native, N>(&g[axis]);
                first[axis] = layer_of(group.base[axis]);
            }
            let mut sum = B::Native::splat(0.0);
            for axis in 0..D {
                let part = self.along::<B::Native>(axis, first, &w, &mean, &g);
                sum = B::Native::splat(self.mapping.inverse_cell[axis]).mul_add(part, sum);
            }
            let share = B::Native::splat(1.0 / D as f64) * sum;
            share.store(&mut self.excess.0[at - self.range.start..][..MOST_LANES]);
            at += group.count;
        }
    }
}

impl<const D: usize, const N: usize> Find<'_, '_, D, N> {
    /// h sum_I g_I (w_I - mean_I) v_I of one component of the velocity: `g` along its axis, the other two across it. `first`
    /// is the base node.
    #[inline(always)]
    fn along<L: Lanes>(
        &self,
        axis: usize,
        first: [usize; 3],
        w: &[[L; N]; 3],
        mean: &[[L; N]; 3],
        g: &[[L; N]; 3],
    ) -> L {
        let [_, middle, fast] = self.mapping.nodes;
        // Nodes from one to the next along each axis; the plane has no middle one.
        let step = if D == 3 {
            [middle * fast, fast, 1]
        } else {
            [middle * fast, 1, 0]
        };
        let base: usize = (0..D).map(|axis| first[axis] * step[axis]).sum();
        let [a, b] = match (D, axis) {
            (2, _) => [1 - axis, 2],
            (_, 0) => [1, 2],
            (_, 1) => [0, 2],
            _ => [0, 1],
        };
        let mut sum = L::splat(0.0);
        for i in 0..N {
            for j in 0..if D == 3 { N } else { 1 } {
                let difference = if D == 3 {
                    w[a][i] * w[b][j] - mean[a][i] * mean[b][j]
                } else {
                    w[a][i] - mean[a][i]
                };
                let row = base + i * step[a] + j * step[b];
                let mut along = L::splat(0.0);
                for k in 0..N {
                    let v_i = self.nodes[row + k * step[axis]][self.source + axis];
                    along = g[axis][k].mul_add(L::splat(v_i), along);
                }
                sum = difference.mul_add(along, sum);
            }
        }
        sum
    }
}
