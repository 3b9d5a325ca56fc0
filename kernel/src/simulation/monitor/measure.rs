//! Sums over the particles: mass, momentum, energy, hash. Sums are exact but for one rounding, so that they depend neither on
//! how particles are stored nor on who adds them.

use crate::exact_sum::ExactSum;
use crate::laws::{Particle, StoredParticle};
use crate::layout::Layout;
use crate::model::Vector;
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::ranks::Removed;
use crate::simulation::state_hash::state_hash;
use crate::simulation::values::{BodyEnergy, BodyHandle, MassCenter};
use crate::simulation::water::work_of_held_pressure;
use crate::team::ItemCost;
use std::sync::{Mutex, PoisonError};

impl Cycle {
    /// Total mass \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.sum(|set, p| set.columns[Layout::MASS][p])
    }

    /// Total momentum \[kg m/s\].
    #[must_use]
    pub fn momentum(&self) -> Vector {
        self.sums(|set, p| {
            let m = set.columns[Layout::MASS][p];
            set.velocity(p).map(|v| m * v)
        })
    }

    /// Mass, centre of mass and mean velocity of a body.
    #[must_use]
    pub fn center(&self, body: impl Into<BodyHandle>) -> MassCenter {
        let particles = self.particles_of(body);
        let [mass, x0, x1, x2, v0, v1, v2] = self.sums_over(particles, |p| {
            let m = particles.columns[Layout::MASS][p];
            let (x, v) = (particles.position(p), particles.velocity(p));
            [
                m,
                m * x[0],
                m * x[1],
                m * x[2],
                m * v[0],
                m * v[1],
                m * v[2],
            ]
        });
        let (mut x, mut v) = ([x0, x1, x2], [v0, v1, v2]);
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
    pub(crate) fn energies(&self) -> [f64; 3] {
        let terms = |index: usize, p: usize| {
            let set = &self.state.sets[index];
            let strain = self.strain_energy_of(index, p);
            [kinetic_energy_of(set, p), strain, self.dead_load(set, p)]
        };
        self.sums_by_body(|_| true, terms)
    }

    /// Strain energy \[J\].
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        let [sum] = self.sums_by_body(|_| true, |index, p| [self.strain_energy_of(index, p)]);
        sum
    }

    fn strain_energy_of(&self, index: usize, p: usize) -> f64 {
        let law = &self.model.bodies[index].law;
        law.energy_of(&self.stored(index, p))
    }

    /// Energy that laws have dissipated in the particles \[J\].
    #[must_use]
    pub fn plastic_work(&self) -> f64 {
        // A law without internal variables remembers nothing that it could have dissipated.
        let remembers = |index: usize| !self.state.sets[index].layout.law.is_empty();
        let [sum] = self.sums_by_body(remembers, |index, p| [self.plastic_work_of(index, p)]);
        sum
    }

    fn plastic_work_of(&self, index: usize, p: usize) -> f64 {
        let law = &self.model.bodies[index].law;
        self.of_particle(index, p, |particle| law.dissipated(particle))
    }

    /// Work that returns to yield surfaces leave neither stored nor dissipated \[J\].
    pub(crate) fn algorithmic_work(&self) -> f64 {
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
        let set = &self.state.sets[index];
        let [stored, plastic, algorithmic] = self.sums_over(set, |p| {
            self.of_particle(index, p, |particle| {
                [
                    law.energy(particle),
                    law.dissipated(particle),
                    law.algorithmic(particle),
                ]
            })
        });
        Some(BodyEnergy {
            stored,
            plastic,
            algorithmic,
        })
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

    /// Hash of the particle state in order of the identifier: the bits of every column of every set. Ranks that share the
    /// simulation call this at the same time.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        self.hash_of_ranks()
            .unwrap_or_else(|| state_hash(&self.state.sets))
    }

    /// Adds a term of each particle of a set to each sum. Threads sum parts of the particles.
    fn add_each<const K: usize>(
        &self,
        set: &ParticleSet,
        terms: impl Fn(usize) -> [f64; K] + Sync,
        sums: &mut [ExactSum; K],
    ) {
        let team = self.work.grid.team_of_particles();
        let own = self.own_particles(set);
        let share = team.share(own.len(), ItemCost::Small);
        let parts = own.ranges().iter().flat_map(|range| {
            let firsts = range.clone().step_by(share);
            firsts.map(|first| first..(first + share).min(range.end))
        });
        let sums = Mutex::new(sums);
        team.each(parts, |particles| {
            let mut part = [ExactSum::ZERO; K];
            for p in particles {
                for (sum, term) in part.iter_mut().zip(terms(p)) {
                    sum.add(term);
                }
            }
            // In any order, since sums are exact.
            let mut sums = sums.lock().unwrap_or_else(PoisonError::into_inner);
            for (sum, part) in sums.iter_mut().zip(&part) {
                sum.merge(part);
            }
        });
    }

    /// Sum over all particles.
    fn sum(&self, term: impl Fn(&ParticleSet, usize) -> f64 + Sync) -> f64 {
        let [sum] = self.sums(|set, p| [term(set, p)]);
        sum
    }

    /// Sums over all particles.
    pub(crate) fn sums<const K: usize>(
        &self,
        terms: impl Fn(&ParticleSet, usize) -> [f64; K] + Sync,
    ) -> [f64; K] {
        self.sums_by_body(|_| true, |index, p| terms(&self.state.sets[index], p))
    }

    /// Sums over the particles of the bodies for which `counts`, of terms by body and particle.
    pub(crate) fn sums_by_body<const K: usize>(
        &self,
        counts: impl Fn(usize) -> bool,
        terms: impl Fn(usize, usize) -> [f64; K] + Sync,
    ) -> [f64; K] {
        let mut sums = [ExactSum::ZERO; K];
        for (index, set) in self.state.sets.iter().enumerate() {
            if counts(index) {
                self.add_each(set, |p| terms(index, p), &mut sums);
            }
        }
        self.join_sums(&mut sums);
        sums.map(|sum| sum.value())
    }

    /// Sums of terms over the particles of a body, by their places in its set; of all ranks, where they share the simulation and
    /// call this at the same time.
    pub fn sums_of<const K: usize>(
        &self,
        body: impl Into<BodyHandle>,
        terms: impl Fn(usize) -> [f64; K] + Sync,
    ) -> [f64; K] {
        self.sums_over(self.particles_of(body), terms)
    }

    /// Sums over the particles of a set.
    pub(crate) fn sums_over<const K: usize>(
        &self,
        set: &ParticleSet,
        terms: impl Fn(usize) -> [f64; K] + Sync,
    ) -> [f64; K] {
        let mut sums = [ExactSum::ZERO; K];
        self.add_each(set, terms, &mut sums);
        self.join_sums(&mut sums);
        sums.map(|sum| sum.value())
    }

    /// Sum of dead load times position: weight and box loads; and the work of what holds pore pressures.
    pub(crate) fn dead_load_potential(&self) -> f64 {
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
        let load: f64 = (0..3).map(|axis| (m * g[axis] + own[axis]) * x[axis]).sum();
        load + work_of_held_pressure(set, p)
    }

    /// The account of a particle that is removed.
    pub(in crate::simulation) fn account(&self, index: usize, p: usize) -> Removed {
        let set = &self.state.sets[index];
        let square: f64 = set.velocity(p).iter().map(|c| c * c).sum();
        let kinetic = 0.5 * set.columns[Layout::MASS][p] * square;
        Removed {
            base_row: self.base_row(index, p),
            at: self.particle_at(index, p),
            energy: kinetic + self.strain_energy_of(index, p) + self.plastic_work_of(index, p),
            load: self.dead_load(set, p),
        }
    }
}

/// Kinetic energy of a particle \[J\].
pub(crate) fn kinetic_energy_of(set: &ParticleSet, p: usize) -> f64 {
    let v = set.velocity(p);
    0.5 * set.columns[Layout::MASS][p] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
}
