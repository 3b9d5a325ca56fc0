//! All boundaries and pairs of one dimension, and what a step does with them.

use super::error::MortarError;
use super::mirrors::Mirrors;
use super::neighbours::NodeSums;
use super::pair::MortarPair;
use super::patch::{Patch, force_at, from_vector, in_scene, velocity_at, velocity_of};
use super::surface::stays;
use super::surface::{BoundaryCarrier, MovingBoundary};
use super::vertex_weights::VertexWeighting;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::bound::{ClosingRate, allowed_approach};
use crate::geometry::mortar::broad::Bounds;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::motion::FollowMode;
use crate::geometry::mortar::pair::{PairSurfaces, StepAhead, contact_forces_to};
use proctor_geometry::team::{ItemCost, Team};
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{Drift, Grid, StepView};
use std::sync::atomic::{self, AtomicUsize};

/// Boundaries of elements with D vertices whose patches have N nodes and whose vertices T tangents, and their pairs.
#[derive(Clone, Debug)]
pub(crate) struct Boundaries<B, const D: usize, const N: usize, const T: usize> {
    pub(crate) surfaces: Vec<MovingBoundary<B, D, N>>,
    pub(crate) pairs: Vec<MortarPair<D, T>>,
    /// Memory of [`NeighbourParticles::find_gradients`](super::around::NeighbourParticles::find_gradients).
    sums: NodeSums<D>,
}

impl<B, const D: usize, const N: usize, const T: usize> Default for Boundaries<B, D, N, T> {
    fn default() -> Self {
        Self {
            surfaces: vec![],
            pairs: vec![],
            sums: vec![],
        }
    }
}

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Adds a boundary in the coordinates of the scene; `origin` is that of the mesh \[m\].
    pub(super) fn add(
        &mut self,
        id: i64,
        mut boundary: B,
        carrier: BoundaryCarrier,
        origin: &Vector,
    ) {
        let shift = from_vector(origin);
        for p in boundary.points_mut() {
            *p -= shift;
        }
        let zeros = vec![PointIn::zeros(); boundary.points().len()];
        self.surfaces.push(MovingBoundary {
            id,
            around: carrier.around(),
            carrier,
            start: boundary.points().to_vec(),
            boundary,
            moved: zeros.clone(),
            velocity: zeros.clone(),
            kick: zeros.clone(),
            force: zeros,
            on_face: vec![],
            faces: vec![],
            flat: vec![],
            pressed: false,
            patches: vec![],
            held: vec![],
            stiffness: vec![],
            tied: None,
        });
    }

    /// Gaps and forces of a pair; `ahead` is the longest next step, if there is to be one \[s\].
    pub(super) fn meet(&mut self, p: usize, ahead: Option<f64>, team: &Team) {
        let pair = &mut self.pairs[p];
        let (slave, master) = (&self.surfaces[pair.slave], &self.surfaces[pair.master]);
        let box_of =
            |s: &MovingBoundary<B, D, N>, margin| Bounds::around(s.boundary.points(), margin);
        let margin = pair.law.search.margin();
        if box_of(slave, margin).overlaps(&box_of(master, 0.0)) {
            contact_forces_to(
                &mut pair.forces,
                PairSurfaces {
                    slave: &slave.boundary,
                    master: &master.boundary,
                    slave_moved: &slave.moved,
                    master_moved: &master.moved,
                    slave_velocity: &slave.velocity,
                    master_velocity: &master.velocity,
                    ahead: ahead.map(|time| StepAhead {
                        time,
                        slave_kick: &slave.kick,
                        master_kick: &master.kick,
                    }),
                },
                &pair.law,
                &mut pair.slip,
                &mut pair.work,
                team,
            );
        } else {
            pair.forces.clear(0, 0, 0);
            pair.slip.0.fill([0.0; T]);
        }
        pair.closing = ClosingRate::of(
            &pair.forces.sites,
            pair.critical_gap,
            pair.law.search.reach,
            [slave.fastest(), master.fastest()],
        );
    }

    /// Gaps and forces of all pairs, and the forces on the vertices of all surfaces.
    ///
    /// # Errors
    /// The first pair that closed too far, is too deep in each other, or meets at edges.
    pub(super) fn meet_all(
        &mut self,
        ahead: f64,
        origin: &Vector,
        team: &Team,
    ) -> Result<(), MortarError> {
        for surface in &mut self.surfaces {
            surface.force.fill(PointIn::zeros());
        }
        for p in 0..self.pairs.len() {
            self.meet(p, Some(ahead), team);
            self.judge(p, origin)?;
            let pair = &self.pairs[p];
            for (surface, forces) in [
                (pair.slave, &pair.forces.slave),
                (pair.master, &pair.forces.master),
            ] {
                let own = &mut self.surfaces[surface].force;
                for (sum, f) in own.iter_mut().zip(forces) {
                    *sum += f;
                }
            }
        }
        Ok(())
    }

    /// Weights of the vertices of all bodies; velocities of all vertices, and by how much they change in a step of
    /// `ahead` \[s\] where nothing touches them.
    ///
    /// # Errors
    /// The first vertex without a node with mass near it.
    pub(super) fn weigh(&mut self, view: &StepView<'_>, ahead: f64) -> Result<(), MortarError> {
        let (time, mirrors) = (view.clock.time, Mirrors::of(view.settings));
        let shape = &view.grid.shape;
        // Velocities live at half-steps.
        let kick = 0.5 * (view.clock.dt_before + ahead);
        let gravity: PointIn<D> = from_vector(&view.settings.gravity);
        for surface in &mut self.surfaces {
            let (index, follow) = match &surface.carrier {
                BoundaryCarrier::Body { index, follow } => (*index, *follow),
                BoundaryCarrier::Prescribed(motion) => {
                    let v = velocity_of(motion.as_ref(), time);
                    let later: PointIn<D> = velocity_of(motion.as_ref(), time + ahead);
                    surface.velocity.fill(v);
                    surface.kick.fill(later - v);
                    continue;
                }
            };
            if follow == FollowMode::Material {
                surface.weigh_tied(index, view, kick)?;
                continue;
            }
            let Some(weighing) = VertexWeighting::of(view, index) else {
                continue;
            };
            let (points, lines) = (surface.boundary.points(), weighing.lines);
            let weigh = |vertex: usize, patch: &mut Patch<D, N>| -> Option<[PointIn<D>; 2]> {
                weighing.weigh(&points[vertex], follow, patch).ok()?;
                // Weights that are not augmented reach nodes of no mass, which nothing but forces moves.
                let (mut v, mut a) = (PointIn::zeros(), gravity);
                for k in 0..N {
                    let w = patch.weights.weights[k];
                    if w > 0.0 {
                        let line = &lines[patch.nodes[k]];
                        v += w * velocity_at(line);
                        if follow != FollowMode::Unaugmented {
                            a += w / patch.masses[k] * force_at(line);
                        }
                    }
                }
                Some([v, a * kick].map(|v| surface.boundary.held(vertex, v)))
            };
            let team = &view.grid.team;
            surface.patches.resize(points.len(), Patch::NOWHERE);
            let lost = AtomicUsize::new(usize::MAX);
            let share = team.share(points.len(), ItemCost::Search);
            let parts = (surface.patches.chunks_mut(share))
                .zip(surface.velocity.chunks_mut(share))
                .zip(surface.kick.chunks_mut(share));
            team.each(
                parts.enumerate(),
                |(part, ((patches, velocities), kicks))| {
                    let vertices = part * share..;
                    let own = patches.iter_mut().zip(velocities).zip(kicks);
                    for (vertex, ((patch, velocity), kick)) in vertices.zip(own) {
                        match weigh(vertex, patch) {
                            Some(found) => [*velocity, *kick] = found,
                            None => {
                                lost.fetch_min(vertex, atomic::Ordering::Relaxed);
                            }
                        }
                    }
                },
            );
            let vertex = lost.into_inner();
            if let Some(x) = surface.boundary.points().get(vertex) {
                return Err(MortarError::VertexLost {
                    body: surface.id,
                    vertex,
                    position: in_scene(x, &view.origin()),
                });
            }
            if let Some(around) = &mut surface.around {
                let own = (&view.particles[index], &view.bodies[index]);
                let (stencil, team) = (view.stencil, &view.grid.team);
                around.find(
                    &surface.patches,
                    own,
                    shape,
                    &mirrors,
                    stencil,
                    (view.lanes, team),
                );
            }
        }
        Ok(())
    }

    /// Stops where the boundaries of a pair may have passed each other in the last step, or one came into the other by
    /// more than half the critical gap, or is deeper in it than the critical gap, or where edges meet.
    fn judge(&self, p: usize, origin: &Vector) -> Result<(), MortarError> {
        let pair = &self.pairs[p];
        let (slave, master) = (&self.surfaces[pair.slave], &self.surfaces[pair.master]);
        let bodies = [master.id, slave.id];
        let place = |v: usize| in_scene(&slave.boundary.points()[v], origin);
        let missed = |vertex: Option<usize>, approach: f64, allowed: f64| {
            Err(MortarError::ClosingTooFast {
                bodies,
                vertex: vertex.map(|v| (v, place(v))),
                approach,
                allowed,
            })
        };
        let allowed = allowed_approach(pair.law.search.reach, pair.critical_gap);
        let approach = slave.farthest() + master.farthest();
        if approach > allowed {
            return missed(None, approach, allowed);
        }
        // Bodies speed up within a step. What is still apart has not been missed.
        let allowed = 0.5 * pair.critical_gap;
        for site in pair.forces.sites.iter().flatten() {
            if site.gap < 0.0 && site.approach > allowed {
                return missed(Some(site.vertex), site.approach, allowed);
            }
        }
        if let Some((vertex, gap)) = pair.forces.smallest_gap()
            && gap < -pair.critical_gap
        {
            return Err(MortarError::Penetration {
                bodies,
                vertex,
                position: place(vertex),
                gap,
            });
        }
        if let Some((at, distance)) = self.edges_that_meet(p) {
            return Err(MortarError::EdgesMeet {
                bodies,
                position: in_scene(&at, origin),
                distance,
            });
        }
        Ok(())
    }

    /// Place where edges of a pair meet within the critical gap, and their distance \[m\].
    pub(super) fn edges_that_meet(&self, p: usize) -> Option<(PointIn<D>, f64)> {
        let pair = &self.pairs[p];
        let [slave, master] = [pair.slave, pair.master].map(|s| &self.surfaces[s].boundary);
        slave.edges_that_meet(master, pair.critical_gap, pair.critical_gap)
    }

    /// The first pair that would close too far in a step at the speed that it closes with now.
    pub(super) fn closing_too_fast(&self, dt: f64, origin: &Vector) -> Option<MortarError> {
        self.pairs.iter().find_map(|pair| {
            let ClosingRate {
                vertex,
                speed,
                allowed,
            } = pair.closing;
            // Round-off must not refuse a step that was chosen to be exactly this long.
            (speed * dt > allowed * (1.0 + 1e-9)).then(|| {
                let [slave, master] = [pair.slave, pair.master].map(|s| &self.surfaces[s]);
                let at = |v: usize| (v, in_scene(&slave.boundary.points()[v], origin));
                MortarError::ClosingTooFast {
                    bodies: [master.id, slave.id],
                    vertex: vertex.map(at),
                    approach: speed * dt,
                    allowed,
                }
            })
        })
    }

    /// Time step in which no gap closes too far \[s\].
    pub(super) fn closing_step(&self) -> f64 {
        let pairs = self.pairs.iter();
        pairs
            .map(|pair| pair.closing.time_step())
            .fold(f64::INFINITY, f64::min)
    }

    /// Number of sites under pressure.
    pub(super) fn under_pressure(&self) -> usize {
        let sites = self.pairs.iter().flat_map(|p| &p.forces.sites);
        sites.flatten().filter(|v| v.pressure > 0.0).count()
    }

    /// Adds the contact forces to the nodes (eq. 56), and what of them turns and stretches the bodies.
    pub(super) fn load_nodes(&mut self, grid: &mut Grid, mirrors: &Mirrors) {
        for surface in &mut self.surfaces {
            let BoundaryCarrier::Body { index, follow } = surface.carrier else {
                continue;
            };
            let number = grid.number_of(index);
            let shape = &grid.shape;
            let lines = grid.fields[number].nodes.lines_mut();
            // A plane of symmetry, which holds a vertex, bears what would take it off.
            let held = |(vertex, force)| surface.boundary.held(vertex, force);
            let forces = &mut surface.held;
            forces.clear();
            forces.extend(surface.force.iter().copied().enumerate().map(held));
            for (patch, force) in surface.patches.iter().zip(&*forces) {
                if force.iter().all(|f| *f == 0.0) {
                    continue;
                }
                for k in 0..N {
                    let w = patch.weights.weights[k];
                    if w > 0.0 {
                        let line = &mut lines[patch.nodes[k]];
                        for axis in 0..D {
                            line[4 + axis] += w * force[axis];
                        }
                    }
                }
            }
            if let Some(tied) = surface.tied.as_mut().filter(|_| stays(&surface.carrier)) {
                tied.load(lines, forces, shape, mirrors);
            }
            if let Some(around) = &mut surface.around {
                around.load(
                    lines,
                    &surface.patches,
                    forces,
                    follow,
                    (shape, mirrors),
                    &grid.team,
                );
            }
        }
    }

    /// Power of the contact forces that prescribed boundaries exert, with their velocities at a time \[W\].
    pub(super) fn power_of_prescribed(&self, half_step: f64) -> f64 {
        let mut power = 0.0;
        for surface in &self.surfaces {
            if let BoundaryCarrier::Prescribed(motion @ Some(_)) = &surface.carrier {
                let v: PointIn<D> = velocity_of(motion.as_ref(), half_step);
                let sum: PointIn<D> = surface.force.iter().sum();
                power -= sum.dot(&v);
            }
        }
        power
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30); prescribed velocities are those at `half_step`.
    pub(super) fn advance(&mut self, view: &StepView<'_>, drift: &Drift, half_step: f64) {
        let time = drift.time;
        // Positions are relative to the mesh, and what lies in one of its planes goes with it.
        let mesh: Option<PointIn<D>> =
            (drift.mesh_shift != [0.0; 3]).then(|| from_vector(&drift.mesh_shift));
        let (shape, mirrors) = (&view.grid.shape, Mirrors::of(view.settings));
        let cell = PointIn::from_fn(|axis, _| shape.cell[axis]);
        for surface in &mut self.surfaces {
            match &surface.carrier {
                BoundaryCarrier::Prescribed(motion) => {
                    let v: PointIn<D> = velocity_of(motion.as_ref(), half_step);
                    surface.moved.fill(v * time);
                }
                BoundaryCarrier::Body { index, follow } => {
                    let Some(field) = view.grid.own_field(*index) else {
                        continue;
                    };
                    let lines = field.nodes.lines();
                    let team = &view.grid.team;
                    if stays(&surface.carrier) {
                        surface.move_with_ties(lines, drift, team);
                        surface.advance(&drift.mesh_shift);
                        continue;
                    }
                    if let Some(around) = &mut surface.around {
                        around.find_gradients(
                            lines,
                            *follow,
                            (shape, &mirrors),
                            team,
                            &mut self.sums,
                        );
                    }
                    let around = surface.around.as_ref();
                    let moved = |vertex: usize| {
                        let patch = &surface.patches[vertex];
                        let mut v = patch.velocity(lines);
                        if let Some(around) = around {
                            for (node, distance) in patch.carried(&cell) {
                                v += around.gradient_at(node) * distance;
                            }
                        }
                        match &mesh {
                            None => surface.boundary.held(vertex, v) * time,
                            Some(mesh) => surface.boundary.held(vertex, v * time - mesh) + mesh,
                        }
                    };
                    team.fill(
                        0..surface.patches.len(),
                        ItemCost::Search,
                        moved,
                        &PointIn::zeros(),
                        &mut surface.moved,
                    );
                }
            }
            surface.advance(&drift.mesh_shift);
        }
    }
}
