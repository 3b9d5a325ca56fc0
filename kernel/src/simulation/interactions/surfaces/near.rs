//! The particles that may touch a surface until they have moved some way, so that not all are searched for in each step.

use super::gap::{half_lengths, length, velocity};
use crate::team::OfItem;
use crate::scene::Vector;
use crate::simulation::Simulation;

/// Particles that may touch a surface until they have moved by half the margin.
#[derive(Clone, Debug, Default)]
pub(super) struct Near {
    /// Surface, set and particle.
    pub(super) particles: Vec<Place>,
    /// The triangle that was nearest to each when it was last looked for.
    pub(super) triangles: Vec<usize>,
    /// Distance beyond the threshold that is covered \[m\]; none where there is no list.
    margin: Option<f64>,
    /// Travel of the particles \[cells\] and displacement of the surfaces \[m\] when the list was made.
    travel: f64,
    shifts: Vec<Vector>,
    /// Of one body, while the list is made: the triangle nearest to each particle, and those of them that are near, by
    /// identifier.
    nearest: Vec<Option<usize>>,
    by_id: Vec<(u64, usize)>,
}

impl Near {
    /// Has the list made anew when it is next asked for.
    pub(super) fn forget(&mut self) {
        self.margin = None;
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) surface: usize,
    pub(super) set: usize,
    pub(super) p: usize,
}

impl Simulation {
    /// Makes the list of particles near a surface anew where it no longer covers what may touch in this step.
    pub(super) fn find_near_surfaces(&self, near: &mut Near, dt: f64) {
        let cell = &self.decided.scene.mesh.cell;
        let diagonal = cell.iter().map(|h| h * h).sum::<f64>().sqrt();
        let speed = self
            .state
            .found
            .iter()
            .map(|found| found.speed_squared)
            .fold(0.0, f64::max)
            .sqrt();
        let surfaces = &self.decided.scene.surfaces;
        let shift = |surface: usize| self.surface_shift(surface, self.state.clock.time);
        let fastest = surfaces
            .iter()
            .map(|s| length(&velocity(s, self.state.clock.time, dt)))
            .fold(0.0, f64::max);
        // Twice the way at the present speed, since contact and forces may make particles faster within the step.
        let step = 2.0 * dt * (speed + fastest);
        if let Some(margin) = near.margin {
            let by_surface = near
                .shifts
                .iter()
                .enumerate()
                .map(|(surface, then)| {
                    let now = shift(surface);
                    length(&std::array::from_fn(|axis| now[axis] - then[axis]))
                })
                .fold(0.0, f64::max);
            let moved = (self.state.travel - near.travel) * diagonal + by_surface;
            if moved + step <= margin {
                return;
            }
        }
        let margin = (0.25 * diagonal).max(2.0 * step);
        near.margin = Some(margin);
        near.travel = self.state.travel;
        near.particles.clear();
        near.triangles.clear();
        near.shifts.clear();
        for surface in 0..surfaces.len() {
            let shift = shift(surface);
            near.shifts.push(shift);
            for set in 0..self.state.sets.len() {
                if self.decided.bodies[set].motion.is_none() {
                    self.add_near(near, [surface, set], &shift, margin);
                }
            }
        }
    }

    /// Adds the particles of a set near a surface, in the order of their identifiers.
    fn add_near(
        &self,
        near: &mut Near,
        [surface, set]: [usize; 2],
        shift: &Vector,
        margin: f64,
    ) {
        let (rigid, particles, body) = (
            &self.decided.scene.surfaces[surface],
            &self.state.sets[set],
            &self.decided.bodies[set],
        );
        let triangle = |p: usize| {
            let local = self.on_surface(&particles.position(p), shift);
            let reach = length(&half_lengths(particles, body, p));
            let within = rigid.distance_threshold + reach + margin;
            let nearest = self.decided.local_surfaces[surface].nearest(&local, within);
            nearest.map(|nearest| nearest.triangle)
        };
        let team = &self.work.grid.team;
        team.fill(0..particles.len(), OfItem::Search, triangle, &None, &mut near.nearest);
        let found = (0..particles.len()).filter(|&p| near.nearest[p].is_some());
        near.by_id.clear();
        near.by_id.extend(found.map(|p| (particles.id[p], p)));
        near.by_id.sort_unstable();
        for &(_, p) in &near.by_id {
            if let Some(triangle) = near.nearest[p] {
                near.particles.push(Place { surface, set, p });
                near.triangles.push(triangle);
            }
        }
    }
}
