//! Sums of a run of particles over rows of nodes.
//!
//! Where a line is two registers or more, its halves are summed apart: the lower one, mass and momentum, has no
//! derivative unless velocity is affine, and a mapping that carries one half alone leaves the other out. Either way a
//! number has the same terms in the same order.

use super::Carry;
use super::scratch::Scratch;
use crate::grid::Line;
use crate::lanes::{Backend, Lanes};
use std::ops::Range;

/// Rows of nodes that a run reaches: those of one plane, in two dimensions those of all planes that are owned.
pub(super) struct RunRows {
    /// The particles, as numbered in the block.
    pub run: Range<usize>,
    /// Plane of the stencil, in space.
    pub plane: usize,
    /// Rows of the stencil.
    pub rows: Range<usize>,
    /// First node of the first of them.
    pub first: usize,
    /// Nodes from one row to the next.
    pub row_length: usize,
}

/// The lanes of a line that a call adds to.
const LOWER: u8 = 0;
const UPPER: u8 = 1;
const BOTH: u8 = 2;

/// Adds a run of the block in `scratch` to rows.
#[inline(always)]
pub(super) fn add_run<
    B: Backend,
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
>(
    scratch: &Scratch<N>,
    carry: Carry,
    below: &RunRows,
    nodes: &mut [Line],
) {
    if B::WHOLE_LINE {
        return add_part::<B::Line, D, N, FULL, GRADIENT, BOTH>(scratch, below, nodes);
    }
    if matches!(carry, Carry::All | Carry::Momentum) {
        add_part::<B::Half, D, N, FULL, GRADIENT, LOWER>(scratch, below, nodes);
    }
    if carry != Carry::Momentum {
        add_part::<B::Half, D, N, FULL, GRADIENT, UPPER>(scratch, below, nodes);
    }
}

/// Adds to some lanes of the rows; to as many rows at once as sums fit the registers.
#[inline(always)]
fn add_part<
    L: Lanes,
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const PART: u8,
>(
    scratch: &Scratch<N>,
    below: &RunRows,
    nodes: &mut [Line],
) {
    let mut j = below.rows.start;
    if N == 3 && below.rows.len() == 3 {
        return add_rows::<L, D, N, FULL, GRADIENT, PART, 3>(scratch, below, nodes, j);
    }
    while N != 3 && j + 2 <= below.rows.end {
        add_rows::<L, D, N, FULL, GRADIENT, PART, 2>(scratch, below, nodes, j);
        j += 2;
    }
    // At the edge of what is owned, in two dimensions.
    while D == 2 && j < below.rows.end {
        add_rows::<L, D, N, FULL, GRADIENT, PART, 1>(scratch, below, nodes, j);
        j += 1;
    }
}

/// Adds to `ROWS` rows from row `j`.
#[inline(always)]
fn add_rows<
    L: Lanes,
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const PART: u8,
    const ROWS: usize,
>(
    scratch: &Scratch<N>,
    below: &RunRows,
    nodes: &mut [Line],
    j: usize,
) {
    let (middle, fast) = (D - 2, D - 1);
    // In the plane the force through the derivative along the slow axis and that along the fast one lie side by side, so that
    // a line times its factors along both is all.
    let packed = D == 2 && GRADIENT && !FULL;
    // The lower lanes have derivatives (distances, that is) of affine velocity only.
    let derivative = GRADIENT && !packed && (FULL || PART != LOWER);
    let lanes = match PART {
        LOWER => 0..4,
        UPPER => 4..8,
        _ => 0..8,
    };
    let first = below.first + (j - below.rows.start) * below.row_length;
    let mut sums = [[L::splat(0.0); N]; ROWS];
    for r in 0..ROWS {
        let row = &nodes[first + r * below.row_length..][..N];
        for k in 0..N {
            sums[r][k] = L::load(&row[k][lanes.clone()]);
        }
    }
    for p in below.run.clone() {
        let [by_weight, by_middle, by_fast] =
            in_plane::<L, D, N, FULL, GRADIENT, PART>(scratch, below.plane, p);
        for r in 0..ROWS {
            let w = scratch.w[middle][j + r][p];
            let mut s = if packed {
                splat_for::<L, PART>(w, scratch.g[middle][j + r][p], SLOW) * by_weight
            } else {
                L::splat(w) * by_weight
            };
            if derivative && (FULL || D == 3) {
                let factor = along::<L, N, FULL, PART>(scratch, middle, j + r, p);
                s = factor.mul_add(by_middle, s);
            }
            for k in 0..N {
                let w = scratch.w[fast][k][p];
                let factor = if packed {
                    splat_for::<L, PART>(w, scratch.g[fast][k][p], FAST)
                } else {
                    L::splat(w)
                };
                sums[r][k] = factor.mul_add(s, sums[r][k]);
            }
            if derivative {
                let t = L::splat(w) * by_fast;
                for k in 0..N {
                    let factor = along::<L, N, FULL, PART>(scratch, fast, k, p);
                    sums[r][k] = factor.mul_add(t, sums[r][k]);
                }
            }
        }
    }
    for r in 0..ROWS {
        let row = &mut nodes[first + r * below.row_length..][..N];
        for k in 0..N {
            sums[r][k].store(&mut row[k][lanes.clone()]);
        }
    }
}

/// Terms that a particle adds to a plane of the stencil: the lines that go with the weights of rows, with their derivatives,
/// and with their weights and the derivative along them. In the plane rows lie along the slow axis, and without affine terms
/// all is in the first line.
#[inline(always)]
fn in_plane<
    L: Lanes,
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const PART: u8,
>(
    scratch: &Scratch<N>,
    plane: usize,
    p: usize,
) -> [L; 3] {
    let first = if PART == UPPER { 4 } else { 0 };
    let mut lines = [L::splat(0.0); 4];
    for number in 0..4 {
        lines[number] = L::load(&scratch.lines[p][number][first..]);
    }
    if D == 2 {
        return [lines[0], lines[1], lines[3]];
    }
    let weight = scratch.w[0][plane][p];
    let w = L::splat(weight);
    let by_weight = if FULL {
        along::<L, N, FULL, PART>(scratch, 0, plane, p).mul_add(lines[1], w * lines[0])
    } else if GRADIENT {
        splat_for::<L, PART>(weight, scratch.g[0][plane][p], UPPER_LANES) * lines[0]
    } else {
        w * lines[0]
    };
    [by_weight, w * lines[2], w * lines[3]]
}

/// Derivative of the weight of a node along an axis; with affine terms in the upper lanes, and distance times weight in the
/// lower ones.
#[inline(always)]
fn along<L: Lanes, const N: usize, const FULL: bool, const PART: u8>(
    scratch: &Scratch<N>,
    axis: usize,
    node: usize,
    p: usize,
) -> L {
    let g = scratch.g[axis][node][p];
    if FULL {
        splat_for::<L, PART>(scratch.q[axis][node][p], g, UPPER_LANES)
    } else {
        L::splat(g)
    }
}

/// The lanes of a line that go with a derivative: the upper half; in the plane, where lines are packed, those of the slow axis
/// or of the fast one.
const UPPER_LANES: u8 = 0xf0;
const SLOW: u8 = 0x30;
const FAST: u8 = 0xc0;

/// Lanes in use of a line with `b` in some lanes and `a` in the others.
#[inline(always)]
fn splat_for<L: Lanes, const PART: u8>(a: f64, b: f64, lanes: u8) -> L {
    match PART {
        LOWER => L::splat_two(a, b, lanes & 0xf),
        UPPER => L::splat_two(a, b, lanes >> 4),
        _ => L::splat_two(a, b, lanes),
    }
}
