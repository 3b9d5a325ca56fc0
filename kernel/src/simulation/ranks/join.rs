//! Values of a step that all ranks join: sums, maxima, counts, and faults of particles.

use crate::exact_sum::ExactSum;
use crate::grid::NodeBlock;
use crate::particles::{OwnParticles, ParticleSet};
use crate::ranks::{Ranks, Words};
use crate::simulation::Cycle;
use crate::simulation::tension::LargestStretch;
use crate::simulation::values::{ParticleAt, StepError, StepErrorKind};
use crate::stage::g2p::{FaultKind, ParticleMaxima};
use std::hash::Hasher;

/// Steps from one comparison of ghosts with their owners to the next.
const STEPS_PER_COMPARISON: u64 = 256;

/// A particle that left the mesh, with the energy and the dead load that go with it.
pub(in crate::simulation) struct Removed {
    /// Number of its base row at the last sort.
    pub(in crate::simulation) base_row: u64,
    pub(in crate::simulation) at: ParticleAt,
    /// Kinetic, stored and dissipated energy \[J\].
    pub(in crate::simulation) energy: f64,
    /// Dead load times position \[J\].
    pub(in crate::simulation) load: f64,
}

impl Cycle {
    /// Particles of a set that this process owns; all, where no ranks share them.
    #[must_use]
    pub fn own_particles(&self, set: &ParticleSet) -> OwnParticles {
        match &self.work.share {
            None => OwnParticles::all(set.len()),
            Some(_) => set.in_block(&self.work.grid.block(), &self.work.grid.shape),
        }
    }

    /// True for a node that this process owns.
    pub(in crate::simulation) fn owns(&self, node: usize) -> bool {
        let at = self.work.grid.shape.indices(node);
        self.work.grid.block().contains(at)
    }

    /// Takes removed particles out of the number of all.
    pub(in crate::simulation) fn count_removed(&mut self, removed: usize) {
        if let Some(share) = &mut self.work.share {
            share.particles -= removed;
        }
    }

    /// The ranks that share the simulation.
    #[must_use]
    pub fn ranks(&self) -> Option<&dyn Ranks> {
        self.work.share.as_ref().map(|share| &*share.ranks)
    }

    /// The sums of all ranks.
    pub(in crate::simulation) fn join_sums(&self, sums: &mut [ExactSum]) {
        let Some(ranks) = self.ranks() else { return };
        let words: Vec<u64> = sums.iter().flat_map(ExactSum::words).collect();
        sums.fill(ExactSum::ZERO);
        for of_rank in ranks.all_gather(&words) {
            let (all, _) = of_rank.as_chunks::<{ ExactSum::WORDS }>();
            for (sum, words) in sums.iter_mut().zip(all) {
                sum.merge(&ExactSum::from_words(words));
            }
        }
    }

    /// The largest of each number over all ranks.
    pub(in crate::simulation) fn join_most(&self, numbers: &mut [f64]) {
        if let Some(ranks) = self.ranks() {
            ranks.join_most(numbers);
        }
    }

    /// True if something holds on any rank.
    pub(in crate::simulation) fn holds_anywhere(&self, here: bool) -> bool {
        let Some(ranks) = self.ranks() else {
            return here;
        };
        let all = ranks.all_gather(&[u64::from(here)]);
        all.iter().flatten().any(|word| *word != 0)
    }

    /// Sum of a count over all ranks.
    pub(in crate::simulation) fn join_count(&self, here: usize) -> usize {
        let Some(ranks) = self.ranks() else {
            return here;
        };
        let all = ranks.all_gather(&[here as u64]);
        all.iter().flatten().sum::<u64>() as usize
    }

    /// The maxima over the particles of each body that moves freely, after a G2P pass, with the fault of each body; a fault of a
    /// ghost is that of its owner.
    pub(in crate::simulation) fn join_maxima(&mut self, bodies: &mut [(usize, ParticleMaxima)]) {
        if self.work.share.is_none() {
            return;
        }
        let viscosity = self.own_diffusivity();
        let mut numbers = vec![viscosity];
        for (_, found) in &*bodies {
            numbers.extend(found.numbers());
        }
        self.join_most(&mut numbers);
        for ((body, found), numbers) in bodies.iter_mut().zip(numbers[1..].as_chunks().0) {
            let own = self.own_particles(&self.state.sets[*body]);
            found.set_numbers(*numbers);
            found.fault = found.fault.filter(|(p, _)| own.contains(*p));
        }
        if let Some(share) = &mut self.work.share {
            share.diffusivity = numbers[0];
        }
    }

    /// The largest longitudinal viscosity over density of all ranks \[m²/s\].
    pub(in crate::simulation) fn diffusivity_of_all(&self) -> f64 {
        let share = self.work.share.as_ref();
        share.map_or_else(|| self.own_diffusivity(), |share| share.diffusivity)
    }

    /// Removes particles outside the mesh, or gives the error of the first fault, by body and then by particle, the same on all
    /// ranks; `faults` has the first of each body here. Particles come in order of the base rows of the last sort.
    pub(in crate::simulation) fn judge_together(
        &mut self,
        faults: &[(usize, usize, FaultKind)],
    ) -> Result<(), StepError> {
        if self.ranks().is_none() {
            return self.judge(faults);
        }
        for body in 0..self.state.sets.len() {
            let here = faults.iter().find(|(index, ..)| *index == body);
            let fatal = here.and_then(|&(set, p, kind)| self.fatal(set, p, kind));
            let word = match (here, &fatal) {
                (None, _) => 0,
                (Some(_), None) => 1,
                (Some(_), Some(_)) => 2,
            };
            let place = here.map_or(u64::MAX, |&(set, p, _)| self.base_row(set, p));
            let mut words = vec![place, word];
            words.extend(fatal.iter().flat_map(words_of));
            let all = self.ranks().map(|ranks| ranks.all_gather(&words));
            let all = all.unwrap_or_default();
            let faulty = all.iter().filter(|words| words[1] != 0);
            let Some(first) = faulty.min_by_key(|words| words[0]) else {
                continue;
            };
            if first[1] == 2 {
                let kind = self.error_of(body, &first[2..]);
                return Err(self.error(kind));
            }
            self.remove_outside(body)?;
        }
        Ok(())
    }

    /// Number of the base row of a particle at the last sort, by which ranks put particles in order; zero where there are none.
    pub(in crate::simulation) fn base_row(&self, set: usize, p: usize) -> u64 {
        let row = || self.state.sets[set].base_row(p, &self.work.grid.shape);
        self.ranks().map_or(0, |_| row() as u64)
    }

    /// Particles that are removed on all ranks, in order, or the first error that keeps a rank from removing its own.
    pub(in crate::simulation) fn join_removed(
        &self,
        body: usize,
        own: Result<Vec<Removed>, StepErrorKind>,
    ) -> Result<Vec<Removed>, StepErrorKind> {
        let Some(ranks) = self.ranks() else {
            return own;
        };
        let mut words = vec![];
        match &own {
            Err(error) => {
                words.push(1);
                words.extend(words_of(error));
            }
            Ok(removed) => {
                words.push(0);
                for one in removed {
                    words.push(one.base_row);
                    words.extend(words_of_particle(&one.at));
                    words.extend([one.energy, one.load].map(f64::to_bits));
                }
            }
        }
        let mut all = vec![];
        for of_rank in ranks.all_gather(&words) {
            let (failed, rest) = (of_rank[0] != 0, &of_rank[1..]);
            if failed {
                return Err(self.error_of(body, rest));
            }
            for words in rest.chunks(1 + OF_PARTICLE + 2) {
                let mut words = Words::of(words);
                all.push(Removed {
                    base_row: words.word(),
                    at: particle(&mut words),
                    energy: words.number(),
                    load: words.number(),
                });
            }
        }
        all.sort_by_key(|one| one.base_row);
        Ok(all)
    }

    /// The first particle of a body that something holds for on any rank, with a value; `here` is the first of this one, by its
    /// place.
    pub(in crate::simulation) fn join_first(
        &self,
        body: usize,
        here: Option<(usize, f64)>,
    ) -> Option<(ParticleAt, f64)> {
        let at = |p: usize| self.particle_at(body, p);
        let Some(ranks) = self.ranks() else {
            return here.map(|(p, value)| (at(p), value));
        };
        let mut words = vec![];
        if let Some((p, value)) = here {
            words.push(self.base_row(body, p));
            words.extend(words_of_particle(&at(p)));
            words.push(value.to_bits());
        }
        let all = ranks.all_gather(&words);
        let found = all.iter().filter(|words| !words.is_empty());
        let first = found.min_by_key(|words| words[0])?;
        let mut words = Words::of(&first[1..]);
        Some((particle(&mut words), words.number()))
    }

    /// The particle of any rank that a measure puts first, with its body and factor: that of the largest factor, then of the
    /// first body, then of the smallest identifier.
    pub(in crate::simulation) fn join_farthest(
        &self,
        here: (f64, Option<(usize, ParticleAt)>),
    ) -> (f64, Option<(usize, ParticleAt)>) {
        let Some(ranks) = self.ranks() else {
            return here;
        };
        let mut words = vec![here.0.to_bits()];
        if let Some((body, at)) = &here.1 {
            words.push(*body as u64);
            words.extend(words_of_particle(at));
        }
        let mut first = (1.0, None);
        for of_rank in ranks.all_gather(&words) {
            let mut words = Words::of(&of_rank);
            let factor = words.number();
            if of_rank.len() == 1 {
                continue;
            }
            let (body, at) = (words.count(), particle(&mut words));
            let place = |(body, at): &(usize, ParticleAt)| (*body, at.id);
            let earlier = first.1.is_none_or(|one| (body, at.id) < place(&one));
            if factor > first.0 || factor == first.0 && first.1.is_some() && earlier {
                first = (factor, Some((body, at)));
            }
        }
        first
    }

    /// The particle of any rank whose way has grown most; of two alike the first as one process meets them.
    pub(in crate::simulation) fn join_stretch(
        &self,
        here: Option<LargestStretch>,
    ) -> Option<LargestStretch> {
        let Some(ranks) = self.ranks() else {
            return here;
        };
        let mut words = vec![];
        if let Some(one) = &here {
            words.push(one.set as u64);
            words.extend(words_of_particle(&one.particle));
            words.extend([one.logarithm, one.stress, one.specific].map(f64::to_bits));
        }
        let mut worst: Option<LargestStretch> = None;
        for of_rank in ranks.all_gather(&words) {
            let mut words = Words::of(&of_rank);
            if of_rank.is_empty() {
                continue;
            }
            let one = LargestStretch {
                set: words.count(),
                particle: particle(&mut words),
                logarithm: words.number(),
                stress: words.number(),
                specific: words.number(),
            };
            let place = |one: &LargestStretch| (one.set, one.particle.id);
            let more = worst.is_none_or(|w| {
                one.logarithm > w.logarithm
                    || one.logarithm == w.logarithm && place(&one) < place(&w)
            });
            if more {
                worst = Some(one);
            }
        }
        worst
    }

    /// An error of this rank alone, which the others give as one of another rank.
    pub(in crate::simulation) fn fail_together(
        &self,
        here: Result<(), StepError>,
    ) -> Result<(), StepError> {
        let Some(ranks) = self.ranks() else {
            return here;
        };
        let failed = ranks.first_with(here.is_err());
        here?;
        match failed {
            None => Ok(()),
            Some(rank) => Err(self.error(StepErrorKind::OtherRank { rank })),
        }
    }

    /// Compares ghosts with their owners, once in some steps: they differ where memory or programs do.
    ///
    /// # Errors
    /// [`StepErrorKind::RanksDisagree`] on all ranks.
    pub(in crate::simulation) fn compare_ghosts(&self, step: u64) -> Result<(), StepError> {
        let Some(share) = &self.work.share else {
            return Ok(());
        };
        if !step.is_multiple_of(STEPS_PER_COMPARISON) {
            return Ok(());
        }
        let mut here = false;
        let hash = |block: &NodeBlock| vec![self.hash_of_block(block)];
        for beside in share.cut.ghosts(share.rank()) {
            let sent = [0, 1]
                .map(|side| beside.with[side].map_or_else(Vec::new, |_| hash(&beside.own[side])));
            let received = share.ranks.exchange(beside.with, sent);
            for (words, ghosts) in received.iter().zip(&beside.ghosts) {
                here |= !words.is_empty() && *words != hash(ghosts);
            }
        }
        match share.ranks.first_with(here) {
            None => Ok(()),
            Some(rank) => Err(self.error(StepErrorKind::RanksDisagree { rank })),
        }
    }

    fn hash_of_block(&self, block: &NodeBlock) -> u64 {
        let mut hasher = std::hash::DefaultHasher::new();
        for set in &self.state.sets {
            let particles = set.in_block(block, &self.work.grid.shape);
            for p in particles.iter() {
                hasher.write_u64(set.id[p]);
            }
            for column in &set.columns {
                let values = particles.iter().map(|p| column[p]);
                values.for_each(|value| hasher.write_u64(value.to_bits()));
            }
        }
        hasher.finish()
    }

    /// The error that was sent as words, of a particle of a body.
    fn error_of(&self, body: usize, words: &[u64]) -> StepErrorKind {
        let mut words = Words::of(words);
        let kind = words.word();
        let particle = particle(&mut words);
        match kind {
            NOT_FINITE => StepErrorKind::NotFinite(particle),
            INVERTED => StepErrorKind::Inverted(particle),
            OUTSIDE => StepErrorKind::Outside(particle),
            _ => StepErrorKind::Law {
                particle,
                law: self.model.bodies[body].law.name(),
                column: words
                    .rest()
                    .iter()
                    .filter_map(|c| char::from_u32(*c as u32))
                    .collect(),
            },
        }
    }
}

/// Words of a particle and where it is.
const OF_PARTICLE: usize = 7;
/// Words for the kinds of errors of a particle.
const NOT_FINITE: u64 = 0;
const INVERTED: u64 = 1;
const OUTSIDE: u64 = 2;
const LAW: u64 = 3;

fn words_of_particle(at: &ParticleAt) -> [u64; OF_PARTICLE] {
    let [x, y, z] = at.position.map(f64::to_bits);
    let (volume, mass) = (at.volume.to_bits(), at.mass.to_bits());
    [at.id, at.body as u64, x, y, z, volume, mass]
}

fn particle(words: &mut Words<'_>) -> ParticleAt {
    ParticleAt {
        id: words.word(),
        body: words.word() as i64,
        position: [(); 3].map(|()| words.number()),
        volume: words.number(),
        mass: words.number(),
    }
}

/// An error of a particle as words; other errors have none.
fn words_of(kind: &StepErrorKind) -> Vec<u64> {
    let (word, at, column) = match kind {
        StepErrorKind::NotFinite(at) => (NOT_FINITE, at, ""),
        StepErrorKind::Inverted(at) => (INVERTED, at, ""),
        StepErrorKind::Outside(at) => (OUTSIDE, at, ""),
        StepErrorKind::Law {
            particle, column, ..
        } => (LAW, particle, column.as_str()),
        _ => return vec![],
    };
    let mut words = vec![word];
    words.extend(words_of_particle(at));
    words.extend(column.chars().map(u64::from));
    words
}
