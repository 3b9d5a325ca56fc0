//! The nodes that the particles of a block reach: several stencils at once, lanes = particles.
//!
//! Particles in order of their cells are no multiples of the lanes, and those that moved are in no order: a block has the
//! particles that come, and as many base nodes as they have. A value of a node of the stencil is that of the first base node
//! in all lanes, then that of each other one in its lanes. Lanes only take what is theirs, so that the bits do not depend on
//! how particles fall into blocks.

use crate::grid::Line;
use crate::lanes::Lanes;
use crate::stage::{Block, Mapping, index_of, whole_from};

/// Most base nodes of a block. One that has more ends before the particle that brings the next.
pub(super) const MOST: usize = 3;

/// The base nodes of a block.
pub(super) struct Bases<L: Lanes> {
    /// Particles of the block that have one of them.
    pub count: usize,
    /// Number of them.
    pub number: usize,
    /// Index of each.
    first: [usize; MOST],
    /// The lanes that have it.
    of: [L::Mask; MOST],
}

impl<L: Lanes> Bases<L> {
    /// Base nodes of a block.
    #[inline(always)]
    pub(super) fn of<const D: usize>(block: &Block<L>, mapping: &Mapping) -> Self {
        let index = block.index::<D>(mapping);
        let mut indices = [0.0; 8];
        index.store(&mut indices);
        let mut bases = Self {
            count: block.count,
            number: 0,
            first: [0; MOST],
            of: [L::first(0); MOST],
        };
        let mut left = (1_u32 << block.count) - 1;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            if bases.number == MOST {
                bases.count = lane;
                break;
            }
            let same = index.eq(L::splat(indices[lane]));
            bases.first[bases.number] = index_of(indices[lane]);
            bases.of[bases.number] = same;
            bases.number += 1;
            // What is not a number equals nothing, not even itself; it must still be passed over.
            left &= !(L::bits(same) | 1 << lane);
        }
        // As many as asked for in one of two instances.
        for missing in bases.number.max(1)..MOST {
            bases.first[missing] = bases.first[0];
        }
        bases
    }

    /// Those of the block at particle `at` of particles up to `end`, which ends where whole blocks begin.
    #[inline(always)]
    pub(super) fn ahead<C: AsRef<[f64]>, const D: usize, const N: usize>(
        block: &Block<L>,
        columns: &[C],
        mapping: &Mapping,
        at: usize,
        end: usize,
    ) -> Self {
        let mut bases = Self::of::<D>(block, mapping);
        if bases.number > 1 {
            let first = bases.of_first();
            if first > 0 && whole_from::<L, _, D, N>(columns, mapping, at + first, end) {
                (bases.count, bases.number) = (first, 1);
            }
        }
        bases
    }

    /// Particles at the beginning of the block that have the first one.
    #[inline(always)]
    fn of_first(&self) -> usize {
        L::bits(self.of[0]).trailing_ones() as usize
    }

    /// The same with the node before each of them along each axis, which a hat reaches from its base node.
    #[inline(always)]
    pub(super) fn before<const D: usize>(mut self, mapping: &Mapping) -> Self {
        let [_, middle, fast] = mapping.nodes;
        let step = if D == 3 {
            middle * fast + fast + 1
        } else {
            fast + 1
        };
        for first in &mut self.first {
            *first = first.saturating_sub(step);
        }
        self
    }

    /// The nodes of the first `R` of them.
    #[inline(always)]
    pub(super) fn reach<'a, const R: usize>(&self, nodes: &'a [Line]) -> BlockReach<'a, L, R> {
        BlockReach {
            nodes,
            first: std::array::from_fn(|r| self.first[r]),
            of: std::array::from_fn(|r| self.of[r]),
        }
    }
}

/// The nodes that the particles of a block with at most `R` base nodes reach.
pub(super) struct BlockReach<'a, L: Lanes, const R: usize> {
    nodes: &'a [Line],
    first: [usize; R],
    of: [L::Mask; R],
}

/// `N` nodes of each of these stencils, side by side along the fast axis.
pub(super) type Rows<'a, const N: usize, const R: usize> = [&'a [Line; N]; R];

impl<'a, L: Lanes, const R: usize> BlockReach<'a, L, R> {
    /// The rows that begin `offset` nodes behind the base nodes.
    #[inline(always)]
    pub(super) fn rows<const N: usize>(&self, offset: usize) -> Rows<'a, N, R> {
        let mut rows = [row_at(self.nodes, self.first[0] + offset); R];
        for r in 1..R {
            rows[r] = row_at(self.nodes, self.first[r] + offset);
        }
        rows
    }

    /// A number of the `k`-th node of rows.
    #[inline(always)]
    pub(super) fn value<const N: usize>(
        &self,
        rows: &Rows<'a, N, R>,
        k: usize,
        number: usize,
    ) -> L {
        let mut value = L::splat(rows[0][k][number]);
        for r in 1..R {
            value = L::select(self.of[r], L::splat(rows[r][k][number]), value);
        }
        value
    }
}

/// The row of nodes of a stencil from a node on.
#[inline(always)]
fn row_at<const N: usize>(nodes: &[Line], first: usize) -> &[Line; N] {
    nodes[first..]
        .first_chunk()
        .expect("the stencil of a particle lies in the grid")
}
