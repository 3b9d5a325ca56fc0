//! The particles that may touch a surface until they have moved some way, so that not all are searched for in each step.

use super::obstacle::{RigidMotion, RigidObstacle, join_shifts};
use super::particle_ellipsoid::{half_lengths, length};
use proctor_geometry::team::ItemCost;
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{NodalConditions, StepView};

/// Particles that may touch a surface until they have moved by half the margin.
#[derive(Clone, Debug, Default)]
pub(super) struct NearParticles {
    /// Surface, set and particle.
    pub(super) particles: Vec<ParticlePlace>,
    /// The triangle that was nearest to each when it was last looked for.
    pub(super) triangles: Vec<usize>,
    /// Distance beyond the threshold that is covered \[m\]; none where there is no list.
    margin: Option<f64>,
    /// Travel of the particles \[cells\] and displacement of the surfaces \[m\] when the list was made.
    travel: f64,
    shifts: Vec<Vector>,
    /// Motion of each rigid obstacle in this step: found once, not for each particle.
    pub(super) now: Vec<RigidMotion>,
    /// For one body, while the list is made: the triangle nearest to each particle, and those of them that are near, by
    /// identifier.
    nearest: Vec<Option<usize>>,
    by_id: Vec<(u64, usize)>,
}

impl NearParticles {
    /// Makes the list anew when it is next asked for.
    pub(super) fn forget(&mut self) {
        self.margin = None;
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ParticlePlace {
    pub(super) surface: usize,
    pub(super) set: usize,
    pub(super) p: usize,
}

impl NearParticles {
    /// Makes the list of particles near a surface anew where it no longer covers what may touch in this step.
    pub(super) fn find(
        &mut self,
        view: &StepView<'_>,
        rigid: &[RigidObstacle],
        nodal: &NodalConditions,
    ) {
        let cell = &view.settings.mesh.cell;
        let diagonal = cell.iter().map(|h| h * h).sum::<f64>().sqrt();
        let speed = view
            .maxima
            .iter()
            .map(|found| found.speed_squared)
            .fold(0.0, f64::max)
            .sqrt();
        self.now.clear();
        self.now.extend(rigid.iter().map(|one| RigidMotion {
            shift: one.shift(view),
            velocity: one.velocity(view, nodal),
        }));
        if let Some(ranks) = view.ranks {
            join_shifts(ranks, view, rigid, &mut self.now);
        }
        let speeds = self.now.iter().map(|now| length(&now.velocity));
        let fastest = speeds.fold(0.0, f64::max);
        // Twice the way at the present speed, since contact and forces may make particles faster within the step.
        let step = 2.0 * nodal.drift * (speed + fastest);
        if let Some(margin) = self.margin {
            let ways = self.shifts.iter().zip(&self.now).map(|(then, now)| {
                length(&std::array::from_fn(|axis| now.shift[axis] - then[axis]))
            });
            let by_surface = ways.fold(0.0, f64::max);
            let moved = (view.travel - self.travel) * diagonal + by_surface;
            if moved + step <= margin {
                return;
            }
        }
        let margin = (0.25 * diagonal).max(2.0 * step);
        self.margin = Some(margin);
        self.travel = view.travel;
        self.particles.clear();
        self.triangles.clear();
        self.shifts.clear();
        for (surface, one) in rigid.iter().enumerate() {
            self.shifts.push(self.now[surface].shift);
            for set in 0..view.particles.len() {
                if one.pushes(view, set) {
                    self.add(view, one, [surface, set], margin);
                }
            }
        }
    }

    /// Adds the particles of a set near a surface, in the order of their identifiers.
    fn add(
        &mut self,
        view: &StepView<'_>,
        rigid: &RigidObstacle,
        [surface, set]: [usize; 2],
        margin: f64,
    ) {
        let (particles, body) = (&view.particles[set], &view.bodies[set]);
        let (shift, threshold) = (self.now[surface].shift, rigid.widest_threshold());
        let own = view.own_particles(set);
        let triangle = |p: usize| {
            if !own.contains(p) {
                return None;
            }
            let reach = length(&rigid.half_lengths(half_lengths(particles, body, p)));
            let within = threshold + reach + margin;
            let nearest = rigid.nearest(view, &particles.position(p), &shift, within, None);
            nearest.map(|nearest| nearest.triangle)
        };
        let team = view.team();
        let span = own.span();
        team.fill(
            span.clone(),
            ItemCost::Search,
            triangle,
            &None,
            &mut self.nearest,
        );
        let place = |p: usize| p - span.start;
        let found = own.iter().filter(|&p| self.nearest[place(p)].is_some());
        self.by_id.clear();
        self.by_id.extend(found.map(|p| (particles.id[p], p)));
        self.by_id.sort_unstable();
        for &(_, p) in &self.by_id {
            if let Some(triangle) = self.nearest[place(p)] {
                self.particles.push(ParticlePlace { surface, set, p });
                self.triangles.push(triangle);
            }
        }
    }
}
