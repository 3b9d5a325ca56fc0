//! The stages of the cycle as functions of ranges: particles to nodes, solve, nodes to particles.
//!
//! Each is written once, generic over dimension, stencil width and lanes; the choice is made outside the loops.

pub mod g2p;
pub mod p2g;
pub mod solve;
pub mod touch;
pub mod weigh;

use crate::grid::GridShape;
use crate::lanes::Lanes;
use crate::particles::Layout;
use crate::weights::{Family, axis_weights, base_offset};

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
            half_length_column: column,
        }
    }
}

/// Up to eight particles that follow each other and have the same base node.
struct Group {
    /// Base node per axis, in cells of the mesh (ghosts not counted).
    base: [f64; 3],
    /// Number of particles.
    count: usize,
}

/// Loads up to `L::WIDTH` values; the common full case is a plain load.
#[inline(always)]
fn load<L: Lanes>(column: &[f64], at: usize, count: usize) -> L {
    if count == L::WIDTH {
        L::load(&column[at..])
    } else {
        L::load_part(&column[at..], count)
    }
}

/// Stores up to `L::WIDTH` values.
#[inline(always)]
fn store<L: Lanes>(value: L, column: &mut [f64], at: usize, count: usize) {
    if count == L::WIDTH {
        value.store(&mut column[at..]);
    } else {
        value.store_part(&mut column[at..], count);
    }
}

/// Number of leading particles, at most `L::WIDTH` and `limit`, whose base node is that of the first.
#[inline(always)]
fn same_base<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    base: &[f64; 3],
    at: usize,
    limit: usize,
) -> usize {
    let count = limit.min(L::WIDTH);
    let mut bits = u32::MAX;
    for axis in 0..D {
        let xi: L = load::<L>(columns[Layout::POSITION + axis].as_ref(), at, count)
            * L::splat(mapping.inverse_cell[axis]);
        let b = (xi - L::splat(base_offset(N))).floor();
        bits &= L::bits(b.eq(L::splat(base[axis])));
    }
    (bits.trailing_ones() as usize).min(count)
}

/// The group that begins at particle `at` and ends before `end`, at most `most <= 8` particles.
#[inline(always)]
fn group_at<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    at: usize,
    end: usize,
    most: usize,
) -> Group {
    let mut base = [0.0; 3];
    for axis in 0..D {
        let xi = columns[Layout::POSITION + axis].as_ref()[at] * mapping.inverse_cell[axis];
        base[axis] = (xi - base_offset(N)).floor();
    }
    let limit = (end - at).min(most);
    let mut count = 0;
    while count < limit {
        let more = same_base::<L, C, D, N>(columns, mapping, &base, at + count, limit - count);
        count += more;
        if more < L::WIDTH {
            break;
        }
    }
    // A non-finite position equals nothing, not even itself; it must still be passed over.
    Group {
        base,
        count: count.max(1),
    }
}

/// Weights and derivatives of `count` particles per axis and node, in lanes.
#[inline(always)]
fn weights_of<L: Lanes, C: AsRef<[f64]>, const D: usize, const N: usize>(
    columns: &[C],
    mapping: &Mapping,
    base: &[f64; 3],
    at: usize,
    count: usize,
) -> ([L; 3], [[L; N]; 3], [[L; N]; 3]) {
    let zero = L::splat(0.0);
    let mut f = [zero; 3];
    let mut w = [[zero; N]; 3];
    let mut g = [[zero; N]; 3];
    for axis in 0..D {
        let xi: L = load::<L>(columns[Layout::POSITION + axis].as_ref(), at, count)
            * L::splat(mapping.inverse_cell[axis]);
        f[axis] = xi - L::splat(base[axis]);
        let l = match mapping.half_length_column {
            None => L::splat(mapping.half_length[axis]),
            Some(column) => {
                let l: L = load::<L>(columns[column + axis].as_ref(), at, count);
                // Lanes beyond the group hold zero, which must not divide.
                if count == L::WIDTH {
                    l
                } else {
                    L::select(zero.lt(l), l, L::splat(0.5))
                }
            }
        };
        (w[axis], g[axis]) = axis_weights::<L, N>(mapping.family, f[axis], l);
    }
    (f, w, g)
}
