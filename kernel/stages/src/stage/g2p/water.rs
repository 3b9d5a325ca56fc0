//! Nodes to the pore water of particles: its velocity and the pressure; lanes = particles.
//!
//! `w_p` = s `w_p` + sum_I S_Ip a_I, `p_p` = `p_p` - (`K_w`/n) dt sum_I grad S_Ip . u_I, with the kick a and the mean velocity u of
//! the nodes. A pressure that is held does not change, and what holds it does the work V p dt sum_I grad S_Ip . u_I that a
//! change would have taken from the water.

use super::reach::{Bases, BlockReach, MOST, Rows};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes, SelectedLanes, load, store};
use crate::layout::Layout;
use crate::model::{POROSITIES, PoreWater};
use crate::stage::{Block, Mapping, block_at, weights_of};
use crate::weights::cell_mean_weights;

/// A pass over the water of particles.
#[derive(Clone, Copy, Debug)]
pub struct WaterTask {
    /// Share of its velocity that a particle keeps, to which it adds what lies in the upper lanes of nodes; `None` leaves the
    /// velocity.
    pub kick: Option<f64>,
    /// Time over which the pressure changes \[s\], and the lane of a node where the velocities begin that change it.
    pub compress: Option<(f64, usize)>,
    /// True where the pressure is a mean over cells.
    pub averaged: bool,
}

/// One call: some particles of a set.
pub struct WaterG2p<'a, 'b> {
    /// Columns of these particles.
    pub columns: &'a mut [&'b mut [f64]],
    /// Layout of the columns.
    pub layout: &'a Layout,
    /// View of the grid by the set.
    pub mapping: &'a Mapping,
    /// The water in the pores.
    pub water: &'a PoreWater,
    /// All nodes of the water.
    pub nodes: &'a [Line],
    /// The pass.
    pub task: WaterTask,
}

impl WaterG2p<'_, '_> {
    /// Gathers from so many nodes per axis; whether all particles whose pressure changes have a porosity of [`POROSITIES`].
    #[must_use]
    pub fn run(self, lanes: SelectedLanes, axes: usize, stencil: usize) -> bool {
        match (axes, stencil) {
            (2, 4) => lanes.run(Instance::<'_, '_, 2, 4>(self)),
            (2, _) => lanes.run(Instance::<'_, '_, 2, 3>(self)),
            (_, 4) => lanes.run(Instance::<'_, '_, 3, 4>(self)),
            (_, _) => lanes.run(Instance::<'_, '_, 3, 3>(self)),
        }
    }
}

/// One dimension and stencil as a kernel.
struct Instance<'a, 'b, const D: usize, const N: usize>(WaterG2p<'a, 'b>);

impl<const D: usize, const N: usize> Kernel for Instance<'_, '_, D, N> {
    type Output = bool;

    #[inline(always)]
    fn run<B: Backend>(self) -> bool {
        let mut call = self.0;
        let Some(first) = call.layout.water else {
            return true;
        };
        let end = call.columns[0].len();
        let (mut at, mut sound) = (0, true);
        while at < end {
            let block = block_at::<B::Native, _, D, N>(call.columns, call.mapping, at, end);
            let bases = Bases::ahead::<_, D, N>(&block, call.columns, call.mapping, at, end);
            let (nodes, count) = (call.nodes, bases.count);
            macro_rules! gather {
                ($bases:tt) => {
                    gather::<B::Native, D, N, $bases>(
                        &mut call,
                        first,
                        &bases.reach(nodes),
                        &block,
                        at,
                        count,
                    )
                };
            }
            // As for the skeleton, an instance for each number of base nodes.
            sound &= match bases.number {
                n if n < 2 || B::Native::WIDTH == 1 => gather!(1),
                2 => gather!(2),
                _ => gather!(MOST),
            };
            at += count;
        }
        sound
    }
}

/// Gathers to `count` particles from `at`, whose columns of the water begin at `first`.
#[inline(always)]
fn gather<L: Lanes, const D: usize, const N: usize, const R: usize>(
    call: &mut WaterG2p<'_, '_>,
    first: usize,
    reach: &BlockReach<'_, L, R>,
    block: &Block<L>,
    at: usize,
    count: usize,
) -> bool {
    let mapping = call.mapping;
    let (w, g) = weights_of::<L, _, D, N, false, false>(call.columns, mapping, block, at);
    let mut rows = [[reach.rows(0); N]; N];
    let plane = mapping.nodes[1] * mapping.nodes[2];
    for i in 0..N {
        for j in 0..if D == 3 { N } else { 1 } {
            rows[i][j] = reach.rows(i * plane + j * mapping.nodes[2]);
        }
    }
    let mut across = w;
    if call.task.averaged {
        for axis in 0..D {
            across[axis] = cell_mean_weights::<L, N>(&g[axis]);
        }
    }
    let mut divergence = L::splat(0.0);
    // One component after the other: its sums fit the registers.
    for c in 0..D {
        if let Some(share) = call.task.kick {
            let kick = sum::<L, D, N, R>(reach, &rows, &w, 4 + c);
            let column = &mut *call.columns[first + c];
            let velocity = L::splat(share).mul_add(load::<L>(column, at, count), kick);
            store(velocity, column, at, count);
        }
        if let Some((_, lane)) = call.task.compress {
            let mut factors = across;
            factors[c] = g[c];
            let along = sum::<L, D, N, R>(reach, &rows, &factors, lane + c);
            divergence = L::splat(mapping.inverse_cell[c]).mul_add(along, divergence);
        }
    }
    let Some((dt, _)) = call.task.compress else {
        return true;
    };
    let water = call.water;
    let mass = load::<L>(call.columns[Layout::MASS], at, count);
    let volume = load::<L>(call.columns[Layout::VOLUME], at, count);
    let porosity = L::splat(1.0) - mass / (L::splat(water.grain_density) * volume);
    let mut change = L::splat(water.bulk * dt) / porosity * divergence;
    let before = load::<L>(call.columns[first + D], at, count);
    if let Some(held) = call.layout.held_pressure {
        let share = load::<L>(call.columns[held], at, count);
        change = share * change;
        let work = volume * before * (L::splat(dt) * divergence);
        let column = &mut *call.columns[held + 1];
        let sum = (L::splat(1.0) - share).mul_add(work, load::<L>(column, at, count));
        store(sum, column, at, count);
    }
    store(before - change, call.columns[first + D], at, count);
    // One by one: what `map` calls is not always inlined, and then compiled without the lanes.
    let [low, high] = [L::splat(POROSITIES[0]), L::splat(POROSITIES[1])];
    let sound = L::bits(low.lt(porosity)) & L::bits(porosity.lt(high));
    !sound & L::bits(L::first(count)) == 0
}

/// Sum over the stencil of a number of its nodes times factors along the axes.
#[inline(always)]
fn sum<L: Lanes, const D: usize, const N: usize, const R: usize>(
    reach: &BlockReach<'_, L, R>,
    rows: &[[Rows<'_, N, R>; N]; N],
    factors: &[[L; N]; 3],
    number: usize,
) -> L {
    let mut planes = [L::splat(0.0); N];
    for i in 0..N {
        if D == 2 {
            planes[i] = along::<L, N, R>(reach, &rows[i][0], &factors[1], number);
            continue;
        }
        let mut of_rows = [L::splat(0.0); N];
        for j in 0..N {
            of_rows[j] = along::<L, N, R>(reach, &rows[i][j], &factors[2], number);
        }
        planes[i] = weighted(&of_rows, &factors[1]);
    }
    weighted(&planes, &factors[0])
}

/// The same along a row.
#[inline(always)]
fn along<L: Lanes, const N: usize, const R: usize>(
    reach: &BlockReach<'_, L, R>,
    row: &Rows<'_, N, R>,
    factors: &[L; N],
    number: usize,
) -> L {
    let mut values = [L::splat(0.0); N];
    for k in 0..N {
        values[k] = reach.value(row, k, number);
    }
    weighted(&values, factors)
}

/// Sum of values times their factors.
#[inline(always)]
fn weighted<L: Lanes, const N: usize>(values: &[L; N], factors: &[L; N]) -> L {
    let mut sum = factors[0] * values[0];
    for n in 1..N {
        sum = factors[n].mul_add(values[n], sum);
    }
    sum
}
