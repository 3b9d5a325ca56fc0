//! Nodes to particles: velocity, position, velocity gradient, stress; lanes = particles.
//!
//! v_p = v_p + sum_I S_Ip dv_I (FLIP), x_p = x_p + dt sum_I S_Ip v_I, L_p = sum_I v_I (x) grad S_Ip
//! (technical manual, algorithm 2, lines 12, 15, 19, 20), then, block by block, the law with L_p. Where the first axis is a radius,
//! L_p has the hoop strain rate sum_I S_Ip v_I,r / r_p too.

mod differences;
pub mod dilation;
mod domain;
mod interpolate;
mod reach;
mod three_nodes;
mod update;
mod values;
mod water;

use super::{Mapping, block_at};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes, Quad, SelectedLanes};
use crate::laws::tensor::Configuration;
use crate::laws::{BLOCK, Block, Gradients, Strain};
use crate::layout::Layout;
use crate::model::DomainUpdate;
use differences::Differences;
use interpolate::{factors, interpolate};
use reach::{Bases, MOST};
use std::ops::Range;
use three_nodes::FactorsOfGroup;
use update::{Maxima, fault, update};
use values::InterpolatedValues;
pub use water::{WaterG2p, WaterTask};

/// Use of the interpolated values in a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Add the velocity increments to the particle velocities.
    pub kick: bool,
    /// Share of the interpolated velocity in the particle velocity, 0 to 1.
    pub pic_fraction: f64,
    /// Time by which positions move \[s\]; `None` leaves them.
    pub drift: Option<f64>,
    /// Displacement of the mesh meanwhile \[m\]; positions are relative to it.
    pub mesh_shift: [f64; 3],
    /// Time of the strain increment and where its gradient belongs \[s\]; `None` leaves the stress.
    pub strain: Option<(f64, Configuration)>,
    /// Gradient from the upper lanes of the nodes (remapped velocity of MUSL) instead of the lower ones.
    pub gradient_of_upper: bool,
    /// Affine velocity that is written to the particles.
    pub affine: Affine,
}

/// Source of the affine velocity C_p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Affine {
    /// None.
    Leave,
    /// B_p D_p^-1 (Jiang et al. 2015).
    Apic,
    /// The velocity gradient.
    Tpic,
}

/// One call: some particles of a set, in layers.
pub struct G2p<'a, 'b> {
    /// Lanes of the law.
    pub lanes: SelectedLanes,
    /// Columns of these particles.
    pub columns: &'a mut [&'b mut [f64]],
    /// Layout of the columns.
    pub layout: &'a Layout,
    /// View of the grid by the set.
    pub mapping: &'a Mapping,
    /// Law of the set.
    pub law: &'a dyn Strain,
    /// Initial density \[kg/m³\].
    pub density: f64,
    /// Update of the particle domain, for cpGIMP.
    pub domain_update: Option<DomainUpdate>,
    /// All nodes.
    pub nodes: &'a [Line],
    /// Smallest numbers beyond the edges of the mesh per axis \[m\].
    pub beyond: [f64; 3],
    /// Result of [`dilation::excess`]; empty where volumetric strain is that of the particles.
    pub excess: &'a [f64],
    /// Task of the pass.
    pub task: Task,
}

/// Maxima over the particles of a G2P pass, from which the next time step is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParticleMaxima {
    /// Largest |v|² \[m²/s²\].
    pub speed_squared: f64,
    /// Largest square of a wave speed \[m²/s²\].
    pub wave_speed_squared: f64,
    /// Largest |dt grad v|² of the last strain.
    pub increment_squared: f64,
    /// Largest move in cells along any axis.
    pub travel: f64,
    /// Largest half-length of a particle domain in cells.
    pub half_length: f64,
    /// First particle that went wrong, relative to the range of the call.
    pub fault: Option<(usize, FaultKind)>,
}

impl ParticleMaxima {
    /// The maxima, one after the other.
    #[must_use]
    pub fn numbers(&self) -> [f64; 5] {
        [
            self.speed_squared,
            self.wave_speed_squared,
            self.increment_squared,
            self.travel,
            self.half_length,
        ]
    }

    /// Puts maxima in the place of these, in the same order.
    pub fn set_numbers(&mut self, numbers: [f64; 5]) {
        [
            self.speed_squared,
            self.wave_speed_squared,
            self.increment_squared,
            self.travel,
            self.half_length,
        ] = numbers;
    }
}

/// Fault of a particle in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A value is not a number or infinite.
    NotFinite,
    /// Volume zero or negative.
    Inverted,
    /// Position outside the mesh.
    Outside,
}

impl ParticleMaxima {
    /// The larger of two findings; the fault of `self` comes first.
    #[must_use]
    pub fn and(self, later: Self) -> Self {
        Self {
            speed_squared: self.speed_squared.max(later.speed_squared),
            wave_speed_squared: self.wave_speed_squared.max(later.wave_speed_squared),
            increment_squared: self.increment_squared.max(later.increment_squared),
            travel: self.travel.max(later.travel),
            half_length: self.half_length.max(later.half_length),
            fault: self.fault.or(later.fault),
        }
    }

    /// Largest wave speed of the set \[m/s\].
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        self.wave_speed_squared.max(0.0).sqrt()
    }
}

/// An interpolation stage, compiled for one dimension, stencil and set of sums.
pub(crate) type G2pFn = fn(SelectedLanes, G2p<'_, '_>) -> ParticleMaxima;

/// Chooses the instance for a task: axes, whether the first of two is a radius, nodes per axis
/// ([`Family::stage_nodes`](crate::weights::Family::stage_nodes)).
#[must_use]
pub fn instance(axes: usize, radial: bool, nodes: usize, task: &Task) -> G2pFn {
    match (axes, radial) {
        (2, false) => by_nodes::<2, false>(nodes, task),
        (2, true) => by_nodes::<2, true>(nodes, task),
        _ => by_nodes::<3, false>(nodes, task),
    }
}

fn by_nodes<const D: usize, const RADIAL: bool>(nodes: usize, task: &Task) -> G2pFn {
    let gradient = task.strain.is_some() || task.affine == Affine::Tpic;
    let apic = task.affine == Affine::Apic;
    match nodes {
        2 => sums::<D, 2, RADIAL>(task, gradient, apic),
        3 => sums::<D, 3, RADIAL>(task, gradient, apic),
        _ => sums::<D, 4, RADIAL>(task, gradient, apic),
    }
}

fn sums<const D: usize, const N: usize, const RADIAL: bool>(
    task: &Task,
    gradient: bool,
    apic: bool,
) -> G2pFn {
    // A velocity that is all PIC is that of the nodes, without their increments. Who adds increments and does nothing else has
    // no use for velocities.
    let kick = task.kick && task.pic_fraction != 1.0;
    let moves = task.drift.is_some() || task.pic_fraction != 0.0;
    match (kick, gradient, apic, task.gradient_of_upper) {
        (true, _, true, _) => entry::<D, N, true, true, true, false, true, RADIAL>,
        (false, _, true, _) => entry::<D, N, false, true, true, false, true, RADIAL>,
        (_, true, false, true) => entry::<D, N, false, true, false, true, true, RADIAL>,
        (true, true, false, false) => entry::<D, N, true, true, false, false, true, RADIAL>,
        (true, false, false, _) if moves => entry::<D, N, true, false, false, false, true, RADIAL>,
        (true, false, false, _) => entry::<D, N, true, false, false, false, false, RADIAL>,
        (false, _, false, _) => entry::<D, N, false, true, false, false, true, RADIAL>,
    }
}

fn entry<
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
    const MOVE: bool,
    const RADIAL: bool,
>(
    lanes: SelectedLanes,
    call: G2p<'_, '_>,
) -> ParticleMaxima {
    lanes.run(Instance::<
        '_,
        '_,
        D,
        N,
        KICK,
        GRADIENT,
        APIC,
        UPPER,
        MOVE,
        RADIAL,
    >(call))
}

/// One of these stages as a kernel; `UPPER` takes gradients of the upper lanes, without `MOVE` there are no velocities, with `RADIAL`
/// the first axis is a radius.
struct Instance<
    'a,
    'b,
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
    const MOVE: bool,
    const RADIAL: bool,
>(pub G2p<'a, 'b>);

impl<
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
    const MOVE: bool,
    const RADIAL: bool,
> Kernel for Instance<'_, '_, D, N, KICK, GRADIENT, APIC, UPPER, MOVE, RADIAL>
{
    type Output = ParticleMaxima;

    #[inline(always)]
    fn run<B: Backend>(self) -> ParticleMaxima {
        let mut call = self.0;
        let end = call.columns[0].len();
        let mut maxima = Maxima::<B::Native>::new();
        let mut of_strain = ParticleMaxima::default();
        let mut values = InterpolatedValues::zero();
        let mut each = FactorsOfGroup::new();
        let mut at = 0;
        while at < end {
            let block = at;
            while at < end && at - block < BLOCK {
                at += gather::<B::Native, B::Half, D, N, KICK, GRADIENT, APIC, UPPER, MOVE, RADIAL>(
                    &call,
                    at..end,
                    &mut each,
                    (at - block, &mut values),
                );
            }
            // In a loop of its own, far from where the values were written: in lanes that are put together of parts, they
            // would have to be waited for.
            let mut bad = None;
            let mut group = block;
            while group < at {
                // Written twice, so that nothing is masked in full groups.
                let (count, from) = ((at - group).min(B::Native::WIDTH), group - block);
                let lanes = if count == B::Native::WIDTH {
                    let count = B::Native::WIDTH;
                    update::<B::Native, D>(&mut call, &values, from, &mut maxima, group, count)
                } else {
                    update::<B::Native, D>(&mut call, &values, from, &mut maxima, group, count)
                };
                if lanes != 0 && bad.is_none() {
                    bad = Some(group + lanes.trailing_zeros() as usize);
                }
                group += count;
            }
            if GRADIENT && call.task.strain.is_some() {
                let gradients = &mut values.gradient;
                if !call.excess.is_empty() {
                    dilation::take(&call.excess[block..at], D, RADIAL, gradients);
                }
                let first = strain(&mut call, gradients, block..at, &mut of_strain);
                bad = [bad, first].into_iter().flatten().min();
            }
            if of_strain.fault.is_none() {
                of_strain.fault = bad.map(|p| (p, fault::<D>(&call, p)));
            }
        }
        maxima.found(of_strain)
    }
}

/// Interpolates to the first particles of a range, as many as lanes and base nodes allow: how many. Writes from particle `to` of
/// the values on.
#[inline(always)]
fn gather<
    L: Lanes,
    Q: Quad,
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
    const MOVE: bool,
    const RADIAL: bool,
>(
    call: &G2p<'_, '_>,
    Range { start: at, end }: Range<usize>,
    each: &mut FactorsOfGroup,
    (to, values): (usize, &mut InterpolatedValues),
) -> usize {
    let (columns, mapping, nodes) = (&*call.columns, call.mapping, call.nodes);
    let block = block_at::<L, _, D, N>(columns, mapping, at, end);
    let bases = Bases::ahead::<_, D, N>(&block, columns, mapping, at, end);
    let count = bases.count;
    macro_rules! interpolate {
        ($nodes:tt, $bases:tt, $on_nodes:tt, $from:expr) => {
            interpolate::<L, D, $nodes, KICK, GRADIENT, APIC, UPPER, MOVE, RADIAL, $bases, $on_nodes>(
                columns,
                mapping,
                &$from.reach(nodes),
                &block,
                at,
                to,
                values,
            )
        };
    }
    if N == 2 && block.on_a_node::<D>() {
        // So rare that one instance has to do.
        interpolate!(3, MOST, true, bases.before::<D>(mapping));
        return count;
    }
    // Instances of their own: each further base node costs another load of every node. One lane has no second.
    match bases.number {
        n if n < 2 || L::WIDTH == 1 => interpolate!(N, 1, false, bases),
        2 => interpolate!(N, 2, false, bases),
        _ if D == 3 && N == 3 && !(L::WIDTH == 8 && call.lanes.whole_groups()) => {
            let [w, g, q] = factors::<L, D, N, APIC, false, false>(columns, mapping, &block, at);
            let differences = Differences::new::<D, N>(&w, &g, &q);
            each.interpolate_each::<L, Q, D, KICK, GRADIENT, APIC, UPPER, MOVE>(
                mapping,
                nodes,
                &block,
                &differences,
                to,
                values,
            );
            return block.count;
        }
        _ => interpolate!(N, MOST, false, bases),
    }
    count
}

/// Strains a block of particles; the first of them that went wrong.
fn strain(
    call: &mut G2p<'_, '_>,
    gradients: &Gradients,
    range: Range<usize>,
    found: &mut ParticleMaxima,
) -> Option<usize> {
    let (dt, configuration) = call.task.strain?;
    let strained = call.law.strain(
        call.lanes,
        Block {
            columns: call.columns,
            layout: call.layout,
            range: range.clone(),
            gradients,
            dt,
            configuration,
            density: call.density,
            volume_of_deformation: call.domain_update.is_some(),
        },
    );
    found.wave_speed_squared = found.wave_speed_squared.max(strained.speed_squared);
    found.increment_squared = found.increment_squared.max(strained.increment_squared);
    if let Some(update) = call.domain_update {
        let parts = call.law.parts();
        let most = domain::follow(call.lanes, update, parts, call.columns, call.layout, range);
        found.half_length = found.half_length.max(most);
    }
    strained.fault
}
