//! Faces of bodies at which rows of particles end.
//!
//! The stress behind such a face gives nodes the weights of the face. Behind a round or an oblique one particles lie in steps,
//! nodes have what the steps give them, and augmented weights, which go by the mass, are nearer to that.

use super::boundaries::Boundaries;
use super::surface::MovingBoundary;
use super::vertex_weights::VertexWeighting;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::motion::FollowMode;
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::{BodyRun, StepView};

/// Slope of an element against its axis up to which it counts as the face that it was, and up to twice as much less and less.
const FLAT: f64 = 0.03;

/// Largest distance of a face from the end of the particles, over the half-length of a particle.
const ENDS: f64 = 1e-6;

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Finds the vertices of all bodies that lie on faces of rows of particles, once, at the start.
    pub(super) fn find_faces(&mut self, view: &StepView<'_>) {
        for surface in self.surfaces.iter_mut().filter(|s| s.on_face.is_empty()) {
            // One that is moved as prescribed may be set free later.
            let bodies = view.bodies;
            if let Some(index) = bodies.iter().position(|body| body.id == surface.id) {
                surface.find_faces(&view.particles[index], &bodies[index]);
            }
        }
    }

    /// Gives the vertices that contact presses on the weights of the face, where they lie on faces of rows of particles.
    pub(super) fn press(&mut self, view: &StepView<'_>) {
        for surface in &mut self.surfaces {
            surface.pressed = false;
            let Some(follow) = surface.carrier.follow() else {
                continue;
            };
            let (Some(index), true) = (surface.body(), on_nodes(follow)) else {
                continue;
            };
            let Some(weighing) = VertexWeighting::of(view, index) else {
                continue;
            };
            surface.find_flat();
            let vertices = surface.boundary.points().iter().zip(&surface.flat);
            for ((x, share), patch) in vertices.zip(&mut surface.patches) {
                if *share > 0.0 {
                    weighing.press(x, *share, patch);
                    surface.pressed = true;
                }
            }
        }
    }
}

/// True for vertices that go by augmented weights of nodes.
fn on_nodes(follow: FollowMode) -> bool {
    !matches!(follow, FollowMode::Unaugmented | FollowMode::Material)
}

impl<B, const D: usize, const N: usize> MovingBoundary<B, D, N> {
    /// Finds the vertices all of whose elements lie across an axis where particles of the body end, at the start.
    pub(super) fn find_faces<const T: usize>(&mut self, set: &ParticleSet, body: &BodyRun)
    where
        B: Elements<D, T>,
    {
        let points = self.boundary.points();
        let close = |axis: usize| ENDS * body.particle_half_length[axis];
        let across = |element: &[usize; D]| {
            let all_at = |axis: &usize| {
                let ways = element
                    .iter()
                    .map(|v| points[*v][*axis] - points[element[0]][*axis]);
                ways.fold(0.0, |most: f64, way| most.max(way.abs())) <= close(*axis)
            };
            (0..D).find(all_at)
        };
        let elements = self.boundary.elements();
        let axes: Vec<Option<usize>> = elements.iter().map(across).collect();
        let ends: [Vec<f64>; D] = std::array::from_fn(|axis| {
            if axes.contains(&Some(axis)) {
                ends_along(set, axis, body.particle_half_length[axis])
            } else {
                vec![]
            }
        });
        let ends_at = |axis: usize, x: f64| {
            let next = ends[axis].partition_point(|end| *end < x - close(axis));
            ends[axis]
                .get(next)
                .is_some_and(|end| *end <= x + close(axis))
        };
        let mut on_face = vec![true; points.len()];
        let mut in_element = vec![false; points.len()];
        for (element, axis) in elements.iter().zip(&axes) {
            let lies = axis.is_some_and(|axis| ends_at(axis, points[element[0]][axis]));
            for vertex in element {
                on_face[*vertex] &= lies;
                in_element[*vertex] = true;
            }
        }
        for (on_face, in_element) in on_face.iter_mut().zip(in_element) {
            *on_face &= in_element;
        }
        let faces = elements.iter().zip(axes).enumerate();
        let faces = faces.filter(|(_, (vertices, _))| vertices.iter().any(|v| on_face[*v]));
        self.faces = faces
            .filter_map(|(e, (_, axis))| Some((e, axis?)))
            .collect();
        self.on_face = on_face;
    }

    /// Finds how much of the weights of the face each vertex has: all where contact presses on a face that is as flat as it was,
    /// none where it does not, or where the face was turned or bent.
    fn find_flat<const T: usize>(&mut self)
    where
        B: Elements<D, T>,
    {
        let none = PointIn::<D>::zeros();
        let pressed = |(on_face, force): (&bool, &PointIn<D>)| *on_face && *force != none;
        self.flat.clear();
        let vertices = self.on_face.iter().zip(&self.force);
        self.flat
            .extend(vertices.map(|v| f64::from(u8::from(pressed(v)))));
        let (points, elements) = (self.boundary.points(), self.boundary.elements());
        for &(element, axis) in &self.faces {
            let vertices = &elements[element];
            if vertices.iter().all(|v| self.flat[*v] == 0.0) {
                continue;
            }
            let first = points[vertices[0]];
            let slope = vertices[1..].iter().fold(0.0_f64, |most, v| {
                let edge = points[*v] - first;
                most.max(edge[axis].powi(2) / edge.norm_squared())
            });
            let share = (2.0 - slope.sqrt() / FLAT).clamp(0.0, 1.0);
            for v in vertices {
                self.flat[*v] = self.flat[*v].min(share);
            }
        }
    }
}

/// Ends of the particles along an axis, in order \[m\].
fn ends_along(set: &ParticleSet, axis: usize, half_length: f64) -> Vec<f64> {
    let places = set.columns[Layout::POSITION + axis][..set.len()].iter();
    let mut ends: Vec<f64> = places
        .flat_map(|x| [x - half_length, x + half_length])
        .collect();
    ends.sort_unstable_by(f64::total_cmp);
    ends.dedup();
    ends
}
