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
        let best = Cut::new(&all, share.ranks.count(), stencil);
        if begins || share.cut.is_uneven(&all, &best) || share.cut.reach() != stencil {
            share.cut = best;
        }
        // Particles of each body that a rank will hold.
        let reaching = |body: usize, rank: usize| -> Vec<usize> {
            let held = share.cut.held(rank);
            let particles = ranges[body].clone().zip(&layers[body]);
            let reaching = particles.filter(|(_, layer)| held.contains(layer));
            reaching.map(|(p, _)| p).collect()
        };
        let here = share.rank();
        let parts = (0..share.ranks.count()).map(|rank| {
            let mut words = vec![];
            if rank == here {
                return words;
            }
            for (body, set) in self.state.sets.iter().enumerate() {
                let reaching = reaching(body, rank);
                pack(set, &reaching, &mut words);
                if let Some(watch) = &self.work.tension {
                    let growth = reaching.iter().map(|&p| watch.growth(body, set.id[p]));
                    words.extend(growth.map(f64::to_bits));
                }
            }
            words
        });
        let received = share.ranks.all_to_all(parts.collect());
        let stay: Vec<Vec<usize>> = (0..ranges.len()).map(|body| reaching(body, here)).collect();
        let mut received: Vec<Words<'_>> = received.iter().map(|words| Words::of(words)).collect();
        let (below, above) = received.split_at_mut(here);
        for (body, set) in self.state.sets.iter_mut().enumerate() {
            let [below, above] = [&mut *below, &mut above[1..]].map(|ranks| {
                let mut parts = vec![];
                for words in ranks {
                    let part = PackedParticles::read(words, set.columns.len());
                    if let Some(watch) = &mut self.work.tension {
                        for id in part.ids {
                            watch.set_growth(body, *id, words.number());
                        }
                    }
                    parts.push(part);
                }
                parts
            });
            take_up(set, &below, &stay[body], &above);
        }
        self.work.grid.owned = share.planes();
    }
}

/// Particles that another rank has packed.
struct PackedParticles<'a> {
    ids: &'a [u64],
    columns: Vec<&'a [u64]>,
}

impl<'a> PackedParticles<'a> {
    fn read(words: &mut Words<'a>, columns: usize) -> Self {
        let count = words.count();
        Self {
            ids: words.take(count),
            columns: (0..columns).map(|_| words.take(count)).collect(),
        }
    }
}

/// Puts particles of the ranks before and behind around those that stay, a column at a time: no column is there twice but one.
fn take_up(
    set: &mut ParticleSet,
    below: &[PackedParticles<'_>],
    stay: &[usize],
    above: &[PackedParticles<'_>],
) {
    let others = below.iter().chain(above).map(|part| part.ids.len());
    let count = stay.len() + others.sum::<usize>();
    let mut id = Vec::with_capacity(count);
    let ids = |parts: &[PackedParticles<'_>]| -> Vec<u64> {
        parts.iter().flat_map(|part| part.ids).copied().collect()
    };
    id.extend(ids(below));
    id.extend(stay.iter().map(|&p| set.id[p]));
    id.extend(ids(above));
    set.id = id;
    for (number, column) in set.columns.iter_mut().enumerate() {
        let packed = |part: &PackedParticles<'_>| {
            let words = part.columns[number].to_vec();
            words.into_iter().map(f64::from_bits)
        };
        let mut all = Vec::with_capacity(count);
        all.extend(below.iter().flat_map(packed));
        all.extend(stay.iter().map(|&p| column[p]));
        all.extend(above.iter().flat_map(packed));
        *column = all;
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
