//! The volumetric part of velocity gradients as the mean over cells.
//!
//! tr L of a particle becomes sum_I v_I . B_I, where the component of B_I along an axis is the derivative of S_I along it with
//! the other factors of S_I replaced by their means over the cells in which the particle domain lies: selective reduced
//! integration for particles (Hughes 1980; Nagtegaal, Parks and Rice 1974).
//!
//! Where the first axis is a radius, radial and hoop strain have one mean together, and what is across the radius is a mean over
//! rings (`weights::ring_mean_weights`).

use super::reach::{Bases, BlockReach, MOST};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes, SelectedLanes};
use crate::laws::{Gradients, HOOP, MOST_LANES};
use crate::layout::Layout;
use crate::stage::{Mapping, block_at, radii, weights_of};
use crate::weights::{cell_mean_weights, ring_mean_weights};

/// Excess of tr L of some particles over its mean over cells, at their positions of now, shared among the axes \[1/s\], into
/// `found`. `upper` takes the velocities of the upper lanes of the nodes.
#[expect(clippy::too_many_arguments)]
pub fn excess(
    lanes: SelectedLanes,
    stencil: usize,
    columns: &[&mut [f64]],
    layout: &Layout,
    mapping: &Mapping,
    nodes: &[Line],
    upper: bool,
    found: &mut Vec<f64>,
) {
    let source = if upper { 4 } else { 1 };
    macro_rules! run {
        ($axes:tt, $nodes:tt, $radial:tt) => {
            lanes.run(ExcessKernel::<$axes, $nodes, $radial>(
                columns, mapping, nodes, source, found,
            ))
        };
    }
    match (layout.axes, stencil, layout.axisymmetric) {
        (2, 3, false) => run!(2, 3, false),
        (2, _, false) => run!(2, 4, false),
        (_, 3, false) => run!(3, 3, false),
        (_, _, false) => run!(3, 4, false),
        (_, 3, true) => run!(2, 3, true),
        (_, _, true) => run!(2, 4, true),
    }
}

/// Takes the excess of its particles from the gradients of a block, and from their hoop strain rates where they have them.
#[inline(never)]
pub(super) fn take(excess: &[f64], axes: usize, radial: bool, gradients: &mut Gradients) {
    let along = (0..axes).map(|axis| (axes + 1) * axis);
    for place in along.chain(radial.then_some(HOOP)) {
        for (component, excess) in gradients.0[place].iter_mut().zip(excess) {
            *component -= excess;
        }
    }
}

/// Finds it in lanes: columns, mapping, nodes, first lane of the velocity, and where it goes to.
struct ExcessKernel<'a, 'b, const D: usize, const N: usize, const RADIAL: bool>(
    &'a [&'b mut [f64]],
    &'a Mapping,
    &'a [Line],
    usize,
    &'a mut Vec<f64>,
);

impl<const D: usize, const N: usize, const RADIAL: bool> Kernel
    for ExcessKernel<'_, '_, D, N, RADIAL>
{
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        let Self(columns, mapping, nodes, source, excess) = self;
        let sums = NodeTotals::<D, N> { mapping, source };
        let count = columns[0].len();
        // A whole block may be written behind the last particle.
        excess.resize(count + MOST_LANES, 0.0);
        let mut at = 0;
        while at < count {
            let block = block_at::<B::Native, _, D, N>(columns, mapping, at, count);
            let bases = Bases::of::<D>(&block, mapping);
            let (w, g) =
                weights_of::<B::Native, _, D, N, false, false>(columns, mapping, &block, at);
            let one_base = bases.number < 2 || B::Native::WIDTH == 1;
            let sum = if RADIAL {
                let (first, inverse) = radii(mapping, &block);
                let (_, with_radius) =
                    weights_of::<B::Native, _, D, N, false, true>(columns, mapping, &block, at);
                let radial = RadialWeights::new(&w[0], &g[0], &with_radius[0], first, inverse);
                if one_base {
                    sums.of_rings(&bases.reach::<1>(nodes), &w, &g, &radial)
                } else {
                    sums.of_rings(&bases.reach::<MOST>(nodes), &w, &g, &radial)
                }
            } else if one_base {
                sums.of(&bases.reach::<1>(nodes), &w, &g)
            } else {
                sums.of(&bases.reach::<MOST>(nodes), &w, &g)
            };
            let directions = if RADIAL { 3 } else { D };
            let share = B::Native::splat(1.0 / directions as f64) * sum;
            share.store(&mut excess[at..at + MOST_LANES]);
            at += bases.count;
        }
        excess.truncate(count);
    }
}

/// Weights along the radius.
struct RadialWeights<L, const N: usize> {
    /// Of radial and hoop strain together, times h.
    strains: [L; N],
    /// Of their mean over cells.
    mean_strains: [L; N],
    /// Of the mean over rings of what is across the radius.
    means: [L; N],
}

impl<L: Lanes, const N: usize> RadialWeights<L, N> {
    /// From weights, derivatives of the plane and those with the radius, the radius of the first node in cells, and one over that of
    /// the particle.
    #[inline(always)]
    fn new(w: &[L; N], g: &[L; N], with_radius: &[L; N], first: L, inverse: L) -> Self {
        let [means, mean_strains] = ring_mean_weights::<L, N>(g, first);
        let mut strains = *w;
        for n in 0..N {
            strains[n] = w[n].mul_add(inverse, with_radius[n]);
        }
        Self {
            strains,
            mean_strains,
            means,
        }
    }
}

/// Sums over the nodes of a block.
#[derive(Clone, Copy)]
struct NodeTotals<'a, const D: usize, const N: usize> {
    mapping: &'a Mapping,
    /// First lane of the velocity.
    source: usize,
}

impl<const D: usize, const N: usize> NodeTotals<'_, D, N> {
    /// Excess of tr L over its mean over cells.
    #[inline(always)]
    fn of<L: Lanes, const R: usize>(
        &self,
        reach: &BlockReach<'_, L, R>,
        w: &[[L; N]; 3],
        g: &[[L; N]; 3],
    ) -> L {
        let mut mean = *w;
        for axis in 0..D {
            mean[axis] = cell_mean_weights::<L, N>(&g[axis]);
        }
        let mut sum = L::splat(0.0);
        for axis in 0..D {
            let part = self.along(axis, reach, w, &mean, g);
            sum = L::splat(self.mapping.inverse_cell[axis]).mul_add(part, sum);
        }
        sum
    }

    /// The same where the first axis is a radius.
    #[inline(always)]
    fn of_rings<L: Lanes, const R: usize>(
        &self,
        reach: &BlockReach<'_, L, R>,
        w: &[[L; N]; 3],
        g: &[[L; N]; 3],
        radial: &RadialWeights<L, N>,
    ) -> L {
        let Self { mapping, source } = *self;
        let [_, middle, fast] = mapping.nodes;
        let mut mean = *w;
        (mean[0], mean[1]) = (radial.means, cell_mean_weights::<L, N>(&g[1]));
        let mut around = L::splat(0.0);
        for i in 0..N {
            for k in 0..N {
                let node = reach.rows::<1>(i * middle * fast + k);
                let v_i = reach.value(&node, 0, source);
                let difference = radial.strains[i] * w[1][k] - radial.mean_strains[i] * mean[1][k];
                around = difference.mul_add(v_i, around);
            }
        }
        let along = self.along(1, reach, w, &mean, g);
        let [a, b] = [0, 1].map(|axis| L::splat(mapping.inverse_cell[axis]));
        a.mul_add(around, b * along)
    }

    /// h sum_I g_I (w_I - mean_I) v_I of one component of the velocity: `g` along its axis, the other two across it.
    #[inline(always)]
    fn along<L: Lanes, const R: usize>(
        &self,
        axis: usize,
        reach: &BlockReach<'_, L, R>,
        w: &[[L; N]; 3],
        mean: &[[L; N]; 3],
        g: &[[L; N]; 3],
    ) -> L {
        let Self { mapping, source } = *self;
        let [_, middle, fast] = mapping.nodes;
        // Nodes from one to the next along each axis; the plane has no middle one.
        let step = if D == 3 {
            [middle * fast, fast, 1]
        } else {
            [middle * fast, 1, 0]
        };
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
                let row = i * step[a] + j * step[b];
                let mut along = L::splat(0.0);
                for k in 0..N {
                    let node = reach.rows::<1>(row + k * step[axis]);
                    let v_i = reach.value(&node, 0, source + axis);
                    along = g[axis][k].mul_add(v_i, along);
                }
                sum = difference.mul_add(along, sum);
            }
        }
        sum
    }
}
