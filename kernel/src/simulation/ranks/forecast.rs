//! Forecast of the shares of ranks, before a simulation is shared.

use super::exchange::{self, DRIVEN};
use super::{Interaction, SharingRefusal};
use crate::grid::NodeBlock;
use crate::model::StressScheme;
use crate::simulation::context::NodalConditions;
use crate::simulation::{Cycle, water};
use crate::sorting::rows_now;
use std::ops::Range;

/// The share that a rank would have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RankForecast {
    /// Its planes along the first axis, those of ghost nodes among them.
    pub planes: Range<usize>,
    /// Its rows along the second axis in each of them, likewise; all of them, where planes alone are cut.
    pub rows: Range<usize>,
    /// Particles that it would own.
    pub particles: usize,
    /// Particles of its neighbours that it would compute once more.
    pub ghosts: usize,
    /// Bytes that it would send in a step between two sorts, to all neighbours, but for those that all ranks join.
    pub sent: usize,
}

impl Cycle {
    /// The shares that so many ranks would have now.
    ///
    /// # Errors
    /// See [`Cycle::share_among`].
    pub fn forecast_ranks(&self, ranks: usize) -> Result<Vec<RankForecast>, SharingRefusal> {
        let cut = self.cut_by(&self.particle_counts(), ranks)?;
        let reach = self.state.stencil + 1;
        let shape = &self.work.grid.shape;
        let per_layer = shape.bases()[1];
        // Base rows of all particles, where they are now.
        let by = (self.model.family(), self.state.stencil);
        let sets = self.state.sets.iter();
        let rows = sets.flat_map(|set| rows_now(set, 0..set.len(), shape, by));
        let rows: Vec<usize> = rows.collect();
        let particles = |block: &NodeBlock| -> usize {
            let held = rows
                .iter()
                .filter(|row| block.contains([*row / per_layer, *row % per_layer, 0]));
            held.count()
        };
        let mut nodal = NodalConditions::default();
        if self.exchanges_driven() {
            self.prescribe(&mut nodal);
        }
        let lists = 1 + usize::from(self.has_separate_p2g());
        let sent = |block: &NodeBlock| {
            let driven = nodal.driven.iter();
            let driven = driven
                .filter(|one| block.contains(shape.indices(one.node)))
                .count();
            let lines = exchange::words(&self.work.grid, block);
            (lines * self.exchanges_per_step() + driven * DRIVEN * lists) * size_of::<u64>()
        };
        let of_rank = |rank: usize| {
            let own = particles(&cut.block(rank));
            let blocks = cut.messages(rank, reach).flat_map(|(_, to)| to);
            let NodeBlock { planes, rows } = cut.block(rank);
            RankForecast {
                particles: own,
                ghosts: particles(&cut.held(rank)) - own,
                sent: blocks.flatten().map(|block| sent(&block)).sum(),
                planes,
                rows,
            }
        };
        Ok((0..ranks).map(of_rank).collect())
    }

    /// Exchanges of planes in a step.
    fn exchanges_per_step(&self) -> usize {
        let mappings = 1 + usize::from(self.model.plan.scheme != StressScheme::Usl);
        let settles = self.interactions().any(Interaction::settles_across_ranks);
        let of_water = if self.work.grid.has_water {
            water::exchanges_per_step(&self.model.settings)
        } else {
            0
        };
        mappings * (1 + usize::from(settles)) + usize::from(self.has_separate_p2g()) + of_water
    }
}
