//! Forecast of the shares of ranks, before a simulation is shared.

use super::cut::Cut;
use super::exchange::{self, DRIVEN};
use super::{Interaction, SharingRefusal};
use crate::model::StressScheme;
use crate::simulation::context::NodalConditions;
use crate::simulation::{Cycle, water};
use std::ops::Range;

/// The share that a rank would have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RankForecast {
    /// Its planes along the first axis, those of ghost nodes among them.
    pub planes: Range<usize>,
    /// Particles that it would own.
    pub particles: usize,
    /// Particles of its neighbours that it would compute once more.
    pub ghosts: usize,
    /// Bytes that it would send in a step between two sorts, to all neighbours, but for those of sums and maxima.
    pub sent: usize,
}

impl Cycle {
    /// The shares that so many ranks would have now.
    ///
    /// # Errors
    /// See [`Cycle::share_among`].
    pub fn forecast_ranks(&self, ranks: usize) -> Result<Vec<RankForecast>, SharingRefusal> {
        self.can_be_shared(ranks)?;
        let cut = Cut::new(&self.particles_of_layers(), ranks, self.state.stencil);
        let reach = self.state.stencil + 1;
        let particles = |layers: Range<usize>| -> usize {
            let sets = self.state.sets.iter();
            sets.map(|set| set.in_layers(layers.clone()).len()).sum()
        };
        let mut nodal = NodalConditions::default();
        if self.exchanges_driven() {
            self.prescribe(&mut nodal);
        }
        let lists = 1 + usize::from(self.has_separate_p2g());
        let sent = |planes: Range<usize>| {
            let driven = nodal.driven.iter();
            let driven = driven
                .filter(|one| planes.contains(&self.work.grid.shape.indices(one.node)[0]))
                .count();
            let lines = exchange::words(&self.work.grid, planes.clone());
            (lines * self.exchanges_per_step() + driven * DRIVEN * lists) * size_of::<u64>()
        };
        let of_rank = |rank: usize| {
            let planes = cut.planes(rank);
            let own = particles(planes.clone());
            let mut bytes = 0;
            if rank > 0 {
                bytes += sent(planes.start..planes.start + reach);
            }
            if rank + 1 < ranks {
                bytes += sent(planes.end - reach..planes.end);
            }
            RankForecast {
                particles: own,
                ghosts: particles(cut.held(rank)) - own,
                sent: bytes,
                planes,
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
