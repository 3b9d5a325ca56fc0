//! Particles on their way to the ranks that hold them after a sort.

use super::cut::Cut;
use crate::particles::ParticleSet;
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::sorting::layers_now;
use std::ops::Range;

impl Cycle {
    /// Gives each rank the particles that it will hold after the sort that follows, its own and ghosts, in the order in which one
    /// process has them. Planes are cut anew where shares have become uneven.
    pub(in crate::simulation) fn migrate(&mut self) {
        let Some(share) = &mut self.work.share else {
            return;
        };
        let (own, stencil) = (share.planes(), self.state.stencil);
        let shape = &self.work.grid.shape;
        let family = self.model.plan.family;
        let ranges: Vec<Range<usize>> = (self.state.sets.iter())
            .map(|set| set.in_layers(own.clone()))
            .collect();
        let layers: Vec<Vec<usize>> = (self.state.sets.iter())
            .zip(&ranges)
            .map(|(set, range)| layers_now(set, range.clone(), shape, (family, stencil)))
            .collect();
        let mut counts = vec![0; shape.nodes[0]];
        for layer in layers.iter().flatten() {
            counts[*layer] += 1;
        }
        let mut all = vec![0; counts.len()];
        for of_rank in share.ranks.all_gather(&counts) {
            for (sum, count) in all.iter_mut().zip(of_rank) {
                *sum += count;
            }
        }
        let begins = share.particles == 0;
        share.particles = all.iter().sum::<u64>() as usize;
        if begins || share.cut.is_uneven(&all) {
            share.cut = Cut::new(&all, share.ranks.count());
        }
        let parts = (0..share.ranks.count()).map(|rank| {
            let held = share.cut.held(rank, stencil);
            let mut words = vec![];
            for (body, set) in self.state.sets.iter().enumerate() {
                let particles = ranges[body].clone().zip(&layers[body]);
                let reaching = particles.filter(|(_, layer)| held.contains(layer));
                let reaching: Vec<usize> = reaching.map(|(p, _)| p).collect();
                pack(set, &reaching, &mut words);
                if let Some(watch) = &self.work.tension {
                    let growth = reaching.iter().map(|&p| watch.growth(body, set.id[p]));
                    words.extend(growth.map(f64::to_bits));
                }
            }
            words
        });
        let received = share.ranks.all_to_all(parts.collect());
        let mut received: Vec<Words<'_>> = received.iter().map(|words| Words::of(words)).collect();
        for (body, set) in self.state.sets.iter_mut().enumerate() {
            set.id.clear();
            set.columns.iter_mut().for_each(Vec::clear);
            for words in &mut received {
                let before = set.len();
                unpack(set, words);
                if let Some(watch) = &mut self.work.tension {
                    for id in &set.id[before..] {
                        watch.set_growth(body, *id, words.number());
                    }
                }
            }
        }
        self.work.grid.owned = share.planes();
    }
}

/// Some particles of a set: their number, their identifiers, then column by column.
pub(super) fn pack(set: &ParticleSet, particles: &[usize], words: &mut Vec<u64>) {
    words.reserve(1 + particles.len() * (1 + set.columns.len()));
    words.push(particles.len() as u64);
    words.extend(particles.iter().map(|&p| set.id[p]));
    for column in &set.columns {
        words.extend(particles.iter().map(|&p| column[p].to_bits()));
    }
}

/// Appends packed particles to a set.
pub(super) fn unpack(set: &mut ParticleSet, words: &mut Words<'_>) {
    let count = words.count();
    set.id.extend_from_slice(words.take(count));
    for column in &mut set.columns {
        column.extend(words.take(count).iter().map(|&word| f64::from_bits(word)));
    }
}
