//! The stages of the cycle as functions of ranges: particles to nodes, solve, nodes to particles.
//!
//! Each is written once, generic over dimension, stencil width and lanes; the choice is made outside the loops.

pub mod g2p;
pub mod p2g;
pub mod solve;
pub mod touch;
pub mod weigh;

use crate::grid::{GHOSTS_BELOW, GridShape};
use crate::lanes::{Lanes, load};
use crate::layout::Layout;
use crate::weights::{Family, base_offset, gimp_weights, hat_weights};

/// How particles of one set see the grid.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// 1/h per axis \[1/m\].
    pub inverse_cell: [f64; 3],
    /// h per axis \[m\].
    pub cell: [f64; 3],
    /// Nodes along slow, middle and fast direction.
    pub nodes: [usize; 3],
    /// Family of weighting functions.
    pub family: Family,
    /// Half-length of the particle domain in cells where it is the same for all particles of the set.
    pub half_length: [f64; 3],
    /// 1/4 over that half-length.
    quarter: [f64; 3],
    /// Column of the half-lengths where each particle has its own.
    pub half_length_column: Option<usize>,
}

impl Mapping {
    /// Mapping for a grid.
    #[must_use]
    pub fn new(
        shape: &GridShape,
        family: Family,
        half_length: [f64; 3],
        column: Option<usize>,
    ) -> Self {
        Self {
            inverse_cell: shape.cell.map(|h| 1.0 / h),
            cell: shape.cell,
            nodes: shape.nodes,
            family,
            half_length,
            quarter: half_length.map(|l| 1.0 / (4.0 * l)),
            half_length_column: column,
        }
    }
}

/// Particles, as many as lanes at most, that follow each other and have the same base node.
struct Group<L> {
    /// Base node per axis, in cells of the mesh (ghosts not counted).
    base: [f64; 3],
    /// Number of particles.
    count: usize,
    /// Coordinates from the base node in cells. Lanes beyond `count` hold other particles, or none.
    f: [L; 3],
}

/// The group that begins at particle `at` and ends before `end`.
#[inline(always)]
fn group_at<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    at: usize,
    end: usize,
) -> Group<L> {
    let limit = (end - at).min(L::WIDTH);
    let mut base = [0.0; 3];
    let mut f = [L::splat(0.0); 3];
    let mut same = u32::MAX;
    for axis in 0..D {
        let column = columns[Layout::POSITION + axis].as_ref();
        base[axis] = (column[at] * mapping.inverse_cell[axis] - base_offset(N)).floor();
        let xi: L = load::<L>(column, at, limit) * L::splat(mapping.inverse_cell[axis]);
        let b = L::splat(base[axis]);
        same &= L::bits((xi - L::splat(base_offset(N))).floor().eq(b));
        f[axis] = xi - b;
    }
    let count = (same.trailing_ones() as usize).min(limit);
    // A non-finite position equals nothing, not even itself; it must still be passed over.
    Group {
        base,
        count: count.max(1),
        f,
    }
}

/// Index of a layer of nodes, ghosts counted, that lies `cell` cells from the lower boundary: 0 for what is not a number.
///
/// Whole numbers below 2^52 stand in the last bits of their sum with 2^52; a cast tests for what cannot be here.
#[inline(always)]
fn layer_of(cell: f64) -> usize {
    const SHIFT: f64 = 4_503_599_627_370_496.0;
    ((cell + GHOSTS_BELOW as f64).max(0.0) + SHIFT).to_bits() as u32 as usize
}

/// Weights and derivatives of a group that begins at `at`, per axis and node, in lanes.
#[inline(always)]
fn weights_of<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    group: &Group<L>,
    at: usize,
) -> ([[L; N]; 3], [[L; N]; 3]) {
    let zero = L::splat(0.0);
    let mut w = [[zero; N]; 3];
    let mut g = [[zero; N]; 3];
    if mapping.family == Family::Hat && N == 3 {
        for axis in 0..D {
            (w[axis], g[axis]) = hat_weights::<L, N>(group.f[axis]);
        }
        return (w, g);
    }
    if let Some(column) = mapping.half_length_column {
        for axis in 0..D {
            let l: L = load::<L>(columns[column + axis].as_ref(), at, group.count);
            // Lanes beyond the group hold zero, which must not divide.
            let l = L::select(zero.lt(l), l, L::splat(0.5));
            let quarter = L::splat(1.0) / (L::splat(4.0) * l);
            (w[axis], g[axis]) = gimp_weights::<L, N>(group.f[axis], l, quarter);
        }
        return (w, g);
    }
    for axis in 0..D {
        let (l, quarter) = (mapping.half_length[axis], mapping.quarter[axis]);
        (w[axis], g[axis]) = gimp_weights::<L, N>(group.f[axis], L::splat(l), L::splat(quarter));
    }
    (w, g)
}
