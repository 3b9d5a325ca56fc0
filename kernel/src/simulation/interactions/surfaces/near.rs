//! The particles that may touch a surface until they have moved some way, so that not all are searched for in each step.

use super::gap::{half_lengths, length, velocity};
use crate::scene::Vector;
use crate::simulation::Simulation;

/// Particles that may touch a surface until they have moved by half the margin.
#[derive(Clone, Debug)]
pub(super) struct Near {
    /// Surface, set and particle.
    pub(super) particles: Vec<Place>,
    /// Travel of the particles \[cells\] and displacement of the surfaces \[m\] when the list was made.
    travel: f64,
    shifts: Vec<Vector>,
    /// Distance beyond the threshold that is covered \[m\].
    margin: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) surface: usize,
    pub(super) set: usize,
    pub(super) p: usize,
}

impl Simulation {
    /// The list of particles near a surface, made anew where it no longer covers what may touch in this step.
    pub(super) fn near_surfaces(&self, known: Option<Near>, dt: f64) -> Near {
        let cell = &self.decided.scene.mesh.cell;
        let diagonal = cell.iter().map(|h| h * h).sum::<f64>().sqrt();
        let speed = self
            .state
            .found
            .iter()
            .map(|found| found.speed_squared)
            .fold(0.0, f64::max)
            .sqrt();
        let shifts: Vec<Vector> = (0..self.decided.scene.surfaces.len())
            .map(|s| self.surface_shift(s, self.state.clock.time))
            .collect();
        let fastest = self
            .decided.scene
            .surfaces
            .iter()
            .map(|s| length(&velocity(s, self.state.clock.time, dt)))
            .fold(0.0, f64::max);
        // Twice the way at the present speed, since contact and forces may make particles faster within the step.
        let step = 2.0 * dt * (speed + fastest);
        if let Some(near) = known {
            let by_surface = shifts
                .iter()
                .zip(&near.shifts)
                .map(|(a, b)| length(&std::array::from_fn(|axis| a[axis] - b[axis])))
                .fold(0.0, f64::max);
            let moved = (self.state.travel - near.travel) * diagonal + by_surface;
            if moved + step <= near.margin {
                return near;
            }
        }
        let margin = (0.25 * diagonal).max(2.0 * step);
        let mut particles = vec![];
        for (surface, shift) in shifts.iter().enumerate() {
            for set in 0..self.state.sets.len() {
                if self.decided.bodies[set].motion.is_none() {
                    particles.extend(self.near_particles(surface, set, shift, margin));
                }
            }
        }
        Near {
            particles,
            travel: self.state.travel,
            shifts,
            margin,
        }
    }

    /// Particles of a set near a surface, in the order of their identifiers.
    fn near_particles(
        &self,
        surface: usize,
        set: usize,
        shift: &Vector,
        margin: f64,
    ) -> Vec<Place> {
        let (rigid, particles, body) = (
            &self.decided.scene.surfaces[surface],
            &self.state.sets[set],
            &self.decided.bodies[set],
        );
        let is_near = |p: usize| {
            let local = self.on_surface(&particles.position(p), shift);
            let reach = length(&half_lengths(particles, body, p));
            let within = rigid.distance_threshold + reach + margin;
            self.decided.local_surfaces[surface]
                .nearest(&local, within)
                .is_some()
        };
        let near = self.work.grid.team.collect(0..particles.len(), is_near);
        let mut found: Vec<usize> = (0..near.len()).filter(|&p| near[p]).collect();
        found.sort_unstable_by_key(|&p| particles.id[p]);
        found
            .into_iter()
            .map(|p| Place { surface, set, p })
            .collect()
    }
}
