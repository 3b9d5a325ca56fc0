//! A simulation that ranks share: who owns which planes and particles, and what a step joins.
//!
//! A rank owns the node planes `a..b` along the first axis and the particles of the layers `a..b`; the layer of a particle is the
//! plane of its base node at the last sort. With a stencil of S nodes the particles of the layers `a - S..b + 1` reach these
//! planes before the next sort, and so a rank holds all of them, those that it does not own as ghosts. P2G then sums at each
//! node the same particles in the same order as one process does. The particles that a rank holds read nodes of S + 1 planes on
//! either side, which come from the two neighbours in one message after the equation of motion. Sums over nodes and over
//! particles are exact, and all else that ranks join is a maximum or a count.
//!
//! Where planes end, in space, rows of nodes along the second axis are cut by the same rule: a rank owns rows of its planes. It
//! works on these alone; what its particles give other rows of its planes is the part of a sum, which the message of the
//! neighbour along the rows replaces. The message along the planes follows, with the rows that came, and so brings what lies
//! across an edge. Rows along the third axis are never cut.

mod at_nodes;
mod by_identifier;
mod cut;
mod exchange;
mod forecast;
mod join;
mod migrate;
mod packed;
mod saved;
mod sums;
mod whole;

pub use forecast::RankForecast;
pub(super) use join::Removed;
pub use saved::PartOfSet;
pub use whole::OwnPart;

use super::Cycle;
use super::interactions::Interaction;
use crate::grid::NodeBlock;
use crate::ranks::Ranks;
use crate::simulation::values::{SharingRefusal, StepError, StepInfo};
use crate::sorting::rows_now;
use crate::stage::g2p::ParticleMaxima;
use cut::{Cut, ParticleCounts};
use std::sync::Arc;

/// The part that a rank has in a shared simulation.
pub(crate) struct Share {
    /// The ranks.
    ranks: Arc<dyn Ranks>,
    /// Planes and rows of all ranks.
    cut: Cut,
    /// Particles of all ranks.
    particles: usize,
    /// Largest longitudinal viscosity over density of a particle of any rank \[m²/s\].
    diffusivity: f64,
}

impl Share {
    /// Number of particles of all ranks.
    pub(super) fn particles(&self) -> usize {
        self.particles
    }

    /// The ranks.
    pub(super) fn ranks(&self) -> &dyn Ranks {
        &*self.ranks
    }

    /// Number of this rank.
    fn rank(&self) -> usize {
        self.ranks.rank()
    }

    /// Planes and rows of this rank.
    fn block(&self) -> NodeBlock {
        self.cut.block(self.rank())
    }
}

impl Cycle {
    /// Shares the simulation among ranks: this process keeps its part. All ranks have set up the same simulation, or restored
    /// the same state, and call this in the same step. State, events and sums then are those of one process, bit by bit.
    ///
    /// # Errors
    /// A scene with a part that is not local, or more ranks than its planes and rows allow. The simulation is then as it was.
    pub fn share_among(&mut self, ranks: Arc<dyn Ranks>) -> Result<(), SharingRefusal> {
        let share = self.cut_among(ranks)?;
        self.keep_part(share);
        Ok(())
    }

    /// Begins a simulation whose particles ranks share from the start: the maxima of all, and blocks that the first sort will cut
    /// by the particles in them.
    pub(super) fn begin_shared(&mut self, ranks: Arc<dyn Ranks>) -> Result<(), SharingRefusal> {
        let even = ParticleCounts::even(&self.work.grid.shape);
        let cut = self.cut_by(&even, ranks.count())?;
        self.work.share = Some(Share {
            cut,
            particles: 0,
            diffusivity: 0.0,
            ranks,
        });
        self.join_start();
        Ok(())
    }

    /// Finds the largest viscosity over density of all ranks anew, after a restart.
    pub(super) fn join_diffusivity(&mut self) {
        let mut most = [self.own_diffusivity()];
        self.join_most(&mut most);
        if let Some(share) = &mut self.work.share {
            share.diffusivity = most[0];
        }
    }

    /// Joins what the start depends on, while each rank has its own particles alone.
    fn join_start(&mut self) {
        let mut numbers = vec![self.own_diffusivity(), self.work.load_acceleration];
        numbers.extend(self.state.found.iter().flat_map(ParticleMaxima::numbers));
        self.join_most(&mut numbers);
        self.work.load_acceleration = numbers[1];
        let all = numbers[2..].as_chunks().0;
        for (found, numbers) in self.state.found.iter_mut().zip(all) {
            found.set_numbers(*numbers);
        }
        self.state.set_stencil();
        let Some(share) = &mut self.work.share else {
            return;
        };
        share.diffusivity = numbers[0];
        let own = share.block();
        let [layers, rows, _] = self.work.grid.shape.bases();
        for set in &mut self.state.sets {
            // All of them lie in the first of the own rows until they are sorted.
            let count = set.len();
            let start = |first: usize| move |place: usize| if place <= first { 0 } else { count };
            set.layers = (0..=layers).map(start(own.planes.start)).collect();
            if share.cut.cuts_rows() {
                let first = own.planes.start * rows + own.rows.start;
                set.rows = (0..=layers * rows).map(start(first)).collect();
            }
        }
        self.work.grid.set_owned(own);
    }

    /// Shares each step among ranks: between two steps every one of them has the whole simulation, as one process has it. That
    /// costs messages of the size of the state, and is for programs that look at the simulation after each step, all ranks
    /// alike.
    ///
    /// # Errors
    /// As [`Cycle::share_among`].
    pub fn share_steps_among(&mut self, ranks: Arc<dyn Ranks>) -> Result<(), SharingRefusal> {
        self.work.between_steps = Some(self.cut_among(ranks)?);
        Ok(())
    }

    /// A step of this rank, on its part of the simulation, from the whole to the whole where ranks share each step.
    pub(super) fn step_of_rank(
        &mut self,
        step: impl FnOnce(&mut Self) -> Result<StepInfo, StepError>,
    ) -> Result<StepInfo, StepError> {
        let Some(mut share) = self.work.between_steps.take() else {
            return step(self);
        };
        share.particles = self.particles();
        share.diffusivity = self.own_diffusivity();
        if !self.knows_rows() {
            share.cut = share.cut.waiting();
        }
        self.keep_part(share);
        let result = step(self);
        self.work.between_steps = self.gather_everywhere();
        result
    }

    /// Cuts the nodes for ranks.
    fn cut_among(&self, ranks: Arc<dyn Ranks>) -> Result<Share, SharingRefusal> {
        let cut = self.cut_by(&self.particle_counts(), ranks.count())?;
        Ok(Share {
            cut: if self.knows_rows() {
                cut
            } else {
                cut.waiting()
            },
            particles: self.particles(),
            diffusivity: self.own_diffusivity(),
            ranks,
        })
    }

    /// True if all particles have the rows of the last sort: those of another process do not.
    fn knows_rows(&self) -> bool {
        self.state.sets.iter().all(|set| !set.rows.is_empty())
    }

    /// Keeps the part of this rank of the whole simulation.
    fn keep_part(&mut self, share: Share) {
        let held = share.cut.held(share.rank());
        for set in &mut self.state.sets {
            let kept = set.in_block(&held, &self.work.grid.shape);
            set.keep(&kept);
        }
        self.work.grid.own(share.block(), &self.state.sets);
        self.work.share = Some(share);
        self.work.forces_of_ranks = None;
        // What an interaction knows of particles by their places.
        self.each(Interaction::fields_given);
    }

    /// Particles of each layer as of the last sort, and of each row as they are now.
    fn particle_counts(&self) -> ParticleCounts {
        let shape = &self.work.grid.shape;
        let of_layer = |layer: usize| -> u64 {
            let sets = self.state.sets.iter();
            sets.map(|set| set.in_layers(layer..layer + 1).len() as u64)
                .sum()
        };
        let mut rows = vec![0; shape.nodes[1]];
        for set in &self.state.sets {
            for place in rows_now(
                set,
                0..set.len(),
                shape,
                (self.model.family(), self.state.stencil),
            ) {
                rows[place % shape.bases()[1]] += 1;
            }
        }
        ParticleCounts {
            planes: (0..shape.nodes[0]).map(of_layer).collect(),
            rows,
        }
    }

    /// Cuts the nodes for so many ranks, or refuses it.
    fn cut_by(&self, counts: &ParticleCounts, ranks: usize) -> Result<Cut, SharingRefusal> {
        if let Some(part) = self.not_local() {
            return Err(SharingRefusal::Part { part });
        }
        Cut::new(counts, ranks, self.state.stencil).ok_or_else(|| SharingRefusal::TooMany {
            ranks,
            most: Cut::most(ranks, &self.work.grid.shape),
        })
    }

    /// The rank of this process and the number of ranks, where they share the simulation.
    #[must_use]
    pub fn rank(&self) -> Option<(usize, usize)> {
        let share = self.work.share.as_ref()?;
        Some((share.rank(), share.ranks.count()))
    }

    /// The first part of the scene that more than its surroundings act on.
    fn not_local(&self) -> Option<&'static str> {
        let conditions = self.model.own_conditions.iter();
        let interactions = self.interactions();
        interactions
            .filter_map(Interaction::not_local)
            .chain(conditions.filter_map(|one| one.not_local()))
            .next()
    }
}
