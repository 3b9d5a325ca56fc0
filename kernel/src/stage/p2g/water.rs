//! Pore water of particles to the nodes of its field, lanes = numbers of a node.
//!
//! M_I = sum_p m_p S_Ip, P_I = sum_p m_p w_p S_Ip with the mass m = n `rho_w` V of the water; F_I = sum_p V_p p_p grad S_Ip to
//! the upper lanes, and in the last of them the drag along the first axis sum_p V_p D_p S_Ip with D = n² `rho_w` `g_k`/k.

use super::runs::Runs;
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Quad, SelectedLanes, load};
use crate::layout::Layout;
use crate::model::{Permeability, PoreWater};
use crate::stage::water::{Derivatives, FactorKind, Factors, MOST, Weights};
use crate::stage::{Mapping, block_at};
use crate::weights::base_offset;
use std::ops::Range;

/// Quantities of the pore water that are carried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WaterCarry {
    /// Mass and momentum to the lower lanes, force of the pressure and drag to the upper ones.
    All {
        /// True where the pressure is a mean over cells.
        averaged: bool,
    },
    /// Momentum to the upper lanes (the second mapping of MUSL).
    Remap,
}

/// One call: the particles of some layers of a set onto some planes.
pub(crate) struct WaterP2g<'a> {
    /// Columns of the set.
    pub columns: &'a [Vec<f64>],
    /// Layout of the columns.
    pub layout: &'a Layout,
    /// View of the grid by the set.
    pub mapping: &'a Mapping,
    /// Particles of each layer, in order; runs do not cross layers.
    pub layers: &'a mut dyn Iterator<Item = (Range<usize>, bool)>,
    /// Planes of nodes that are owned.
    pub planes: Range<usize>,
    /// The nodes of these planes.
    pub nodes: &'a mut [Line],
    /// Quantities that are carried.
    pub carry: WaterCarry,
    /// The water in the pores.
    pub water: &'a PoreWater,
}

impl WaterP2g<'_> {
    /// Maps to so many nodes per axis.
    pub(crate) fn run(self, lanes: SelectedLanes, axes: usize, stencil: usize) {
        match (axes, stencil, self.carry) {
            (2, 4, WaterCarry::Remap) => lanes.run(Instance::<'_, 2, 4, true>(self)),
            (2, 4, _) => lanes.run(Instance::<'_, 2, 4, false>(self)),
            (2, _, WaterCarry::Remap) => lanes.run(Instance::<'_, 2, 3, true>(self)),
            (2, _, _) => lanes.run(Instance::<'_, 2, 3, false>(self)),
            (_, 4, WaterCarry::Remap) => lanes.run(Instance::<'_, 3, 4, true>(self)),
            (_, 4, _) => lanes.run(Instance::<'_, 3, 4, false>(self)),
            (_, _, WaterCarry::Remap) => lanes.run(Instance::<'_, 3, 3, true>(self)),
            (_, _, _) => lanes.run(Instance::<'_, 3, 3, false>(self)),
        }
    }
}

/// One dimension, stencil and set of terms as a kernel.
struct Instance<'a, const D: usize, const N: usize, const REMAP: bool>(WaterP2g<'a>);

impl<const D: usize, const N: usize, const REMAP: bool> Kernel for Instance<'_, D, N, REMAP> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        let Self(call) = self;
        let Some(first) = call.layout.water else {
            return;
        };
        let averaged = call.carry == WaterCarry::All { averaged: true };
        let (columns, mapping) = (call.columns, call.mapping);
        let mut factors = Factors::<N>::new();
        let mut lines = Lines::new();
        let mut onto = OwnedNodes {
            planes: call.planes,
            nodes: call.nodes,
            mapping,
        };
        for (layer, _) in call.layers {
            let mut at = layer.start;
            while at < layer.end {
                let mut block = block_at::<B::Line, _, D, N>(columns, mapping, at, layer.end);
                block.count = whole_runs::<D, N>(columns, mapping, at, block.count, layer.end);
                let runs = Runs::of::<B::Line, D>(&block, mapping);
                if runs.reach::<D, N, false>(&onto.planes) {
                    factors.fill::<B::Half, _, D>(columns, mapping, averaged, at, block.count);
                    lines.fill::<B::Half, D, REMAP>(columns, first, call.water, at, block.count);
                    let mut next = 0;
                    while next < block.count {
                        let run = runs.from(next);
                        next = run.end;
                        let base = runs.base::<D, false>(run.start);
                        onto.add::<B::Half, D, N, REMAP>(&factors, &lines, &run, base);
                    }
                }
                at += block.count;
            }
        }
    }
}

/// Particles of a block of `count` from `at`, without the last of them where those behind the block have their base node, so that
/// no run is cut in two; all of them where they are one run.
#[inline(always)]
fn whole_runs<const D: usize, const N: usize>(
    columns: &[Vec<f64>],
    mapping: &Mapping,
    at: usize,
    count: usize,
    end: usize,
) -> usize {
    if at + count == end {
        return count;
    }
    let base = |p: usize, axis: usize| {
        let xi = columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis];
        (xi - base_offset(N)).floor()
    };
    let behind = at + count;
    let as_behind = |p: usize| (0..D).all(|axis| base(p, axis) == base(behind, axis));
    let mut whole = count;
    while whole > 0 && as_behind(at + whole - 1) {
        whole -= 1;
    }
    if whole == 0 { count } else { whole }
}

/// Numbers that a block of particles gives to nodes, `[particle][number]`.
#[repr(align(64))]
struct Lines {
    /// Goes with the weights.
    lower: [[f64; 4]; MOST],
    /// Goes with derivatives, but for the last number.
    upper: [[f64; 4]; MOST],
}

impl Lines {
    #[inline(always)]
    fn new() -> Self {
        Self {
            lower: [[0.0; 4]; MOST],
            upper: [[0.0; 4]; MOST],
        }
    }

    /// That of `count` particles from `at`, whose columns of the water begin at `first`.
    #[inline(always)]
    fn fill<Q: Quad, const D: usize, const REMAP: bool>(
        &mut self,
        columns: &[Vec<f64>],
        first: usize,
        water: &PoreWater,
        at: usize,
        count: usize,
    ) {
        let zero = Q::splat(0.0);
        let mut done = 0;
        while done < count {
            let part = (count - done).min(4);
            let from = at + done;
            let mass = load::<Q>(&columns[Layout::MASS], from, part);
            let volume = load::<Q>(&columns[Layout::VOLUME], from, part);
            let pores = volume - mass * Q::splat(1.0 / water.grain_density);
            let of_water = Q::splat(water.density) * pores;
            let mut momentum = [zero; 3];
            for c in 0..D {
                momentum[c] = of_water * load::<Q>(&columns[first + c], from, part);
            }
            let [x, y, z] = momentum;
            let lower = if REMAP {
                [x, y, z, zero]
            } else {
                [of_water, x, y, z]
            };
            store_lines::<Q>(lower, &mut self.lower[done..done + 4]);
            if !REMAP {
                let drag = drag::<Q>(water, mass, volume, pores);
                let force = volume * load::<Q>(&columns[first + D], from, part);
                let along_z = if D == 3 { force } else { zero };
                let upper = [force, force, along_z, drag];
                store_lines::<Q>(upper, &mut self.upper[done..done + 4]);
            }
            done += 4;
        }
    }
}

/// Stores numbers, lanes = particles, as a line of each particle.
#[inline(always)]
fn store_lines<Q: Quad>(numbers: [Q; 4], lines: &mut [[f64; 4]]) {
    let turned = Q::transpose(numbers);
    for p in 0..4 {
        turned[p].store(&mut lines[p]);
    }
}

/// Drag along the first axis on the water of particles over its velocity \[N s/m\].
#[inline(always)]
fn drag<Q: Quad>(water: &PoreWater, mass: Q, volume: Q, pores: Q) -> Q {
    // V n² is the square of the pores over the volume.
    let mut drag = Q::splat(water.drag_scale()) * pores * pores / volume;
    if water.permeability != Permeability::Constant {
        // One over J.
        let denser = mass / (Q::splat(water.dry_density()) * volume);
        drag = drag * denser * denser;
    }
    if water.permeability == Permeability::KozenyCarman {
        let narrower = Q::splat(water.porosity) * volume / pores;
        drag = drag * narrower * narrower * narrower;
    }
    drag
}

/// Half of a node, and what is added to it.
trait Half {
    /// First lane.
    const LANE: usize;
    /// Factors that it goes with.
    type Factors: FactorKind;

    /// The line of a particle.
    fn line<Q: Quad>(lines: &Lines, p: usize) -> Q;
}

/// Mass and momentum.
struct Lower;

impl Half for Lower {
    const LANE: usize = 0;
    type Factors = Weights;

    #[inline(always)]
    fn line<Q: Quad>(lines: &Lines, p: usize) -> Q {
        Q::load(&lines.lower[p])
    }
}

/// Force and drag.
struct Upper;

impl Half for Upper {
    const LANE: usize = 4;
    type Factors = Derivatives;

    #[inline(always)]
    fn line<Q: Quad>(lines: &Lines, p: usize) -> Q {
        Q::load(&lines.upper[p])
    }
}

/// Momentum of the second mapping.
struct SecondMomentum;

impl Half for SecondMomentum {
    const LANE: usize = 4;
    type Factors = Weights;

    #[inline(always)]
    fn line<Q: Quad>(lines: &Lines, p: usize) -> Q {
        Q::load(&lines.lower[p])
    }
}

/// Rows of nodes that a run reaches.
struct StencilPart {
    /// Plane of the stencil, in space.
    plane: usize,
    /// Rows of the stencil.
    rows: Range<usize>,
    /// First node of the first of them.
    first: usize,
    /// Nodes from one row to the next.
    length: usize,
}

/// The nodes that the caller owns.
struct OwnedNodes<'a> {
    planes: Range<usize>,
    nodes: &'a mut [Line],
    mapping: &'a Mapping,
}

impl OwnedNodes<'_> {
    /// Adds a run of a block with a base node.
    #[inline(always)]
    fn add<Q: Quad, const D: usize, const N: usize, const REMAP: bool>(
        &mut self,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        [first_plane, row, along]: [usize; 3],
    ) {
        let own = first_plane.max(self.planes.start)..(first_plane + N).min(self.planes.end);
        if own.start >= own.end {
            return;
        }
        let length = self.mapping.nodes[2];
        if D == 2 {
            let below = StencilPart {
                plane: 0,
                rows: own.start - first_plane..own.end - first_plane,
                first: (own.start - self.planes.start) * length + along,
                length,
            };
            self.add_halves::<Q, D, N, REMAP>(factors, lines, run, below);
            return;
        }
        for plane in own {
            let row = (plane - self.planes.start) * self.mapping.nodes[1] + row;
            let below = StencilPart {
                plane: plane - first_plane,
                rows: 0..N,
                first: row * length + along,
                length,
            };
            self.add_halves::<Q, D, N, REMAP>(factors, lines, run, below);
        }
    }

    #[inline(always)]
    fn add_halves<Q: Quad, const D: usize, const N: usize, const REMAP: bool>(
        &mut self,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        mut below: StencilPart,
    ) {
        // As many rows at once as sums fit the registers.
        while !below.rows.is_empty() {
            let count = if N == 3 && below.rows.len() == 3 {
                self.add_both::<Q, D, N, 3, REMAP>(factors, lines, run, &below);
                3
            } else if N != 3 && below.rows.len() > 1 {
                self.add_both::<Q, D, N, 2, REMAP>(factors, lines, run, &below);
                2
            } else {
                self.add_both::<Q, D, N, 1, REMAP>(factors, lines, run, &below);
                1
            };
            below.rows.start += count;
            below.first += count * below.length;
        }
    }

    #[inline(always)]
    fn add_both<Q: Quad, const D: usize, const N: usize, const ROWS: usize, const REMAP: bool>(
        &mut self,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        below: &StencilPart,
    ) {
        if REMAP {
            self.add_rows::<SecondMomentum, Q, D, N, ROWS>(factors, lines, run, below);
        } else {
            self.add_rows::<Lower, Q, D, N, ROWS>(factors, lines, run, below);
            self.add_rows::<Upper, Q, D, N, ROWS>(factors, lines, run, below);
        }
    }

    #[inline(always)]
    fn add_rows<H: Half, Q: Quad, const D: usize, const N: usize, const ROWS: usize>(
        &mut self,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        below: &StencilPart,
    ) {
        let mut sums = [[Q::splat(0.0); N]; ROWS];
        for r in 0..ROWS {
            let row = &self.nodes[below.first + r * below.length..][..N];
            for k in 0..N {
                sums[r][k] = Q::load(&row[k][H::LANE..H::LANE + 4]);
            }
        }
        for p in run.clone() {
            let mut line = H::line::<Q>(lines, p);
            if D == 3 {
                line = H::Factors::of::<Q, N>(factors, 0, below.plane, p) * line;
            }
            let mut along = [line; N];
            for k in 0..N {
                along[k] = H::Factors::of::<Q, N>(factors, D - 1, k, p);
            }
            for r in 0..ROWS {
                let row = below.rows.start + r;
                let of_row = H::Factors::of::<Q, N>(factors, D - 2, row, p) * line;
                for k in 0..N {
                    sums[r][k] = along[k].mul_add(of_row, sums[r][k]);
                }
            }
        }
        for r in 0..ROWS {
            let row = &mut self.nodes[below.first + r * below.length..][..N];
            for k in 0..N {
                sums[r][k].store(&mut row[k][H::LANE..H::LANE + 4]);
            }
        }
    }
}
