//! Pore water of particles to the nodes of its field, lanes = numbers of a node.
//!
//! M_I = sum_p m_p S_Ip, P_I = sum_p m_p w_p S_Ip with the mass m = n `rho_w` V of the water; F_I = sum_p V_p p_p grad S_Ip to
//! the upper lanes, and in the last of them the drag along the first axis sum_p V_p D_p S_Ip with D = n² `rho_w` `g_k`/k.

use super::runs::Runs;
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes, Quad, SelectedLanes, load};
use crate::layout::Layout;
use crate::model::{Permeability, PoreWater};
use crate::stage::water::{Derivatives, FactorKind, Factors, MOST, Weights, WholeFactors};
use crate::stage::{Mapping, block_at};
use crate::weights::base_offset;
use std::ops::Range;

/// Quantities of the pore water that are carried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WaterCarry {
    /// Mass and momentum to the lower lanes, force of the pressure and drag to the upper ones.
    All {
        /// True where the pressure is a mean over cells.
        averaged: bool,
    },
    /// Momentum to the upper lanes (the second mapping of MUSL).
    Remap,
}

/// One call: the particles of some layers of a set onto some planes.
pub struct WaterP2g<'a> {
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
    pub fn run(self, lanes: SelectedLanes, axes: usize, stencil: usize) {
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
        // Means over cells go with some numbers of a half only.
        let whole = B::WHOLE_LINE && !REMAP && !averaged;
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
                    if whole {
                        factors.fill_whole::<B::Line, _, D>(columns, mapping, &block, at);
                    } else {
                        factors.fill::<B::Half, _, D>(columns, mapping, averaged, at, block.count);
                    }
                    lines.fill::<B::Half, D, REMAP>(columns, first, call.water, at, block.count);
                    let mut next = 0;
                    while next < block.count {
                        let run = runs.from(next);
                        next = run.end;
                        let base = runs.base::<D, false>(run.start);
                        if whole {
                            onto.add::<Whole, B::Line, D, N>(&factors, &lines, &run, base);
                        } else if REMAP {
                            onto.add::<SecondMomentum, B::Half, D, N>(&factors, &lines, &run, base);
                        } else {
                            onto.add::<Halves, B::Half, D, N>(&factors, &lines, &run, base);
                        }
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

/// Numbers that a block of particles gives to nodes, `[particle][number]`: the lower half goes with the weights, the upper one
/// with derivatives, but for the last number.
#[repr(align(64))]
struct Lines([[f64; 8]; MOST]);

impl Lines {
    #[inline(always)]
    fn new() -> Self {
        Self([[0.0; 8]; MOST])
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
            store_lines::<Q>(lower, 0, &mut self.0[done..done + 4]);
            if !REMAP {
                let drag = drag::<Q>(water, mass, volume, pores);
                let force = volume * load::<Q>(&columns[first + D], from, part);
                let along_z = if D == 3 { force } else { zero };
                let upper = [force, force, along_z, drag];
                store_lines::<Q>(upper, 4, &mut self.0[done..done + 4]);
            }
            done += 4;
        }
    }
}

/// Stores numbers, lanes = particles, as a half of the line of each particle that begins at a lane.
#[inline(always)]
fn store_lines<Q: Quad>(numbers: [Q; 4], lane: usize, lines: &mut [[f64; 8]]) {
    let turned = Q::transpose(numbers);
    for p in 0..4 {
        turned[p].store(&mut lines[p][lane..]);
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

/// Some lanes of a node, what is added to them, and its factors.
trait Part {
    /// First lane of the node.
    const NODE: usize;
    /// First number of the line of a particle.
    const LINE: usize;
    /// Factors that it goes with.
    type Factors: FactorKind;
}

/// Mass and momentum.
struct Lower;

impl Part for Lower {
    const NODE: usize = 0;
    const LINE: usize = 0;
    type Factors = Weights;
}

/// Force and drag.
struct Upper;

impl Part for Upper {
    const NODE: usize = 4;
    const LINE: usize = 4;
    type Factors = Derivatives;
}

/// Momentum of the second mapping.
struct SecondMomentum;

impl Part for SecondMomentum {
    const NODE: usize = 4;
    const LINE: usize = 0;
    type Factors = Weights;
}

/// All numbers at once, where a node is one register.
struct Whole;

impl Part for Whole {
    const NODE: usize = 0;
    const LINE: usize = 0;
    type Factors = WholeFactors;
}

/// Parts of a node, one after the other.
trait Parts {
    /// Adds a run to so many rows.
    fn add<L: Lanes, const D: usize, const N: usize, const ROWS: usize>(
        onto: &mut OwnedNodes<'_>,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        below: &StencilPart,
    );
}

impl<P: Part> Parts for P {
    #[inline(always)]
    fn add<L: Lanes, const D: usize, const N: usize, const ROWS: usize>(
        onto: &mut OwnedNodes<'_>,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        below: &StencilPart,
    ) {
        onto.add_rows::<P, L, D, N, ROWS>(factors, lines, run, below);
    }
}

/// [`Lower`] and [`Upper`].
struct Halves;

impl Parts for Halves {
    #[inline(always)]
    fn add<L: Lanes, const D: usize, const N: usize, const ROWS: usize>(
        onto: &mut OwnedNodes<'_>,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        below: &StencilPart,
    ) {
        onto.add_rows::<Lower, L, D, N, ROWS>(factors, lines, run, below);
        onto.add_rows::<Upper, L, D, N, ROWS>(factors, lines, run, below);
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
    fn add<P: Parts, L: Lanes, const D: usize, const N: usize>(
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
            self.add_parts::<P, L, D, N>(factors, lines, run, below);
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
            self.add_parts::<P, L, D, N>(factors, lines, run, below);
        }
    }

    #[inline(always)]
    fn add_parts<P: Parts, L: Lanes, const D: usize, const N: usize>(
        &mut self,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        mut below: StencilPart,
    ) {
        // As many rows at once as sums fit the registers.
        while !below.rows.is_empty() {
            let count = if N == 3 && below.rows.len() == 3 {
                P::add::<L, D, N, 3>(self, factors, lines, run, &below);
                3
            } else if N != 3 && below.rows.len() > 1 {
                P::add::<L, D, N, 2>(self, factors, lines, run, &below);
                2
            } else {
                P::add::<L, D, N, 1>(self, factors, lines, run, &below);
                1
            };
            below.rows.start += count;
            below.first += count * below.length;
        }
    }

    #[inline(always)]
    fn add_rows<P: Part, L: Lanes, const D: usize, const N: usize, const ROWS: usize>(
        &mut self,
        factors: &Factors<N>,
        lines: &Lines,
        run: &Range<usize>,
        below: &StencilPart,
    ) {
        let mut sums = [[L::splat(0.0); N]; ROWS];
        for r in 0..ROWS {
            let row = &self.nodes[below.first + r * below.length..][..N];
            for k in 0..N {
                sums[r][k] = L::load(&row[k][P::NODE..]);
            }
        }
        for p in run.clone() {
            let mut line = L::load(&lines.0[p][P::LINE..]);
            if D == 3 {
                line = P::Factors::of::<L, N>(factors, 0, below.plane, p) * line;
            }
            let mut along = [line; N];
            for k in 0..N {
                along[k] = P::Factors::of::<L, N>(factors, D - 1, k, p);
            }
            for r in 0..ROWS {
                let row = below.rows.start + r;
                let of_row = P::Factors::of::<L, N>(factors, D - 2, row, p) * line;
                for k in 0..N {
                    sums[r][k] = along[k].mul_add(of_row, sums[r][k]);
                }
            }
        }
        for r in 0..ROWS {
            let row = &mut self.nodes[below.first + r * below.length..][..N];
            for k in 0..N {
                sums[r][k].store(&mut row[k][P::NODE..]);
            }
        }
    }
}
