//! Sums over the particles: mass, momentum, energy, hash. Always in order of the particle identifier, so that
//! they do not depend on how particles are stored.

use super::Cycle;
use crate::laws::{Particle, StoredParticle};
use crate::layout::Layout;
use crate::model::Vector;
use crate::particles::ParticleSet;
use crate::simulation::values::{BodyEnergy, BodyHandle, MassCenter};
use crate::team::ItemCost;
use std::sync::{MutexGuard, PoisonError};

impl Cycle {
    /// Total mass \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.sum(|set, p| set.columns[Layout::MASS][p])
    }

    /// Total momentum \[kg m/s\].
    #[must_use]
    pub fn momentum(&self) -> Vector {
        std::array::from_fn(|axis| {
            self.sum(|set, p| set.columns[Layout::MASS][p] * set.velocity(p)[axis])
        })
    }

    /// Mass, centre of mass and mean velocity of a body.
    #[must_use]
    pub fn center(&self, body: impl Into<BodyHandle>) -> MassCenter {
        let particles = self.particles_of(body);
        let (mut mass, mut x, mut v) = (0.0, [0.0; 3], [0.0; 3]);
        for &p in self.order().of(particles) {
            let p = p as usize;
            let m = particles.columns[Layout::MASS][p];
            let (x_p, v_p) = (particles.position(p), particles.velocity(p));
            mass += m;
            for axis in 0..3 {
                x[axis] += m * x_p[axis];
                v[axis] += m * v_p[axis];
            }
        }
        let origin = self.origin();
        if mass > 0.0 {
            x = std::array::from_fn(|axis| x[axis] / mass + origin[axis]);
            v = v.map(|c| c / mass);
        }
        MassCenter {
            mass,
            position: x,
            velocity: v,
        }
    }

    /// Kinetic energy of the particles \[J\].
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.sum(kinetic_energy_of)
    }

    /// Kinetic energy, strain energy, and dead load times position, with the same bits as each of them alone, in one pass.
    pub(super) fn energies(&self) -> [f64; 3] {
        let (mut kinetic, mut strain, mut load) =
            (CompensatedSum::default(), 0.0, CompensatedSum::default());
        for (index, set) in self.state.sets.iter().enumerate() {
            let terms = |p| {
                let strain = self.strain_energy_of(index, p);
                [kinetic_energy_of(set, p), strain, self.dead_load(set, p)]
            };
            self.add_each(set, terms, |terms| {
                kinetic.add(terms[0]);
                strain += terms[1];
                load.add(terms[2]);
            });
        }
        [kinetic.value(), strain, load.value()]
    }

    /// Strain energy \[J\].
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        let mut total = 0.0;
        for (index, set) in self.state.sets.iter().enumerate() {
            self.add_each(
                set,
                |p| [self.strain_energy_of(index, p)],
                |[term]| total += term,
            );
        }
        total
    }

    fn strain_energy_of(&self, index: usize, p: usize) -> f64 {
        let law = &self.model.bodies[index].law;
        law.energy_of(&self.stored(index, p))
    }

    /// Energy that laws have dissipated in the particles \[J\].
    #[must_use]
    pub fn plastic_work(&self) -> f64 {
        let mut total = 0.0;
        for (index, set) in self.state.sets.iter().enumerate() {
            // A law without internal variables remembers nothing that it could have dissipated.
            if set.layout.law.is_empty() {
                continue;
            }
            self.add_each(
                set,
                |p| [self.plastic_work_of(index, p)],
                |[term]| total += term,
            );
        }
        total
    }

    fn plastic_work_of(&self, index: usize, p: usize) -> f64 {
        let law = &self.model.bodies[index].law;
        self.of_particle(index, p, |particle| law.dissipated(particle))
    }

    /// Work that returns to yield surfaces leave neither stored nor dissipated \[J\].
    pub(super) fn algorithmic_work(&self) -> f64 {
        self.yielding().map(|(_, energy)| energy.algorithmic).sum()
    }

    /// The bodies whose law has a yield surface, by their place in [`Cycle::sets`], and where the work of their strain
    /// went.
    pub fn yielding(&self) -> impl Iterator<Item = (usize, BodyEnergy)> {
        let all = 0..self.state.sets.len();
        all.filter_map(|index| Some((index, self.body_energy(index)?)))
    }

    /// `None` for a body whose law has no yield surface.
    fn body_energy(&self, index: usize) -> Option<BodyEnergy> {
        let law = &self.model.bodies[index].law;
        if !law.yields() {
            return None;
        }
        let mut sum = BodyEnergy::default();
        for &p in self.order().of(&self.state.sets[index]) {
            self.of_particle(index, p as usize, |particle| {
                sum.stored += law.energy(particle);
                sum.plastic += law.dissipated(particle);
                sum.algorithmic += law.algorithmic(particle);
            });
        }
        Some(sum)
    }

    /// Value of a particle by its law.
    fn of_particle<T>(&self, index: usize, p: usize, ask: impl FnOnce(&Particle<'_>) -> T) -> T {
        self.stored(index, p).ask(ask)
    }

    fn stored(&self, index: usize, p: usize) -> StoredParticle<'_> {
        StoredParticle {
            set: &self.state.sets[index],
            density: self.model.bodies[index].density,
            p,
        }
    }

    /// Hash of the particle state in order of the identifier: the bits of every column of every set.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        state_hash(&self.state.sets)
    }

    /// Adds up what `term` says of each particle of a set, in order of the identifier. Threads find terms of as many particles
    /// at a time as [`AT_ONCE`]; one adds them.
    fn add_each<const K: usize>(
        &self,
        set: &ParticleSet,
        term: impl Fn(usize) -> [f64; K] + Sync,
        mut add: impl FnMut([f64; K]),
    ) {
        let mut kept = self.order();
        let ByIdentifier { places, terms } = kept.fill(set);
        let team = self.work.grid.team_of_particles();
        if team.count() == 1 {
            places.iter().map(|&p| term(p as usize)).for_each(add);
            return;
        }
        for places in places.chunks(AT_ONCE) {
            terms.resize(K * places.len(), 0.0);
            let share = team.share(places.len(), ItemCost::Small);
            let parts = places.chunks(share).zip(terms.chunks_mut(K * share));
            team.each(parts, |(places, terms)| {
                let (terms, _) = terms.as_chunks_mut();
                for (&p, found) in places.iter().zip(terms) {
                    *found = term(p as usize);
                }
            });
            let (terms, _) = terms.as_chunks();
            terms.iter().copied().for_each(&mut add);
        }
    }

    fn order(&self) -> MutexGuard<'_, ByIdentifier> {
        // Nothing is left behind half written that matters: it is filled before it is read.
        self.work
            .order
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Sum over all particles in order of the identifier.
    fn sum(&self, term: impl Fn(&ParticleSet, usize) -> f64 + Sync) -> f64 {
        let mut sum = CompensatedSum::default();
        for set in &self.state.sets {
            self.add_each(set, |p| [term(set, p)], |[x]| sum.add(x));
        }
        sum.value()
    }

    /// Sum over the particles of a set in order of the identifier.
    pub(super) fn sum_over(&self, set: &ParticleSet, term: impl Fn(usize) -> f64 + Sync) -> f64 {
        let mut sum = CompensatedSum::default();
        self.add_each(set, |p| [term(p)], |[x]| sum.add(x));
        sum.value()
    }

    /// Sum of dead load times position: weight and box loads.
    pub(super) fn dead_load_potential(&self) -> f64 {
        self.sum(|set, p| self.dead_load(set, p))
    }

    fn dead_load(&self, set: &ParticleSet, p: usize) -> f64 {
        let g = self.model.settings.gravity;
        let x: Vector =
            std::array::from_fn(|axis| set.position(p)[axis] + self.state.mesh_shift[axis]);
        let m = set.columns[Layout::MASS][p];
        let own = set
            .layout
            .force
            .map_or([0.0; 3], |first| set.vector(first, p));
        (0..3).map(|axis| (m * g[axis] + own[axis]) * x[axis]).sum()
    }

    /// Takes a particle that is removed out of the balance, and notes the energy that goes with it.
    pub(super) fn close_account(&mut self, index: usize, p: usize) {
        let set = &self.state.sets[index];
        let square: f64 = set.velocity(p).iter().map(|c| c * c).sum();
        let kinetic = 0.5 * set.columns[Layout::MASS][p] * square;
        let energy = kinetic + self.strain_energy_of(index, p) + self.plastic_work_of(index, p);
        let load = self.dead_load(set, p);
        self.state.ledger.removed += energy;
        self.state.ledger.dead_load_origin -= load;
    }
}

fn kinetic_energy_of(set: &ParticleSet, p: usize) -> f64 {
    let v = set.velocity(p);
    0.5 * set.columns[Layout::MASS][p] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
}

/// A compensated sum (Neumaier 1974): a million equal terms would otherwise leave 1e-11 of the sum as round-off.
#[derive(Clone, Copy, Debug, Default)]
struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    fn add(&mut self, x: f64) {
        let next = self.sum + x;
        self.lost += if self.sum.abs() >= x.abs() {
            (self.sum - next) + x
        } else {
            (x - next) + self.sum
        };
        self.sum = next;
    }

    fn value(self) -> f64 {
        self.sum + self.lost
    }
}

/// Particles whose terms are held at a time: as many as a thread is worth being woken for, but not as many as there may be.
const AT_ONCE: usize = 1 << 16;

/// Indices of a set in order of the identifier, and memory for terms of sums in this order.
#[derive(Debug, Default)]
pub(crate) struct ByIdentifier {
    places: Vec<u32>,
    terms: Vec<f64>,
}

impl ByIdentifier {
    /// Places of the particles of a set by identifier. Identifiers of a set are consecutive but for removed particles, so a table of places takes the time of
    /// one pass.
    fn of(&mut self, set: &ParticleSet) -> &[u32] {
        &self.fill(set).places
    }

    fn fill(&mut self, set: &ParticleSet) -> &mut Self {
        let (first, last) = set.id.iter().fold((u64::MAX, 0), |(low, high), &id| {
            (low.min(id), high.max(id))
        });
        let places = &mut self.places;
        places.clear();
        places.resize((last + 1).saturating_sub(first) as usize, u32::MAX);
        for (p, &id) in set.id.iter().enumerate() {
            places[(id - first) as usize] = p as u32;
        }
        places.retain(|&p| p != u32::MAX);
        self
    }
}

/// FNV-1a hash, 64 bits, over identifier and the bits of every column of all particles in order of the
/// identifier, set by set. Equal for every number of threads and every kind of lanes.
#[must_use]
pub(crate) fn state_hash(sets: &[ParticleSet]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |word: u64| {
        // A word at a time instead of a byte: eight times faster, and every bit still counts.
        hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^= hash >> 32;
    };
    let mut order = ByIdentifier::default();
    for set in sets {
        add(set.len() as u64);
        for &p in order.of(set) {
            let p = p as usize;
            add(set.id[p]);
            for column in &set.columns {
                add(column[p].to_bits());
            }
        }
    }
    hash
}

/// Kinetic energy of the particles of one body \[J\].
pub(super) fn kinetic_energy(set: &ParticleSet) -> f64 {
    let square = |p: usize| -> f64 { set.velocity(p).iter().map(|c| c * c).sum() };
    let mass = &set.columns[Layout::MASS];
    mass.iter()
        .enumerate()
        .map(|(p, m)| 0.5 * m * square(p))
        .sum()
}
