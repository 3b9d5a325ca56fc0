//! Particles to nodes: mass, momentum and force, lanes = quantities of a node.
//!
//! m_I = sum_p m_p S_Ip, p_I = sum_p m_p (v_p + C_p (x_I - x_p)) S_Ip,
//! f_I = sum_p (f_p S_Ip - V_p sigma_p . grad S_Ip)   (technical manual, algorithm 2, lines 1, 2, 5, 6).
//!
//! Where the first axis is a radius, the hoop stress adds -V_p sigma_tt S_Ip / r_p to the radial force.
//!
//! The caller owns some planes of nodes and pulls from all particles that reach them; a node's sum is formed
//! in the order of the particles whatever planes the caller owns, so the bits do not depend on the partition.

mod add;
mod groups;
mod products;
mod runs;
mod scratch;
mod source;
mod water;

use super::{Block, Mapping, block_at};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, SelectedLanes};
use crate::layout::Layout;
use crate::weights::Family;
use add::{RunRows, add_run};
pub use groups::groups_from;
use products::{Products, add_linear, add_products};
use runs::{GroupCount, Runs};
use scratch::Scratch;
use source::P2gSource;
use std::ops::Range;
pub use water::{WaterCarry, WaterP2g};

/// Quantities that are carried to the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carry {
    /// Mass and momentum to the lower lanes, force to the upper ones.
    All,
    /// Mass and momentum to the lower lanes.
    Momentum,
    /// Force to the upper lanes.
    Force,
    /// Momentum to the upper lanes (the second mapping of MUSL).
    Remap,
    /// Mass gradient sum m grad S to the upper lanes, for the normals of contact.
    MassGradient,
    /// Force of the mean stress along the axes of the scene to the upper lanes, which hold other forces: with cell means of the
    /// strain operator if `averaged`, else minus that of the usual operator, of which it takes the place.
    MeanStress {
        /// True for the averaged one of the two.
        averaged: bool,
    },
}

/// One call: the particles of some layers of a set onto some planes.
pub struct P2g<'a> {
    /// Columns of the set.
    pub columns: &'a [Vec<f64>],
    /// Layout of the columns.
    pub layout: &'a Layout,
    /// View of the grid by the set.
    pub mapping: &'a Mapping,
    /// Particles of each layer, in order, and whether the caller owns the layer; runs do not cross layers.
    pub layers: &'a mut dyn Iterator<Item = (Range<usize>, bool)>,
    /// Planes of nodes that are owned.
    pub planes: Range<usize>,
    /// The nodes of these planes.
    pub nodes: &'a mut [Line],
    /// Quantities that are carried.
    pub carry: Carry,
    /// Rate of viscous damping, f = -rate m v \[1/s\] (Liang et al. 2024, eq. 20); 0 for none.
    pub viscous_rate: f64,
}

/// An instance carries nothing beyond mass, momentum and force.
const NOTHING: u8 = 0;
/// It carries the mass gradient instead of them.
const MASS_GRADIENT: u8 = 1;
/// It carries the force of the mean stress instead of them.
const MEAN_STRESS: u8 = 2;
/// It carries the force of the hoop stress with that of the others, where the first axis is a radius.
const AXISYMMETRIC: u8 = 3;
/// It carries the gradient of mass over radius instead of them.
const RING_GRADIENT: u8 = 4;
/// It carries the force of the mean stress instead of them, where the first axis is a radius.
const RING_MEAN: u8 = 5;

/// Form of the sums over the nodes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SumForm {
    /// Row by row, with weights and derivatives along each axis.
    Rows,
    /// Products of weights with quotients of derivative and weight.
    Products,
    /// Products of weights with terms that are linear in the distance.
    Linear,
}

/// 1/`D_p` of quadratic B-splines in cells.
const INVERSE_INERTIA: f64 = 4.0;

/// A mapping stage, compiled for one dimension, stencil and set of terms. Returns the number of groups in the
/// layers that the caller owns.
pub type P2gFn = fn(SelectedLanes, P2g<'_>) -> usize;

/// Chooses the instance: axes, whether the first of two is a radius, nodes per axis
/// ([`Family::stage_nodes`](crate::weights::Family::stage_nodes)), whether particles carry affine velocity or forces of
/// their own (`full`).
///
/// Without affine velocity, mass and momentum need no derivative and take a shorter loop.
///
/// # Panics
/// For [`Carry::Force`] around an axis: force goes with mass and momentum there.
#[must_use]
pub fn instance(axes: usize, radial: bool, nodes: usize, full: bool, carry: Carry) -> P2gFn {
    match (carry, axes, radial) {
        (Carry::Force, _, true) => {
            panic!("no axisymmetric mapping carries force alone")
        }
        // An instance of its own, so that the others do not ask for every particle.
        (Carry::MassGradient, 2, false) => from_three::<2, MASS_GRADIENT>(nodes),
        (Carry::MassGradient, _, true) => from_three::<2, RING_GRADIENT>(nodes),
        (Carry::MassGradient, _, _) => from_three::<3, MASS_GRADIENT>(nodes),
        (Carry::MeanStress { .. }, 2, false) => from_three::<2, MEAN_STRESS>(nodes),
        (Carry::MeanStress { .. }, _, true) => from_three::<2, RING_MEAN>(nodes),
        (Carry::MeanStress { .. }, _, _) => from_three::<3, MEAN_STRESS>(nodes),
        (Carry::All, _, true) => with_gradient::<2, AXISYMMETRIC>(nodes, full),
        (Carry::All | Carry::Force, 2, false) => with_gradient::<2, NOTHING>(nodes, full),
        (Carry::All | Carry::Force, _, _) => with_gradient::<3, NOTHING>(nodes, full),
        // Mass and momentum go with the weights, which are those of the plane around an axis, too.
        (Carry::Momentum | Carry::Remap, 2, _) if full => with_gradient::<2, NOTHING>(nodes, full),
        (Carry::Momentum | Carry::Remap, _, _) if full => with_gradient::<3, NOTHING>(nodes, full),
        (Carry::Momentum | Carry::Remap, 2, _) => by_nodes::<2, false, false, NOTHING>(nodes),
        (Carry::Momentum | Carry::Remap, _, _) => by_nodes::<3, false, false, NOTHING>(nodes),
    }
}

fn with_gradient<const D: usize, const EXTRA: u8>(nodes: usize, full: bool) -> P2gFn {
    if full {
        by_nodes::<D, true, true, EXTRA>(nodes)
    } else {
        by_nodes::<D, false, true, EXTRA>(nodes)
    }
}

/// Chooses by the nodes per axis of the stage, of which hats have two.
fn by_nodes<const D: usize, const FULL: bool, const GRADIENT: bool, const EXTRA: u8>(
    nodes: usize,
) -> P2gFn {
    match nodes {
        2 => entry::<D, 2, FULL, GRADIENT, EXTRA>,
        3 => entry::<D, 3, FULL, GRADIENT, EXTRA>,
        _ => entry::<D, 4, FULL, GRADIENT, EXTRA>,
    }
}

/// The same for what is mapped to the three nodes of hats.
fn from_three<const D: usize, const EXTRA: u8>(nodes: usize) -> P2gFn {
    if nodes == 4 {
        entry::<D, 4, false, true, EXTRA>
    } else {
        entry::<D, 3, false, true, EXTRA>
    }
}

fn entry<
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const EXTRA: u8,
>(
    lanes: SelectedLanes,
    call: P2g<'_>,
) -> usize {
    lanes.run(Instance::<'_, D, N, FULL, GRADIENT, EXTRA>(call))
}

/// One of these stages as a kernel; `EXTRA` is what else is mapped.
struct Instance<
    'a,
    const D: usize,
    const N: usize,
    const FULL: bool,
    const GRADIENT: bool,
    const EXTRA: u8,
>(pub P2g<'a>);

impl<const D: usize, const N: usize, const FULL: bool, const GRADIENT: bool, const EXTRA: u8> Kernel
    for Instance<'_, D, N, FULL, GRADIENT, EXTRA>
{
    type Output = usize;

    #[inline(always)]
    fn run<B: Backend>(self) -> usize {
        let Self(call) = self;
        // Hats have nodes without a weight that have a derivative.
        let as_products = D == 3
            && N == 3
            && GRADIENT
            && EXTRA == NOTHING
            && call.carry == Carry::All
            && call.mapping.family != Family::Hat;
        let sums = match as_products {
            true if FULL && call.mapping.least_squares => SumForm::Linear,
            true => SumForm::Products,
            false => SumForm::Rows,
        };
        let from = P2gSource {
            columns: call.columns,
            layout: call.layout,
            mapping: call.mapping,
            carry: call.carry,
            viscous_rate: call.viscous_rate,
            stress_factor: match sums {
                SumForm::Linear => INVERSE_INERTIA,
                SumForm::Rows | SumForm::Products => 1.0,
            },
            sums,
        };
        let mut onto = OwnedNodes {
            planes: call.planes,
            nodes: call.nodes,
        };
        let mut products = Products::new();
        let mut scratch = Scratch::<N>::new();
        let mut groups = 0;
        for (layer, own_layer) in call.layers {
            let mut counted = GroupCount::default();
            let mut at = layer.start;
            while at < layer.end {
                let block = block_at::<B::Line, _, D, N>(from.columns, from.mapping, at, layer.end);
                let runs = Runs::of::<B::Line, D>(&block, from.mapping);
                if N == 2 && block.on_a_node::<D>() {
                    // So rare that what it needs is not kept.
                    let mut wider = Scratch::<3>::new();
                    onto.add::<B, D, 3, FULL, GRADIENT, EXTRA, true>(
                        &from,
                        &block,
                        &runs,
                        at,
                        &mut products,
                        &mut wider,
                    );
                } else {
                    onto.add::<B, D, N, FULL, GRADIENT, EXTRA, false>(
                        &from,
                        &block,
                        &runs,
                        at,
                        &mut products,
                        &mut scratch,
                    );
                }
                if own_layer {
                    counted.add(&runs);
                }
                at += block.count;
            }
            groups += counted.groups();
        }
        groups
    }
}

/// Adds both parts of what was mapped to the upper lanes of a node in the plane, where what came through the derivative along the
/// fast axis lies beside what came through that along the slow one: each is a sum in the order of the particles.
#[inline(always)]
pub fn join(line: &mut Line) {
    for lane in 4..6 {
        line[lane] += line[lane + 2];
        line[lane + 2] = 0.0;
    }
}

/// The same where the force of the hoop stress, which goes with the weights, lies in the lane of the third component of momentum.
#[inline(always)]
pub fn join_with_hoop(line: &mut Line) {
    join(line);
    line[4] += line[3];
    line[3] = 0.0;
}

/// True if a stage leaves a node in two parts, which [`join`] adds.
#[must_use]
pub fn leaves_parts(axes: usize, full: bool, carry: Carry) -> bool {
    let derivative = match carry {
        Carry::Momentum => false,
        Carry::Remap => full,
        Carry::All | Carry::Force | Carry::MassGradient | Carry::MeanStress { .. } => true,
    };
    axes == 2 && derivative
}

/// The nodes that the caller owns.
struct OwnedNodes<'a> {
    planes: Range<usize>,
    nodes: &'a mut [Line],
}

impl OwnedNodes<'_> {
    /// Adds a block that begins at particle `at`; with `ON_NODES` the first node of the stencil is that before the base node.
    #[inline(always)]
    fn add<
        B: Backend,
        const D: usize,
        const N: usize,
        const FULL: bool,
        const GRADIENT: bool,
        const EXTRA: u8,
        const ON_NODES: bool,
    >(
        &mut self,
        from: &P2gSource<'_>,
        block: &Block<B::Line>,
        runs: &Runs,
        at: usize,
        products: &mut Products,
        scratch: &mut Scratch<N>,
    ) {
        let Self { planes, nodes } = self;
        let mapping = from.mapping;
        if !runs.reach::<D, N, ON_NODES>(planes) {
            return;
        }
        // What has no instance is never asked for.
        let sums = if D == 3 && N == 3 && !ON_NODES && GRADIENT && EXTRA == NOTHING {
            from.sums
        } else {
            SumForm::Rows
        };
        let averaged = from.carry == (Carry::MeanStress { averaged: true });
        if sums == SumForm::Rows {
            // A comparison is no argument of a generic function.
            if EXTRA == AXISYMMETRIC || (EXTRA == RING_MEAN && !averaged) {
                scratch.fill_weights::<B::Line, D, FULL, GRADIENT, true, ON_NODES>(from, block, at);
            } else {
                scratch
                    .fill_weights::<B::Line, D, FULL, GRADIENT, false, ON_NODES>(from, block, at);
            }
        } else {
            products.fill::<B::Line, FULL>(from, block, at, sums == SumForm::Linear);
        }
        if (EXTRA == MEAN_STRESS || EXTRA == RING_MEAN) && averaged {
            scratch.take_cell_means::<B::Line, D>();
        }
        if EXTRA == RING_MEAN {
            scratch.take_rings::<B::Line>(from, block, averaged);
        }
        scratch.fill_lines::<B::Half, D, FULL, GRADIENT, EXTRA>(from, at, block.count);
        let mut first = 0;
        while first < block.count {
            let run = runs.from(first);
            first = run.end;
            let [first_plane, row, along] = runs.base::<D, ON_NODES>(run.start);
            let own = first_plane.max(planes.start)..(first_plane + N).min(planes.end);
            if own.start >= own.end {
                continue;
            }
            let row_length = mapping.nodes[2];
            if D == 2 {
                let below = RunRows {
                    run,
                    plane: 0,
                    first: (own.start - planes.start) * row_length + along,
                    rows: own.start - first_plane..own.end - first_plane,
                    row_length,
                };
                add_run::<B, D, N, FULL, GRADIENT>(scratch, from.carry, &below, nodes);
            } else {
                for plane in own {
                    let row = (plane - planes.start) * mapping.nodes[1] + row;
                    let below = RunRows {
                        run: run.clone(),
                        plane: plane - first_plane,
                        first: row * row_length + along,
                        rows: 0..N,
                        row_length,
                    };
                    let lines = &scratch.lines;
                    match sums {
                        SumForm::Products => {
                            add_products::<B, FULL>(products, lines, &below, nodes);
                        }
                        SumForm::Linear if FULL => add_linear::<B>(products, lines, &below, nodes),
                        _ => {
                            add_run::<B, D, N, FULL, GRADIENT>(scratch, from.carry, &below, nodes);
                        }
                    }
                }
            }
        }
    }
}

/// Column of the stress component sigma_ab, counted from the first.
#[inline(always)]
pub(crate) const fn voigt<const D: usize>(a: usize, b: usize) -> usize {
    if a == b {
        a
    } else if D == 2 {
        3
    } else {
        // yz, xz, xy are 3, 4, 5: six minus the sum of the two axes.
        6 - a - b
    }
}
