//! The stages of the cycle as functions of ranges: particles to nodes, solve, nodes to particles.
//!
//! Each is written once, generic over dimension, stencil width and lanes; the choice is made outside the loops.

pub mod g2p;
pub mod p2g;
pub mod solve;
pub mod water;
pub mod weigh;

use crate::grid::{GHOSTS_BELOW, GridShape};
use crate::lanes::{Lanes, load};
use crate::layout::Layout;
use crate::weights::{
    Family, base_offset, gimp_weights, hat_pair, hat_triple, hat_weights, least_squares_weights,
    weigh_by_radius,
};

/// View of the grid by the particles of one set.
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
    /// True for gradients of least squares: see [`TransferType`](crate::transfers::TransferType).
    least_squares: bool,
    /// Column of the half-lengths where each particle has its own.
    pub half_length_column: Option<usize>,
    /// Radius of the lower edge of the mesh \[m\], where the first axis is a radius.
    pub first_radius: f64,
    /// True where derivatives along the radius are integrals with the radius over particle domains.
    pub weighs_by_radius: bool,
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
            least_squares: false,
            first_radius: 0.0,
            weighs_by_radius: false,
        }
    }

    /// The same where the first axis is a radius that begins with `first_radius` \[m\]: with particles that are rings
    /// (`weighs_by_radius`), or points with weights as in the plane.
    #[must_use]
    pub fn with_radius(self, first_radius: f64, weighs_by_radius: bool) -> Self {
        Self {
            first_radius,
            weighs_by_radius,
            ..self
        }
    }

    /// The same with gradients of least squares, which quadratic B-splines have.
    #[must_use]
    pub fn with_least_squares(self, least_squares: bool) -> Self {
        Self {
            least_squares,
            ..self
        }
    }
}

/// Particles, as many as lanes at most, that follow each other, each with its base node.
struct Block<L> {
    /// Number of particles.
    count: usize,
    /// Base node of each per axis, in cells of the mesh (ghosts not counted).
    base: [L; 3],
    /// Coordinates from the base node in cells. Lanes beyond `count` hold no particle.
    f: [L; 3],
}

/// The block that begins at particle `at`, full unless `end` is near.
#[inline(always)]
fn block_at<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    at: usize,
    end: usize,
) -> Block<L> {
    let zero = L::splat(0.0);
    let mut block = Block {
        count: (end - at).min(L::WIDTH),
        base: [zero; 3],
        f: [zero; 3],
    };
    for axis in 0..D {
        let column = columns[Layout::POSITION + axis].as_ref();
        let xi = load::<L>(column, at, block.count) * L::splat(mapping.inverse_cell[axis]);
        block.base[axis] = (xi - L::splat(base_offset(N))).floor();
        block.f[axis] = xi - block.base[axis];
    }
    block
}

/// True if the next two blocks from particle `at` have one base node each. Then a block before them ends where they begin: they
/// stay whole, and with them all that follows in a body in order, which costs a fifth less than blocks of two base nodes.
#[inline(always)]
fn whole_from<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    at: usize,
    end: usize,
) -> bool {
    let base = |p: usize, axis: usize| {
        let xi = columns[Layout::POSITION + axis].as_ref()[p] * mapping.inverse_cell[axis];
        (xi - base_offset(N)).floor()
    };
    let whole = |p: usize| (0..D).all(|axis| base(p, axis) == base(p + L::WIDTH - 1, axis));
    at + 2 * L::WIDTH <= end && whole(at) && whole(at + L::WIDTH)
}

impl<L: Lanes> Block<L> {
    /// True if a particle lies on its base node along some axis, to the last bit.
    #[inline(always)]
    fn on_a_node<const D: usize>(&self) -> bool {
        let zero = L::splat(0.0);
        let mut on = 0;
        for axis in 0..D {
            on |= L::bits(self.f[axis].eq(zero));
        }
        // Lanes beyond the particles hold zero.
        on & ((1 << self.count) - 1) != 0
    }

    /// Index of the base node of each particle among the nodes of the grid, a whole number; no number where a position is
    /// none.
    #[inline(always)]
    fn index<const D: usize>(&self, mapping: &Mapping) -> L {
        let below = L::splat(GHOSTS_BELOW as f64);
        let [_, middle, fast] = mapping.nodes.map(|nodes| L::splat(nodes as f64));
        let mut row = (self.base[0] + below) * middle;
        if D == 3 {
            row = row + (self.base[1] + below);
        }
        row.mul_add(fast, self.base[D - 1] + below)
    }
}

/// Radius of the base nodes of a block, and one over the radius of its particles, in cells. Lanes beyond the block hold 1.
#[inline(always)]
fn radii<L: Lanes>(mapping: &Mapping, block: &Block<L>) -> (L, L) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let first = L::splat(mapping.first_radius * mapping.inverse_cell[0]) + block.base[0];
    let radius = first + block.f[0];
    let radius = L::select(zero.lt(radius), radius, one);
    (first, one / radius)
}

/// Index of a layer of nodes, ghosts counted, that lies `cell` cells from the lower boundary: 0 for what is not a number.
#[inline(always)]
fn layer_of(cell: f64) -> usize {
    index_of(cell + GHOSTS_BELOW as f64)
}

/// A whole number below 2^32 as an index: 0 for what is not a number.
///
/// Whole numbers below 2^52 stand in the last bits of their sum with 2^52; a cast tests for what cannot be here.
#[inline(always)]
pub(crate) fn index_of(whole: f64) -> usize {
    const SHIFT: f64 = 4_503_599_627_370_496.0;
    (whole.max(0.0) + SHIFT).to_bits() as u32 as usize
}

/// Weights and derivatives of a block that begins at `at`, per axis and node, in lanes.
///
/// Two nodes are those of hats; with `ON_NODES` the three of hats of which the second is the base node of the block, since a
/// particle of it lies there. With `AXISYMMETRIC` the first axis is a radius.
#[inline(always)]
fn weights_of<
    L: Lanes,
    C: AsRef<[f64]>,
    const D: usize,
    const N: usize,
    const ON_NODES: bool,
    const AXISYMMETRIC: bool,
>(
    columns: &[C],
    mapping: &Mapping,
    block: &Block<L>,
    at: usize,
) -> ([[L; N]; 3], [[L; N]; 3]) {
    let zero = L::splat(0.0);
    let mut w = [[zero; N]; 3];
    let mut g = [[zero; N]; 3];
    if N == 2 || ON_NODES {
        for axis in 0..D {
            (w[axis], g[axis]) = if ON_NODES {
                hat_triple::<L, N>(block.f[axis])
            } else {
                hat_pair::<L, N>(block.f[axis])
            };
        }
        return (w, g);
    }
    if mapping.family == Family::Hat && N == 3 {
        for axis in 0..D {
            (w[axis], g[axis]) = hat_weights::<L, N>(block.f[axis]);
        }
        return (w, g);
    }
    if let Some(column) = mapping.half_length_column {
        for axis in 0..D {
            let l: L = load::<L>(columns[column + axis].as_ref(), at, block.count);
            // Lanes beyond the block hold zero, which must not divide.
            let l = L::select(zero.lt(l), l, L::splat(0.5));
            let quarter = L::splat(1.0) / (L::splat(4.0) * l);
            (w[axis], g[axis]) = gimp_weights::<L, N>(block.f[axis], l, quarter);
            if AXISYMMETRIC && axis == 0 && mapping.weighs_by_radius {
                let (first, inverse) = radii(mapping, block);
                weigh_by_radius(&mut g[0], block.f[0], [l, quarter], first, inverse);
            }
        }
        return (w, g);
    }
    for axis in 0..D {
        let (l, quarter) = (mapping.half_length[axis], mapping.quarter[axis]);
        (w[axis], g[axis]) = gimp_weights::<L, N>(block.f[axis], L::splat(l), L::splat(quarter));
        if mapping.least_squares {
            g[axis] = least_squares_weights::<L, N>(block.f[axis], &w[axis]);
        }
    }
    if AXISYMMETRIC && mapping.weighs_by_radius {
        let (first, inverse) = radii(mapping, block);
        let domain = [mapping.half_length[0], mapping.quarter[0]].map(L::splat);
        weigh_by_radius(&mut g[0], block.f[0], domain, first, inverse);
    }
    (w, g)
}
