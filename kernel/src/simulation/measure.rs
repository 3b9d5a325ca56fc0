//! Sums over the particles: mass, momentum, energy, hash. Always in order of the particle identifier, so that
//! they do not depend on how particles are stored.

use super::{BodyEnergy, Simulation};
use crate::laws::{Particle, UNDEFORMED};
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::scene::Vector;
use std::sync::{MutexGuard, PoisonError};

impl Simulation {
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

    /// Mass, centre of mass and mean velocity of a body \[kg, m, m/s\].
    #[must_use]
    pub fn center(&self, set: usize) -> (f64, Vector, Vector) {
        let particles = &self.state.sets[set];
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
        (mass, x, v)
    }

    /// Kinetic energy of the particles \[J\].
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.sum(kinetic_energy_of)
    }

    /// Kinetic energy, strain energy, and dead load times position, with the same bits as each of them alone, in one pass.
    pub(super) fn energies(&self) -> [f64; 3] {
        let (mut kinetic, mut strain, mut load) = (Sum::default(), 0.0, Sum::default());
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
                |p| self.strain_energy_of(index, p),
                |term| total += term,
            );
        }
        total
    }

    fn strain_energy_of(&self, index: usize, p: usize) -> f64 {
        let law = &self.decided.bodies[index].law;
        self.of_particle(index, p, |particle| law.energy(particle))
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
                |p| self.plastic_work_of(index, p),
                |term| total += term,
            );
        }
        total
    }

    fn plastic_work_of(&self, index: usize, p: usize) -> f64 {
        let law = &self.decided.bodies[index].law;
        self.of_particle(index, p, |particle| law.dissipated(particle))
    }

    /// Work that returns to yield surfaces leave neither stored nor dissipated \[J\].
    pub(super) fn algorithmic_work(&self) -> f64 {
        self.yielding().map(|(_, energy)| energy.algorithmic).sum()
    }

    /// The bodies whose law has a yield surface, by their place in [`Simulation::sets`], and where the work of their strain
    /// went.
    pub fn yielding(&self) -> impl Iterator<Item = (usize, BodyEnergy)> {
        let all = 0..self.state.sets.len();
        all.filter_map(|index| Some((index, self.body_energy(index)?)))
    }

    /// `None` for a body whose law has no yield surface.
    fn body_energy(&self, index: usize) -> Option<BodyEnergy> {
        let law = &self.decided.bodies[index].law;
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

    /// What a law says of a particle.
    fn of_particle<T>(&self, index: usize, p: usize, ask: impl FnOnce(&Particle<'_>) -> T) -> T {
        let (set, body) = (&self.state.sets[index], &self.decided.bodies[index]);
        let (mass, volume) = self.mass_and_volume(index, p);
        ask(&Particle {
            mass,
            volume,
            density: body.density,
            stress: set.stress(p),
            deformation: self.deformation(index, p).unwrap_or(UNDEFORMED),
            variables: &set.variables(p),
        })
    }

    /// Hash of the particle state in order of the identifier; see [`state_hash`].
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        state_hash(&self.state.sets)
    }

    /// Adds up what `term` says of each particle of a set, in order of the identifier. Threads find terms, as many at a time as
    /// [`TERMS`]; one adds them.
    fn add_each<T: Send + Copy + Default>(
        &self,
        set: &ParticleSet,
        term: impl Fn(usize) -> T + Send + Sync,
        mut add: impl FnMut(T),
    ) {
        let mut order = self.order();
        let order = order.of(set);
        let team = self.work.grid.team_of_particles();
        if team.count() == 1 {
            order.iter().map(|&p| term(p as usize)).for_each(add);
            return;
        }
        let mut terms = [T::default(); TERMS];
        for order in order.chunks(TERMS) {
            let share = order.len().div_ceil(team.count());
            let parts = order.chunks(share).zip(terms.chunks_mut(share));
            team.each(parts, |(order, terms)| {
                for (&p, found) in order.iter().zip(terms) {
                    *found = term(p as usize);
                }
            });
            terms[..order.len()].iter().copied().for_each(&mut add);
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
        let mut sum = Sum::default();
        for set in &self.state.sets {
            self.add_each(set, |p| term(set, p), |x| sum.add(x));
        }
        sum.value()
    }

    /// Sum of dead load times position: weight and box loads.
    pub(super) fn dead_load_potential(&self) -> f64 {
        self.sum(|set, p| self.dead_load(set, p))
    }

    fn dead_load(&self, set: &ParticleSet, p: usize) -> f64 {
        let g = self.decided.scene.gravity;
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
        self.state.books.removed += energy;
        self.state.books.dead_load_origin -= load;
    }
}

fn kinetic_energy_of(set: &ParticleSet, p: usize) -> f64 {
    let v = set.velocity(p);
    0.5 * set.columns[Layout::MASS][p] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
}

/// A compensated sum (Neumaier 1974): a million equal terms would otherwise leave 1e-11 of the sum as round-off.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
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

/// Terms of a sum that are held at a time.
const TERMS: usize = 1 << 12;

/// Indices of a set in order of the identifier.
#[derive(Debug, Default)]
pub(crate) struct ByIdentifier(Vec<u32>);

impl ByIdentifier {
    /// Those of a set. Identifiers of a set are consecutive but for removed particles, so a table of places takes the time of
    /// one pass.
    fn of(&mut self, set: &ParticleSet) -> &[u32] {
        let (first, last) = set.id.iter().fold((u64::MAX, 0), |(low, high), &id| {
            (low.min(id), high.max(id))
        });
        let places = &mut self.0;
        places.clear();
        places.resize((last + 1).saturating_sub(first) as usize, u32::MAX);
        for (p, &id) in set.id.iter().enumerate() {
            places[(id - first) as usize] = p as u32;
        }
        places.retain(|&p| p != u32::MAX);
        places
    }
}

/// FNV-1a hash, 64 bits, over identifier and the bits of every column of all particles in order of the
/// identifier, set by set. Equal for every number of threads and every kind of lanes.
#[must_use]
pub fn state_hash(sets: &[ParticleSet]) -> u64 {
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
