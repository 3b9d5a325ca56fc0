//! The state of a shared simulation, by the part that each rank has of it.

use super::cut::{Cut, ParticleCounts};
use super::packed::{pack, take_up_received};
use crate::particles::ParticleSet;
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::simulation::values::SavedState;
use std::ops::Range;

/// Particles of a body on this rank and on others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PartOfSet {
    /// Particles on the ranks before.
    pub before: usize,
    /// Particles on all ranks.
    pub all: usize,
}

impl Cycle {
    /// The state with the particles that this process owns, and what part of each set they are: put one after the other in
    /// order of the ranks, they are the particles of one process, and each set has the layers of the whole. Ranks that share the
    /// simulation call this at the same time.
    #[must_use]
    pub fn save_part(&self) -> (SavedState, Vec<PartOfSet>) {
        let mut saved = self.save();
        let sets = &mut saved.state.sets;
        let Some(share) = &self.work.share else {
            let whole = |set: &ParticleSet| PartOfSet {
                before: 0,
                all: set.len(),
            };
            let parts = sets.iter().map(whole).collect();
            return (saved, parts);
        };
        // Layers whole, on the first of the ranks that have their rows.
        let shape = &self.work.grid.shape;
        let beside = share.cut.beside(share.rank());
        let is_first = beside.start == share.rank();
        let mut to = vec![vec![]; share.ranks().count()];
        for set in &self.state.sets {
            let own: Vec<usize> = self.own_particles(set).iter().collect();
            pack(set, &own, shape, &mut to[beside.start]);
        }
        let received = share.ranks().all_to_all(to);
        let received = received[beside].iter().map(|words| Words::of(words));
        let mut received: Vec<Words<'_>> = if is_first { received.collect() } else { vec![] };
        let planes = if is_first { share.block().planes } else { 0..0 };
        let mut words = vec![];
        for set in &mut *sets {
            *set = set.without_particles();
            take_up_received(set, &mut received, false, shape);
            let layers = planes.start..planes.end.min(set.layers.len() - 1);
            words.extend([set.len(), layers.len()].map(|count| count as u64));
            words.extend(set.layers[layers].iter().map(|start| *start as u64));
        }
        let all = share.ranks().all_gather(&words);
        let mut all: Vec<Words<'_>> = all.iter().map(|words| Words::of(words)).collect();
        let mut parts = vec![];
        for set in sets {
            let mut part = PartOfSet::default();
            set.layers.clear();
            for (rank, words) in all.iter_mut().enumerate() {
                let [count, layers] = [(); 2].map(|()| words.count());
                let starts = words.take(layers).iter();
                set.layers
                    .extend(starts.map(|start| part.all + *start as usize));
                if rank < share.rank() {
                    part.before += count;
                }
                part.all += count;
            }
            set.layers.push(part.all);
            parts.push(part);
        }
        (saved, parts)
    }

    /// Cuts the nodes of a shared simulation anew, for a state with so many particles in each layer that is to be restored;
    /// the layers that this rank will hold, of which [`Cycle::restore`] takes the particles. `None` where no ranks share it.
    pub fn cut_for_restore(&mut self, layers: &[u64], stencil: usize) -> Option<Range<usize>> {
        let share = self.work.share.as_mut()?;
        let mut counts = ParticleCounts::even(&self.work.grid.shape);
        counts.planes.fill(0);
        for (plane, count) in counts.planes.iter_mut().zip(layers) {
            *plane = *count;
        }
        // The file has layers alone, and rows wait for the first sort.
        if let Some(cut) = Cut::new(&counts, share.ranks.count(), stencil) {
            share.cut = cut.waiting();
        }
        share.particles = layers.iter().sum::<u64>() as usize;
        self.work.grid.set_owned(share.block());
        let held = share.cut.held(share.rank());
        let first = held.planes.start;
        Some(if held.rows.is_empty() {
            first..first
        } else {
            held.planes
        })
    }
}
