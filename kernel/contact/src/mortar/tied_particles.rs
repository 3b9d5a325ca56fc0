//! Vertices that stay on the material: they are where the particles that they are tied to say, and what acts on them acts
//! on these particles' nodes.
//!
//! With x_v = X_v + sum_p w_p (x_p - X_p) and v_p = sum_I S_Ip v_I a vertex moves with sum_I (sum_p w_p S_Ip) v_I, and node I
//! takes the force sum_v (sum_p w_p S_Ip) f_v: the transpose, so that forces do the same work at vertices and nodes, and
//! since the weights reproduce affine fields, neither force nor moment is lost. Liang et al. 2024 integrate velocities
//! instead (eq. 29, 30).

use super::mirrors::Mirrors;
use super::stencil_reach::{StencilNode, StencilReach};
use super::vertex_ties::VertexTies;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::bound::NodalStiffness;
use proctor_geometry::team::{ItemCost, Team};
use proctor_kernel::grid::{GridShape, Line};
use proctor_kernel::particles::ParticleSet;
use std::ops::Range;
use std::sync::Arc;

/// The ties of a boundary, and where what they tie is now.
#[derive(Clone, Debug)]
pub(super) struct TiedParticles<const D: usize> {
    pub(super) ties: Arc<VertexTies<D>>,
    /// Places of the tied particles in their set.
    pub(super) places: Vec<Option<usize>>,
    /// Nodes that they reach, as of the last mapping; empty where vertices follow otherwise.
    pub(super) reached: Vec<StencilReach<D>>,
    /// Nodes of the stencil.
    pub(super) stencil: Vec<StencilNode<D>>,
    /// Memory of [`TiedParticles::stiffen`]: the place of each node of the grid in its lists, plus one; zero between two calls.
    pub(super) slots: Vec<u32>,
    pub(super) lists: TieLists<D>,
}

/// Lists that are filled again in each step.
#[derive(Clone, Debug, Default)]
pub(super) struct TieLists<const D: usize> {
    /// Displacements, then velocities of the particles, and their accelerations.
    pub(super) of_particles: [Vec<PointIn<D>>; 2],
    /// Both as they are found.
    pub(super) found: Vec<[PointIn<D>; 2]>,
    /// Displacements of the vertices.
    pub(super) ways: Vec<PointIn<D>>,
    pub(super) stiffness: Stiffness<D>,
}

/// Memory of [`TiedParticles::stiffen`].
#[derive(Clone, Debug, Default)]
pub(super) struct Stiffness<const D: usize> {
    /// The nodes that pressed vertices reach, and the weights of one vertex on them.
    pub(super) reached: Vec<usize>,
    pub(super) weights: Vec<PointIn<D>>,
    /// Nodes of one vertex.
    pub(super) touched: Vec<usize>,
    /// The sizes of the weights of each pressed vertex, by the places of the nodes.
    pub(super) sizes: Vec<(usize, f64)>,
    pub(super) pressed: Vec<(f64, Range<usize>)>,
    pub(super) once: Vec<f64>,
    pub(super) twice: Vec<f64>,
}

impl<const D: usize> TiedParticles<D> {
    pub(super) fn new(ties: VertexTies<D>) -> Self {
        Self {
            ties: Arc::new(ties),
            places: vec![],
            reached: vec![],
            stencil: vec![],
            slots: vec![],
            lists: TieLists::default(),
        }
    }

    /// Finds what tied particles have of two nodal values, which are asked for the node inside the mesh.
    pub(super) fn gather(
        &self,
        lists: &mut TieLists<D>,
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
        let TieLists {
            of_particles,
            found,
            ..
        } = lists;
        team.fill(
            0..self.reached.len(),
            ItemCost::Search,
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
    /// Bounds omega² of M^-1 sum_v K_v w_v w_v^T by its rows, as [`bound`](crate::geometry::mortar::bound) does, but for weights of
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
    pub(super) fn displacements(&self, set: &ParticleSet) -> Vec<PointIn<D>> {
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
