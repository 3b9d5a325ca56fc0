//! Sums over the pore water of particles: mass, energies.

use crate::layout::Layout;
use crate::model::PoreWater;
use crate::particles::ParticleSet;
use crate::simulation::Cycle;

impl Cycle {
    /// Mass of the pore water \[kg\]. It changes as water flows, since particles move with the skeleton.
    #[must_use]
    pub fn water_mass(&self) -> f64 {
        self.sum_of_water(water_mass)
    }

    /// Kinetic energy of the pore water, and what its compression stores \[J\].
    pub(in crate::simulation) fn water_energies(&self) -> [f64; 2] {
        if !self.work.grid.has_water {
            return [0.0; 2];
        }
        let kinetic = self.sum_of_water(|water, set, p| {
            let w = set
                .layout
                .water
                .map_or([0.0; 3], |first| set.vector(first, p));
            0.5 * water_mass(water, set, p) * w.iter().map(|w| w * w).sum::<f64>()
        });
        let stored = self.sum_of_water(|water, set, p| {
            let pressure = set
                .layout
                .pore_pressure()
                .map_or(0.0, |column| set.columns[column][p]);
            let volume = water_mass(water, set, p) / water.density;
            volume * pressure * pressure / (2.0 * water.bulk)
        });
        [kinetic, stored]
    }

    /// Largest speed of a compression wave in a body with water \[m/s\].
    pub(in crate::simulation) fn fast_speed(&self, index: usize, water: &PoreWater) -> f64 {
        let set = &self.state.sets[index];
        let [masses, volumes] =
            [Layout::MASS, Layout::VOLUME].map(|column| set.columns[column].as_chunks::<4>());
        let lower = |least: &mut f64, m: f64, v: f64| {
            let porosity = water.porosity_of(m, v);
            if porosity < *least {
                *least = porosity;
            }
        };
        // The fewer pores, the stiffer the water in them. Four at a time are one operation.
        let mut least = [1.0; 4];
        for (m, v) in masses.0.iter().zip(volumes.0) {
            for i in 0..4 {
                lower(&mut least[i], m[i], v[i]);
            }
        }
        for (m, v) in masses.1.iter().zip(volumes.1) {
            lower(&mut least[0], *m, *v);
        }
        let mut most = [-least.into_iter().fold(1.0, f64::min)];
        self.join_most(&mut most);
        let least = -most[0];
        water.fast_speed(self.state.found[index].wave_speed_squared, least)
    }

    fn sum_of_water(&self, term: impl Fn(&PoreWater, &ParticleSet, usize) -> f64 + Sync) -> f64 {
        let water = |index: usize| self.model.bodies[index].water.as_ref();
        let terms = |index: usize, p: usize| {
            [water(index).map_or(0.0, |water| term(water, &self.state.sets[index], p))]
        };
        let [sum] = self.sums_by_body(|index| water(index).is_some(), terms);
        sum
    }
}

/// Mass of the water of a particle \[kg\].
fn water_mass(water: &PoreWater, set: &ParticleSet, p: usize) -> f64 {
    let volume = set.columns[Layout::VOLUME][p];
    let porosity = water.porosity_of(set.columns[Layout::MASS][p], volume);
    porosity * water.density * volume
}

/// Work that what holds the pore pressure of a particle has done \[J\].
pub(in crate::simulation) fn work_of_held_pressure(set: &ParticleSet, p: usize) -> f64 {
    let held = set.layout.held_pressure;
    held.map_or(0.0, |held| set.columns[held + 1][p])
}
