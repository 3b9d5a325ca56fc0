//! The broad phase: which pairs of bodies may share a node before the next sort.

use super::Pair;
use proctor_kernel::grid::{GHOSTS_BELOW, GridShape};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::StepView;
use proctor_kernel::weights::base_node;
use smallvec::SmallVec;

/// Nodes along an axis of the scene that the particles of a body can reach until the next sort, first and last.
///
/// A particle may cross one cell before the next sort, so they are widened by one cell each way. Nodes that mirror its
/// ghosts lie between them.
fn reach(set: &ParticleSet, shape: &GridShape, stencil: usize, axis: usize) -> (f64, f64) {
    let (low, high) = if axis == 0 {
        // The order of the particles knows their layers along the slow axis.
        let occupied = |layer: &usize| set.layers[*layer] < set.layers[*layer + 1];
        let layers = 0..set.layers.len() - 1;
        let first = layers.clone().find(occupied).unwrap_or(0);
        let last = layers.rev().find(occupied).unwrap_or(0);
        let base = |layer: usize| layer as f64 - GHOSTS_BELOW as f64;
        (base(first), base(last))
    } else {
        let x = &set.columns[Layout::POSITION + axis];
        let base = |x: f64| base_node(x * (1.0 / shape.cell[axis]), stencil);
        (
            base(x.iter().copied().fold(f64::INFINITY, f64::min)),
            base(x.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
        )
    };
    (low - 1.0, high + stencil as f64)
}

/// First and last node along each axis, where they were found.
type OfAxes = [Option<(f64, f64)>; 3];

/// Nodes along each axis that the particles of each body can reach until the next sort, found where they are first asked for.
/// Where ranks share the simulation, those of all ranks, found at once.
pub struct BodyReach<'a> {
    sets: &'a [ParticleSet],
    shape: &'a GridShape,
    stencil: usize,
    known: SmallVec<[OfAxes; 8]>,
}

impl<'a> BodyReach<'a> {
    /// The reach of the bodies of a process that nobody shares.
    #[must_use]
    pub fn of_sets(sets: &'a [ParticleSet], shape: &'a GridShape, stencil: usize) -> Self {
        Self {
            sets,
            shape,
            stencil,
            known: SmallVec::from_elem([None; 3], sets.len()),
        }
    }

    /// The reach of all bodies of a simulation. All ranks call this at the same time.
    #[must_use]
    pub fn new(view: &StepView<'a>) -> Self {
        let mut all = Self::of_sets(view.particles, &view.grid.shape, view.stencil);
        if let Some(ranks) = view.ranks {
            all.join(ranks);
        }
        all
    }

    /// Takes the reach on all ranks.
    fn join(&mut self, ranks: &dyn Ranks) {
        let (axes, sets) = (self.shape.axes, self.sets);
        let mut most = vec![];
        for set in sets {
            for axis in 0..axes {
                most.extend(if set.is_empty() {
                    [f64::NEG_INFINITY; 2]
                } else {
                    let (low, high) = reach(set, self.shape, self.stencil, axis);
                    [-low, high]
                });
            }
        }
        ranks.join_most(&mut most);
        let spans = most.as_chunks::<2>().0.chunks_exact(axes);
        for (known, spans) in self.known.iter_mut().zip(spans) {
            for (known, [low, high]) in known.iter_mut().zip(spans) {
                *known = Some((-low, *high));
            }
        }
    }

    /// First and last node along an axis of the scene that a body can reach.
    pub fn of(&mut self, body: usize, axis: usize) -> (f64, f64) {
        let found = || reach(&self.sets[body], self.shape, self.stencil, axis);
        *self.known[body][axis].get_or_insert_with(found)
    }

    /// Number of axes.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.shape.axes
    }
}

/// Finds which pairs are near: their boxes of nodes meet. One axis after the other, so that bodies far apart along the first
/// cost next to nothing.
pub fn near(pairs: &[Pair], reach: &mut BodyReach<'_>, near: &mut Vec<bool>) {
    let axes = reach.axes();
    let mut meet = |pair: &Pair, axis: usize| {
        let [a, b] = [pair.master, pair.slave].map(|body| reach.of(body, axis));
        a.0 <= b.1 && b.0 <= a.1
    };
    near.clear();
    near.extend(
        pairs
            .iter()
            .map(|pair| (0..axes).all(|axis| meet(pair, axis))),
    );
}
