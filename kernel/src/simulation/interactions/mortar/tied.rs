//! Vertices that stay on the material: they are where the particles that they are tied to say, and what acts on them acts
//! on these particles' nodes.
//!
//! With x_v = X_v + sum_p w_p (x_p - X_p) and v_p = sum_I S_Ip v_I a vertex moves with sum_I (sum_p w_p S_Ip) v_I, and node I
//! takes the force sum_v (sum_p w_p S_Ip) f_v: the transpose, so that forces do the same work at vertices and nodes, and
//! since the weights reproduce affine fields, neither force nor moment is lost. Liang et al. 2024 integrate velocities
//! instead (eq. 29, 30).

use super::boundaries::Boundaries;
use super::mirrors::Mirrors;
use super::reach::{Reach, StencilNode, stencil_nodes};
use super::surface::{Carrier, Surface, force_at, from_vector, in_scene, velocity_at};
use super::ties::Ties;
use crate::grid::{GridShape, Line};
use crate::mortar::PointIn;
use crate::mortar::bound::NodalStiffness;
use crate::mortar::elements::Elements;
use crate::mortar::motion::Follow;
use crate::particles::ParticleSet;
use crate::scene::Vector;
use crate::simulation::error::{SetupError, StepErrorKind};
use crate::simulation::{Simulation, Way};
use crate::team::{OfItem, Team};
use std::ops::Range;
use std::sync::Arc;

/// The ties of a boundary, and where what they tie is now.
#[derive(Clone, Debug)]
pub(super) struct Tied<const D: usize> {
    ties: Arc<Ties<D>>,
    /// Where the tied particles are in their set.
    places: Vec<Option<usize>>,
    /// What they reach, as of the last mapping; empty where vertices follow otherwise.
    reached: Vec<Reach<D>>,
    /// Nodes of the stencil.
    stencil: Vec<StencilNode<D>>,
    /// Memory of [`Tied::stiffen`]: the place of each node of the grid in its lists, plus one; zero between two calls.
    slots: Vec<u32>,
    lists: Lists<D>,
}

/// Lists that are filled again in each step.
#[derive(Clone, Debug, Default)]
struct Lists<const D: usize> {
    /// Displacements, then velocities of the particles, and their accelerations.
    of_particles: [Vec<PointIn<D>>; 2],
    /// Both as they are found.
    found: Vec<[PointIn<D>; 2]>,
    /// Displacements of the vertices.
    ways: Vec<PointIn<D>>,
    stiffness: Stiffness<D>,
}

/// Those of [`Tied::stiffen`].
#[derive(Clone, Debug, Default)]
struct Stiffness<const D: usize> {
    /// The nodes that pressed vertices reach, and the weights of one vertex on them.
    reached: Vec<usize>,
    weights: Vec<PointIn<D>>,
    /// Which of them one vertex has.
    touched: Vec<usize>,
    /// The sizes of the weights of each pressed vertex, by the places of the nodes.
    sizes: Vec<(usize, f64)>,
    pressed: Vec<(f64, Range<usize>)>,
    once: Vec<f64>,
    twice: Vec<f64>,
}

impl<const D: usize> Tied<D> {
    pub(super) fn new(ties: Ties<D>) -> Self {
        Self {
            ties: Arc::new(ties),
            places: vec![],
            reached: vec![],
            stencil: vec![],
            slots: vec![],
            lists: Lists::default(),
        }
    }

    /// Finds what tied particles have of two nodal values, which are asked for the node inside the mesh.
    fn gather(
        &self,
        lists: &mut Lists<D>,
        shape: &GridShape,
        mirrors: &Mirrors,
        team: &Team,
        values: impl Fn(usize) -> [PointIn<D>; 2] + Send + Sync,
    ) {
        let of = |number: usize| {
            let reach = &self.reached[number];
            let mut sums = [PointIn::zeros(); 2];
            for node in &self.stencil {
                let weight = reach.weight(node);
                if weight == 0.0 {
                    continue;
                }
                let (inside, _) = reach.inside(node, shape, mirrors);
                let signs = reach.prescribed(node, shape, mirrors) * weight;
                for (sum, value) in sums.iter_mut().zip(values(inside)) {
                    *sum += signs.component_mul(&value);
                }
            }
            sums
        };
        let Lists {
            of_particles,
            found,
            ..
        } = lists;
        team.fill(
            0..self.reached.len(),
            OfItem::Search,
            of,
            &[PointIn::zeros(); 2],
            found,
        );
        for (k, list) in of_particles.iter_mut().enumerate() {
            list.clear();
            list.extend(found.iter().map(|sums| sums[k]));
        }
    }

    /// Adds forces on the vertices \[N\] to those on the nodes.
    pub(super) fn load(
        &mut self,
        lines: &mut [Line],
        forces: &[PointIn<D>],
        shape: &GridShape,
        mirrors: &Mirrors,
    ) {
        if forces.iter().flatten().all(|f| *f == 0.0) {
            return;
        }
        let none = PointIn::<D>::zeros();
        let [on_particles, _] = &mut self.lists.of_particles;
        on_particles.clear();
        on_particles.resize(self.ties.particles(), none);
        for (vertex, force) in forces.iter().enumerate().filter(|(_, f)| **f != none) {
            self.ties.spread(vertex, force, on_particles);
        }
        for (reach, force) in self.reached.iter().zip(&*on_particles) {
            if *force == none {
                continue;
            }
            for node in &self.stencil {
                let weight = reach.weight(node);
                if weight == 0.0 {
                    continue;
                }
                let (inside, _) = reach.inside(node, shape, mirrors);
                let signs = reach.prescribed(node, shape, mirrors);
                for axis in 0..D {
                    lines[inside][4 + axis] += weight * signs[axis] * force[axis];
                }
            }
        }
    }

    /// Adds stiffnesses of the contact at vertices \[N/m\] to those of the nodes, all of one boundary at once.
    ///
    /// Bounds omega² of M^-1 sum_v K_v w_v w_v^T by its rows, as [`bound`](crate::mortar::bound) does, but for weights of
    /// either sign, and sharper: with B of the sizes of the entries, max_I (B x)_I/x_I is a bound for every x > 0 (Collatz),
    /// and x = B 1 is nearer to the mode than 1, since light nodes move more.
    pub(super) fn stiffen(
        &mut self,
        nodes: &mut NodalStiffness,
        stiffness: &[f64],
        lines: &[Line],
        shape: &GridShape,
        mirrors: &Mirrors,
    ) {
        let none = PointIn::<D>::zeros();
        self.slots.resize(lines.len(), 0);
        let Stiffness {
            reached,
            weights,
            touched,
            sizes,
            pressed,
            once,
            twice,
        } = &mut self.lists.stiffness;
        reached.clear();
        weights.clear();
        sizes.clear();
        pressed.clear();
        for (vertex, k) in stiffness.iter().enumerate().filter(|(_, k)| **k != 0.0) {
            touched.clear();
            for tie in self.ties.of(vertex) {
                let reach = &self.reached[tie.particle];
                for node in &self.stencil {
                    let weight = reach.weight(node);
                    if weight == 0.0 {
                        continue;
                    }
                    let (inside, _) = reach.inside(node, shape, mirrors);
                    let signs = reach.prescribed(node, shape, mirrors) * weight;
                    if self.slots[inside] == 0 {
                        reached.push(inside);
                        weights.push(none);
                        self.slots[inside] = reached.len() as u32;
                    }
                    let at = self.slots[inside] as usize - 1;
                    if weights[at] == none {
                        touched.push(at);
                    }
                    weights[at] += signs.component_mul(&tie.weights);
                }
            }
            let first = sizes.len();
            for &at in &*touched {
                // Twice in the list, a node has nothing left the second time.
                let weight = std::mem::replace(&mut weights[at], none).amax();
                sizes.push((at, weight));
            }
            pressed.push((*k, first..sizes.len()));
        }
        let product = |x: &[f64], sums: &mut Vec<f64>| {
            sums.clear();
            sums.resize(reached.len(), 0.0);
            for (k, range) in &*pressed {
                let sizes = &sizes[range.clone()];
                let along: f64 = sizes.iter().map(|(at, w)| w * x[*at]).sum();
                for (at, w) in sizes {
                    sums[*at] += k * w * along / lines[reached[*at]][0];
                }
            }
        };
        twice.clear();
        twice.resize(reached.len(), 1.0);
        product(twice, once);
        product(once, twice);
        for ((node, x), y) in reached.iter().zip(&*once).zip(&*twice) {
            if *x > 0.0 {
                nodes.add_at(*node, y / x, 1.0);
            }
            self.slots[*node] = 0;
        }
    }

    /// Displacements of all vertices by those of the particles \[m\]; NaN where too few of these are left.
    fn displacements(&self, set: &ParticleSet) -> Vec<PointIn<D>> {
        let mut places = self.places.clone();
        self.ties.find(set, &mut places);
        let mut displacements = vec![];
        self.ties.displacements(set, &places, &mut displacements);
        let of = |vertex: usize| match self.ties.of(vertex) {
            [] => PointIn::repeat(f64::NAN),
            _ => self.ties.sum(vertex, &displacements),
        };
        (0..self.ties.vertices()).map(of).collect()
    }
}

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Ties the vertices of all bodies to their particles, once, at the start.
    pub(super) fn tie(&mut self, hosts: &Simulation) {
        let mirrors = Mirrors::of(&hosts.decided.scene);
        for surface in self.surfaces.iter_mut().filter(|s| s.tied.is_none()) {
            let bodies = &hosts.decided.bodies;
            if let Some(index) = bodies.iter().position(|body| body.id == surface.id) {
                let own = (&hosts.state.sets[index], &bodies[index]);
                surface.tied = Some(Tied::new(Ties::new(&surface.start, own, &mirrors)));
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
                return Err(SetupError::Mortar {
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
    pub(super) fn farthest_off(&self, simulation: &Simulation) -> Option<(i64, usize, f64)> {
        let bodies = self.surfaces.iter().filter_map(|surface| {
            let set = &simulation.sets()[surface.body()?];
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

/// Whether vertices carried so stay on the material.
pub(super) fn stays(carrier: &Carrier) -> bool {
    let Carrier::Body { follow, .. } = carrier else {
        return false;
    };
    *follow == Follow::Material
}

impl<B, const D: usize, const N: usize> Surface<B, D, N> {
    /// The ties, where vertices stay on the material.
    pub(super) fn anchor(&self) -> Option<&Tied<D>> {
        self.tied.as_ref().filter(|_| stays(&self.carrier))
    }

    /// Has the vertices where the material is; finds what their particles reach, their velocities, and by how much these
    /// change by `kick` \[s\] where nothing touches them.
    ///
    /// # Errors
    /// The first vertex without particles that span all directions around it.
    pub(super) fn weigh_tied<const T: usize>(
        &mut self,
        index: usize,
        hosts: &Simulation,
        kick: f64,
    ) -> Result<(), StepErrorKind>
    where
        B: Elements<D, T>,
    {
        let Some(tied) = &mut self.tied else {
            return Ok(());
        };
        let Some(field) = hosts.work.grid.own_field(index) else {
            return Ok(());
        };
        let (set, body) = (&hosts.state.sets[index], &hosts.decided.bodies[index]);
        let (shape, team) = (&hosts.work.grid.shape, &hosts.work.grid.team);
        let mirrors = Mirrors::of(&hosts.decided.scene);
        tied.ties.find(set, &mut tied.places);
        let mut lists = std::mem::take(&mut tied.lists);
        let [displacements, _] = &mut lists.of_particles;
        tied.ties.displacements(set, &tied.places, displacements);
        let boundary = &self.boundary;
        let of = |vertex: usize| boundary.held(vertex, tied.ties.sum(vertex, displacements));
        team.fill(
            0..self.start.len(),
            OfItem::Search,
            of,
            &PointIn::zeros(),
            &mut lists.ways,
        );
        for (vertex, way) in lists.ways.iter().enumerate() {
            // Particles that were removed have no place.
            if way.iter().any(|x| x.is_nan()) {
                return Err(StepErrorKind::VertexLost {
                    body: self.id,
                    vertex,
                    position: in_scene(&self.boundary.points()[vertex], &hosts.origin()),
                });
            }
        }
        let places = self.boundary.points_mut().iter_mut().zip(&self.start);
        for ((x, start), way) in places.zip(&lists.ways) {
            *x = start + way;
        }
        let stencil = hosts.state.stencil;
        if tied.stencil.len() != stencil.pow(D as u32) {
            tied.stencil = stencil_nodes(stencil, shape);
        }
        let places = &tied.places;
        let reach = |number: usize| {
            // Those that were removed are of no vertex that is left.
            let p = places[number].unwrap_or(0);
            Reach::of((set, p), &body.mapping, shape, &mirrors, stencil)
        };
        team.fill(
            0..places.len(),
            OfItem::Search,
            reach,
            &Reach::NOWHERE,
            &mut tied.reached,
        );
        let gravity: PointIn<D> = from_vector(&hosts.decided.scene.gravity);
        let lines = field.nodes.lines();
        // A plane that is fixed to a moving base mirrors velocities relative to it.
        let base = hosts.decided.base.as_ref();
        let base: PointIn<D> = base.map_or_else(PointIn::zeros, |base| {
            from_vector(&base.at(hosts.state.clock.time))
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
            OfItem::Search,
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
    pub(super) fn move_with_ties<const T: usize>(&mut self, lines: &[Line], way: &Way, team: &Team)
    where
        B: Elements<D, T>,
    {
        let Some(tied) = &mut self.tied else {
            return;
        };
        // Ghosts are filled by now.
        let mesh: PointIn<D> = from_vector(&way.mesh_shift);
        let of = |number: usize| {
            let reach = &tied.reached[number];
            let mut v = PointIn::zeros();
            for node in &tied.stencil {
                v += reach.weight(node) * velocity_at::<D>(&lines[reach.node(node)]);
            }
            v * way.time - mesh
        };
        let [ways, _] = &mut tied.lists.of_particles;
        team.fill(
            0..tied.reached.len(),
            OfItem::Search,
            of,
            &PointIn::zeros(),
            ways,
        );
        let (boundary, ties) = (&self.boundary, &tied.ties);
        let moved = |vertex: usize| boundary.held(vertex, ties.sum(vertex, ways)) + mesh;
        team.fill(
            0..self.start.len(),
            OfItem::Search,
            moved,
            &PointIn::zeros(),
            &mut self.moved,
        );
    }
}
