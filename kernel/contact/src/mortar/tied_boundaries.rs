//! Boundaries whose vertices stay on the particles that they are tied to.

use super::boundaries::Boundaries;
use super::error::MortarError;
use super::mirrors::Mirrors;
use super::patch::{force_at, from_vector, in_scene, velocity_at};
use super::stencil_reach::{StencilReach, stencil_nodes};
use super::surface::MovingBoundary;
use super::surface::stays;
use super::tied_particles::TiedParticles;
use super::vertex_ties::VertexTies;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::elements::Elements;
use proctor_geometry::team::{ItemCost, Team};
use proctor_kernel::grid::Line;
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{Drift, SetupError, StepView};

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Ties the vertices of all bodies to their particles, once, at the start.
    pub(super) fn tie(&mut self, view: &StepView<'_>) {
        let mirrors = Mirrors::of(view.settings);
        for surface in self.surfaces.iter_mut().filter(|s| s.tied.is_none()) {
            let bodies = view.bodies;
            if let Some(index) = bodies.iter().position(|body| body.id == surface.id) {
                let own = (&view.particles[index], &bodies[index]);
                surface.tied = Some(TiedParticles::new(VertexTies::new(
                    &surface.start,
                    own,
                    &mirrors,
                )));
            }
        }
    }

    /// Refuses a vertex that stays on the material and has too little of it around.
    ///
    /// # Errors
    /// The first one.
    pub(super) fn refuse_untied(&self, origin: &Vector) -> Result<(), SetupError> {
        for surface in &self.surfaces {
            let Some(tied) = surface.anchor() else {
                continue;
            };
            if let Some(vertex) = (0..tied.ties.vertices()).find(|v| tied.ties.of(*v).is_empty()) {
                let [x, y, z] = in_scene(&surface.start[vertex], origin);
                return Err(SetupError::Interaction {
                    path: format!("boundary of body {}", surface.id),
                    reason: format!(
                        "the particles around vertex {vertex} at ({x}, {y}, {z}) m do not span all directions, so that it \
                         cannot stay on them; accepted: vertices on a body of two or more particles across, or one whose \
                         `boundary_follows` is \"gradient\""
                    ),
                });
            }
        }
        Ok(())
    }

    /// The vertex of a body that moves freely that is farthest from where the material says that it is: identifier of the
    /// body, number of the vertex, and distance \[m\].
    pub(super) fn farthest_off(&self, view: &StepView<'_>) -> Option<(i64, usize, f64)> {
        let bodies = self.surfaces.iter().filter_map(|surface| {
            let set = &view.particles[surface.body()?];
            Some((surface, surface.tied.as_ref()?.displacements(set)))
        });
        let distances = bodies.flat_map(|(surface, displacements)| {
            displacements.into_iter().enumerate().map(|(vertex, way)| {
                let x = surface.start[vertex] + surface.boundary.held(vertex, way);
                let distance = (surface.boundary.points()[vertex] - x).norm();
                (surface.id, vertex, distance)
            })
        });
        let known = distances.filter(|(_, _, distance)| distance.is_finite());
        known.reduce(|most, one| if one.2 > most.2 { one } else { most })
    }
}

impl<B, const D: usize, const N: usize> MovingBoundary<B, D, N> {
    /// The ties, where vertices stay on the material.
    pub(super) fn anchor(&self) -> Option<&TiedParticles<D>> {
        self.tied.as_ref().filter(|_| stays(&self.carrier))
    }

    /// Moves the vertices to where the material is; finds the nodes that their particles reach, their velocities, and the
    /// change of these by `kick` \[s\] where nothing touches them.
    ///
    /// # Errors
    /// The first vertex without particles that span all directions around it.
    pub(super) fn weigh_tied<const T: usize>(
        &mut self,
        index: usize,
        view: &StepView<'_>,
        kick: f64,
    ) -> Result<(), MortarError>
    where
        B: Elements<D, T>,
    {
        let Some(tied) = &mut self.tied else {
            return Ok(());
        };
        let Some(field) = view.grid.own_field(index) else {
            return Ok(());
        };
        let (set, body) = (&view.particles[index], &view.bodies[index]);
        let (shape, team) = (&view.grid.shape, &view.grid.team);
        let mirrors = Mirrors::of(view.settings);
        tied.ties.find(set, &mut tied.places);
        let mut lists = std::mem::take(&mut tied.lists);
        let [displacements, _] = &mut lists.of_particles;
        tied.ties.displacements(set, &tied.places, displacements);
        let boundary = &self.boundary;
        let of = |vertex: usize| boundary.held(vertex, tied.ties.sum(vertex, displacements));
        team.fill(
            0..self.start.len(),
            ItemCost::Search,
            of,
            &PointIn::zeros(),
            &mut lists.ways,
        );
        for (vertex, way) in lists.ways.iter().enumerate() {
            // Particles that were removed have no place.
            if way.iter().any(|x| x.is_nan()) {
                return Err(MortarError::VertexLost {
                    body: self.id,
                    vertex,
                    position: in_scene(&self.boundary.points()[vertex], &view.origin()),
                });
            }
        }
        let places = self.boundary.points_mut().iter_mut().zip(&self.start);
        for ((x, start), way) in places.zip(&lists.ways) {
            *x = start + way;
        }
        let stencil = view.stencil;
        if tied.stencil.len() != stencil.pow(D as u32) {
            tied.stencil = stencil_nodes(stencil, shape);
        }
        let places = &tied.places;
        let reach = |number: usize| {
            // Those that were removed are of no vertex that is left.
            let p = places[number].unwrap_or(0);
            StencilReach::of((set, p), &body.mapping, shape, &mirrors, stencil)
        };
        team.fill(
            0..places.len(),
            ItemCost::Search,
            reach,
            &StencilReach::NOWHERE,
            &mut tied.reached,
        );
        let gravity: PointIn<D> = from_vector(&view.settings.gravity);
        let lines = field.nodes.lines();
        // A plane that is fixed to a moving base mirrors velocities relative to it.
        let base = view.base;
        let base: PointIn<D> = base.map_or_else(PointIn::zeros, |base| {
            from_vector(&base.at(view.clock.time))
        });
        tied.gather(&mut lists, shape, &mirrors, team, |node| {
            let line = &lines[node];
            [velocity_at(line) - base, force_at(line) / line[0]]
        });
        let [velocities, accelerations] = &lists.of_particles;
        let boundary = &self.boundary;
        let of = |vertex: usize| {
            let v = base + tied.ties.sum(vertex, velocities);
            let a = gravity + tied.ties.sum(vertex, accelerations);
            [v, a * kick].map(|v| boundary.held(vertex, v))
        };
        team.fill(
            0..self.start.len(),
            ItemCost::Search,
            of,
            &[PointIn::zeros(); 2],
            &mut lists.found,
        );
        for (vertex, &[v, kick]) in lists.found.iter().enumerate() {
            self.velocity[vertex] = v;
            self.kick[vertex] = kick;
        }
        tied.lists = lists;
        Ok(())
    }

    /// Finds how far the vertices move in a step, with the velocities that their particles move with.
    pub(super) fn move_with_ties<const T: usize>(
        &mut self,
        lines: &[Line],
        drift: &Drift,
        team: &Team,
    ) where
        B: Elements<D, T>,
    {
        let Some(tied) = &mut self.tied else {
            return;
        };
        // Ghosts are filled by now.
        let mesh: PointIn<D> = from_vector(&drift.mesh_shift);
        let of = |number: usize| {
            let reach = &tied.reached[number];
            let mut v = PointIn::zeros();
            for node in &tied.stencil {
                v += reach.weight(node) * velocity_at::<D>(&lines[reach.node(node)]);
            }
            v * drift.time - mesh
        };
        let [ways, _] = &mut tied.lists.of_particles;
        team.fill(
            0..tied.reached.len(),
            ItemCost::Search,
            of,
            &PointIn::zeros(),
            ways,
        );
        let (boundary, ties) = (&self.boundary, &tied.ties);
        let moved = |vertex: usize| boundary.held(vertex, ties.sum(vertex, ways)) + mesh;
        team.fill(
            0..self.start.len(),
            ItemCost::Search,
            moved,
            &PointIn::zeros(),
            &mut self.moved,
        );
    }
}
