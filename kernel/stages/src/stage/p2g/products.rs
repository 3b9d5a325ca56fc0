//! Sums of a run of particles in space as products of weights with what a particle gives to a node.
//!
//! A particle gives node (i, j, k) of its three per axis the weight `w_i` `w_j` `w_k` times the sum of a line of its own and of
//! lines that depend on one axis:
//!
//! - mass and momentum m, m (v + C (x_I - x_p)): the lower half;
//! - force f - V sigma . (`g_i/w_i`, `g_j/w_j`, `g_k/w_k`): the upper half, as the gradient of a product of weights is the product
//!   times derivative over weight along each axis.
//!
//! With least squares the quotient is the distance over `D_p`, and both halves are linear in the distance.
//!
//! So a node takes one addition and one multiply-add per half, and the products of weights are formed for all particles of a
//! block at once. Where a weight is zero, so is its product with a finite number.

use super::add::RunRows;
use super::scratch::Lines;
use super::source::P2gSource;
use crate::grid::Line;
use crate::lanes::{Backend, Lanes};
use crate::stage::{Block, weights_of};
use std::ops::Range;

/// Nodes of a stencil.
const NODES: usize = 27;

/// Least divisor: what is divided by a smaller weight is multiplied by it afterwards, and is lost.
const LEAST: f64 = 1e-100;

/// Products of weights of a block, and what goes with them along one axis.
#[repr(align(64))]
pub(super) struct Products {
    /// Products of three weights, `[9 i + 3 j + k][particle]`.
    weights: [[f64; 8]; NODES],
    /// Derivative times h over weight, `[axis][node][particle]`.
    ratio: [[[f64; 8]; 3]; 3],
    /// Distance of the middle node from the particle in cells, `[axis][particle]`.
    distance: [[f64; 8]; 3],
}

impl Products {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            weights: [[0.0; 8]; NODES],
            ratio: [[[0.0; 8]; 3]; 3],
            distance: [[0.0; 8]; 3],
        }
    }

    /// Factors of a block that begins at particle `at`: distances with affine terms (`FULL`) alone, quotients unless the force
    /// is `linear` in the distance.
    #[inline(always)]
    pub(super) fn fill<L: Lanes, const FULL: bool>(
        &mut self,
        from: &P2gSource<'_>,
        block: &Block<L>,
        at: usize,
        linear: bool,
    ) {
        let (w, g) = weights_of::<L, _, 3, 3, false, false>(from.columns, from.mapping, block, at);
        let (one, least) = (L::splat(1.0), L::splat(LEAST));
        for axis in 0..3 {
            if FULL {
                (one - block.f[axis]).store(&mut self.distance[axis]);
            }
            if linear {
                continue;
            }
            let (below, middle, above) = (w[axis][0].max(least), w[axis][1], w[axis][2].max(least));
            // One division for three quotients.
            let inverse = one / (below * above * middle);
            let ratio = &mut self.ratio[axis];
            (g[axis][0] * (inverse * (middle * above))).store(&mut ratio[0]);
            (g[axis][1] * (inverse * (below * above))).store(&mut ratio[1]);
            (g[axis][2] * (inverse * (below * middle))).store(&mut ratio[2]);
        }
        for i in 0..3 {
            for j in 0..3 {
                let product = w[0][i] * w[1][j];
                for k in 0..3 {
                    (product * w[2][k]).store(&mut self.weights[9 * i + 3 * j + k]);
                }
            }
        }
    }
}

/// Adds a run of the block to a plane.
///
/// Where both halves of a node are one register, they are added at once; with affine terms their factors differ, and each half
/// has a loop of its own.
#[inline(always)]
pub(super) fn add_products<B: Backend, const FULL: bool>(
    products: &Products,
    lines: &Lines,
    below: &RunRows,
    nodes: &mut [Line],
) {
    if FULL {
        products.add::<Linear<0, 4>, B::Half>(lines, below, nodes);
        products.add::<AffineForce, B::Half>(lines, below, nodes);
    } else if B::WHOLE_LINE {
        products.add::<Whole, B::Line>(lines, below, nodes);
    } else {
        products.add::<Momentum, B::Half>(lines, below, nodes);
        products.add::<Force, B::Half>(lines, below, nodes);
    }
}

/// The same with the force of least squares.
#[inline(always)]
pub(super) fn add_linear<B: Backend>(
    products: &Products,
    lines: &Lines,
    below: &RunRows,
    nodes: &mut [Line],
) {
    if B::WHOLE_LINE {
        products.add::<Linear<0, 8>, B::Line>(lines, below, nodes);
    } else {
        products.add::<Linear<0, 4>, B::Half>(lines, below, nodes);
        products.add::<Linear<4, 8>, B::Half>(lines, below, nodes);
    }
}

/// Some lanes of a line, and what a particle gives to them.
trait Part {
    /// The lanes.
    const LANES: Range<usize>;

    /// The lines of a particle at the nodes of a plane, `[3 j + k]`, without their weights.
    fn at_nodes<L: Lanes>(
        products: &Products,
        line: &[[f64; 8]; 4],
        plane: usize,
        p: usize,
    ) -> [L; 9];
}

/// Mass and momentum without affine terms, the same at all nodes.
struct Momentum;

impl Part for Momentum {
    const LANES: Range<usize> = 0..4;

    #[inline(always)]
    fn at_nodes<L: Lanes>(_: &Products, line: &[[f64; 8]; 4], _: usize, _: usize) -> [L; 9] {
        [L::load(&line[0][Self::LANES]); 9]
    }
}

/// Lanes from `FROM` to `TO` that are linear in the distance of a node: mass and momentum with the affine velocity, and the force
/// of least squares.
struct Linear<const FROM: usize, const TO: usize>;

impl<const FROM: usize, const TO: usize> Part for Linear<FROM, TO> {
    const LANES: Range<usize> = FROM..TO;

    #[inline(always)]
    fn at_nodes<L: Lanes>(
        products: &Products,
        line: &[[f64; 8]; 4],
        plane: usize,
        p: usize,
    ) -> [L; 9] {
        let slow = L::load(&line[1][Self::LANES]);
        let middle = L::load(&line[2][Self::LANES]);
        let fast = L::load(&line[3][Self::LANES]);
        let [x, y, z] = &products.distance;
        let mut node = L::load(&line[0][Self::LANES]);
        node = L::splat(x[p] + (plane as f64 - 1.0)).mul_add(slow, node);
        node = L::splat(y[p]).mul_add(middle, node);
        node = L::splat(z[p]).mul_add(fast, node);
        let [below, above] = [node - middle, node + middle];
        [
            below - fast,
            below,
            below + fast,
            node - fast,
            node,
            node + fast,
            above - fast,
            above,
            above + fast,
        ]
    }
}

/// Force of the stress.
struct Force;

impl Part for Force {
    const LANES: Range<usize> = 4..8;

    #[inline(always)]
    fn at_nodes<L: Lanes>(
        products: &Products,
        line: &[[f64; 8]; 4],
        plane: usize,
        p: usize,
    ) -> [L; 9] {
        // The line of the slow axis is that of mass and momentum.
        let slow = L::splat(products.ratio[0][plane][p]) * L::load(&line[0][Self::LANES]);
        of_ratios::<L>(products, line, Self::LANES, slow, p)
    }
}

/// Force of the stress, and that of the particle.
struct AffineForce;

impl Part for AffineForce {
    const LANES: Range<usize> = 4..8;

    #[inline(always)]
    fn at_nodes<L: Lanes>(
        products: &Products,
        line: &[[f64; 8]; 4],
        plane: usize,
        p: usize,
    ) -> [L; 9] {
        let slow = L::splat(products.ratio[0][plane][p]) * L::load(&line[1][Self::LANES]);
        let slow = slow + L::load(&line[0][Self::LANES]);
        of_ratios::<L>(products, line, Self::LANES, slow, p)
    }
}

/// [`Momentum`] and [`Force`].
struct Whole;

impl Part for Whole {
    const LANES: Range<usize> = 0..8;

    #[inline(always)]
    fn at_nodes<L: Lanes>(
        products: &Products,
        line: &[[f64; 8]; 4],
        plane: usize,
        p: usize,
    ) -> [L; 9] {
        let ratio = products.ratio[0][plane][p];
        let slow = L::splat_two(1.0, ratio, 0xf0) * L::load(&line[0][Self::LANES]);
        // The other lines have nothing in the lower lanes.
        of_ratios::<L>(products, line, Self::LANES, slow, p)
    }
}

/// `slow` and the lines of the other axes, each times derivative over weight.
#[inline(always)]
fn of_ratios<L: Lanes>(
    products: &Products,
    line: &[[f64; 8]; 4],
    lanes: Range<usize>,
    slow: L,
    p: usize,
) -> [L; 9] {
    let [_, middle_ratio, fast_ratio] = &products.ratio;
    let middle = L::load(&line[2][lanes.clone()]);
    let fast = L::load(&line[3][lanes]);
    let mut along = [fast; 3];
    for k in 0..3 {
        along[k] = L::splat(fast_ratio[k][p]) * fast;
    }
    let mut nodes = [slow; 9];
    for j in 0..3 {
        let row = L::splat(middle_ratio[j][p]).mul_add(middle, slow);
        for k in 0..3 {
            nodes[3 * j + k] = row + along[k];
        }
    }
    nodes
}

impl Products {
    /// Adds a part of a run.
    #[inline(always)]
    fn add<P: Part, L: Lanes>(&self, lines: &Lines, below: &RunRows, nodes: &mut [Line]) {
        let mut sums = [L::splat(0.0); 9];
        for j in 0..3 {
            let row = &nodes[below.first + j * below.row_length..][..3];
            for k in 0..3 {
                sums[3 * j + k] = L::load(&row[k][P::LANES]);
            }
        }
        let weights = &self.weights[9 * below.plane..][..9];
        for p in below.run.clone() {
            let at_nodes = P::at_nodes::<L>(self, &lines[p], below.plane, p);
            for n in 0..9 {
                sums[n] = L::splat(weights[n][p]).mul_add(at_nodes[n], sums[n]);
            }
        }
        for j in 0..3 {
            let row = &mut nodes[below.first + j * below.row_length..][..3];
            for k in 0..3 {
                sums[3 * j + k].store(&mut row[k][P::LANES]);
            }
        }
    }
}
