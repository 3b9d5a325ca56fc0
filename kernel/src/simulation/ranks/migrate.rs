//! Particles on their way to the ranks that hold them after a sort.

use super::cut::{Cut, ParticleCounts};
use super::packed::{PackedParticles, pack, take_up};
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::sorting::rows_now;

impl Cycle {
    /// Gives each rank the particles that it will hold after the sort that follows, its own and ghosts, in the order in which one
    /// process has them. Planes and rows are cut anew where shares have become uneven.
    pub(in crate::simulation) fn migrate(&mut self) {
        if self.work.share.is_none() {
            return;
        }
        let shape = &self.work.grid.shape;
        let reach = (self.model.family(), self.state.stencil);
        let own: Vec<Vec<usize>> = (self.state.sets.iter())
            .map(|set| self.own_particles(set).iter().collect())
            .collect();
        // Base row of each of them now.
        let rows: Vec<Vec<usize>> = (self.state.sets.iter().zip(&own))
            .map(|(set, own)| rows_now(set, own.iter().copied(), shape, reach))
            .collect();
        let per_layer = shape.bases()[1];
        let Some(share) = &mut self.work.share else {
            return;
        };
        let mut counts = vec![0; shape.nodes[0] + shape.nodes[1]];
        for row in rows.iter().flatten() {
            counts[row / per_layer] += 1;
            counts[shape.nodes[0] + row % per_layer] += 1;
        }
        let mut all = vec![0; counts.len()];
        for of_rank in share.ranks.all_gather(&counts) {
            for (sum, count) in all.iter_mut().zip(of_rank) {
                *sum += count;
            }
        }
        let counts = ParticleCounts {
            rows: all.split_off(shape.nodes[0]),
            planes: all,
        };
        let begins = share.particles == 0;
        share.particles = counts.planes.iter().sum::<u64>() as usize;
        let stale = begins || share.cut.waits() || share.cut.reach() != self.state.stencil;
        // A wider stencil needs no more room: there is enough for the widest.
        let best = Cut::new(&counts, share.ranks.count(), self.state.stencil);
        if let Some(best) = best.filter(|best| stale || share.cut.is_uneven(&counts, best)) {
            share.cut = best;
        }
        // Particles of each body that a rank will hold.
        let reaching = |body: usize, rank: usize| -> Vec<usize> {
            let held = share.cut.held(rank);
            let particles = own[body].iter().zip(&rows[body]);
            let reaching = particles
                .filter(|(_, row)| held.contains([**row / per_layer, **row % per_layer, 0]));
            reaching.map(|(p, _)| *p).collect()
        };
        let here = share.rank();
        let parts = (0..share.ranks.count()).map(|rank| {
            let mut words = vec![];
            if rank == here {
                return words;
            }
            for (body, set) in self.state.sets.iter().enumerate() {
                let reaching = reaching(body, rank);
                pack(set, &reaching, shape, &mut words);
                if let Some(watch) = &self.work.tension {
                    let growth = reaching.iter().map(|&p| watch.growth(body, set.id[p]));
                    words.extend(growth.map(f64::to_bits));
                }
            }
            words
        });
        let received = share.ranks.all_to_all(parts.collect());
        let stay: Vec<Vec<usize>> = (0..own.len()).map(|body| reaching(body, here)).collect();
        let mut received: Vec<Words<'_>> = received.iter().map(|words| Words::of(words)).collect();
        for (body, set) in self.state.sets.iter_mut().enumerate() {
            let mut parts = vec![];
            for (rank, words) in received.iter_mut().enumerate() {
                if rank == here {
                    parts.push(PackedParticles::that_stay(set, &stay[body], shape));
                    continue;
                }
                let part = PackedParticles::read(words, set.columns.len());
                if let Some(watch) = &mut self.work.tension {
                    for id in part.ids() {
                        watch.set_growth(body, *id, words.number());
                    }
                }
                parts.push(part);
            }
            take_up(set, &parts);
        }
        self.work.grid.set_owned(share.block());
    }
}
