//! Vertices of mortar contact, for output.

use super::MortarState;
use super::boundaries::Boundaries;
use super::patch::{in_scene, to_vector};
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::pair::{PairForces, VertexContact};
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::StepView;

/// Contact state of a slave at a vertex, or on one side of a sharp corner, for output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexState {
    /// Position in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Outward normal; zero where nothing is faced.
    pub normal: Vector,
    /// Weighted gap \[m\]; infinite where nothing is faced.
    pub gap: f64,
    /// Contact pressure \[Pa\].
    pub pressure: f64,
    /// Tangential traction \[Pa\]: in two dimensions with its sign along the normal turned by +90 degrees, in three its
    /// size.
    pub traction: f64,
    /// Length, in three dimensions area, that belongs to the vertex \[m, m²\].
    pub measure: f64,
}

/// A vertex of a boundary, or of a rigid line or surface, for output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryVertex {
    /// Identifier of the body, line or surface.
    pub id: i64,
    /// Number of the vertex in its boundary, from 0.
    pub vertex: i64,
    /// Position in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Displacement since the start \[m\].
    pub displacement: Vector,
    /// Contact pressure \[Pa\]; zero where the vertex is no slave.
    pub pressure: f64,
    /// Smallest weighted gap \[m\]; NaN where the vertex is no slave or faces nothing.
    pub gap: f64,
    /// Contact traction on the vertex, normal and tangential \[Pa\]; zero where it is no slave.
    pub traction: Vector,
    /// Contact force on the vertex \[N\]; in two dimensions per thickness \[N/m\].
    pub force: Vector,
}

/// The vertices of boundaries, and the edges between them, for output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryMesh {
    /// Vertices, boundary after boundary.
    pub vertices: Vec<BoundaryVertex>,
    /// Segments or edges of triangles, each once, by the places of their two vertices.
    pub edges: Vec<[usize; 2]>,
}

/// The drift of a vertex off its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryDrift {
    /// Identifier of the body.
    pub body: i64,
    /// Number of the vertex in the boundary, from 0.
    pub vertex: usize,
    /// Distance from where the material says that the vertex is \[m\].
    pub distance: f64,
    /// The same over the smallest size of a cell.
    pub in_cells: f64,
}

impl MortarState {
    /// The vertex that drifted farthest off its body, of those of bodies that move freely; `None` where there is none.
    ///
    /// Place of a vertex in the material, from the particles that were around it at the start, by weights that reproduce every
    /// affine field ([`affine_weights`](crate::geometry::mortar::tie::affine_weights)): in a rigid motion, rotations included,
    /// and in a uniform strain, however large, a vertex that goes with its body has no drift. Where the strain varies, that
    /// place is known up to the second order in the size of a cell.
    #[must_use]
    pub fn boundary_drift(&self, view: &StepView<'_>) -> Option<BoundaryDrift> {
        let h = view.smallest_cell();
        let found = [self.plane.farthest_off(view), self.space.farthest_off(view)];
        let found = found.into_iter().flatten().next();
        found.map(|(body, vertex, distance)| BoundaryDrift {
            body,
            vertex,
            distance,
            in_cells: distance / h,
        })
    }

    /// The vertices of all boundaries, rigid lines and rigid surfaces, and the edges between them. Contact is as of the last
    /// detection.
    #[must_use]
    pub fn boundaries(&self, origin: &Vector) -> BoundaryMesh {
        let mut mesh = BoundaryMesh::default();
        self.plane.add_to_mesh(origin, &mut mesh);
        self.space.add_to_mesh(origin, &mut mesh);
        mesh
    }

    /// Vertices of the slave of a mortar contact as of the last detection, in order of the polyline or surface. A sharp
    /// corner is in the list once for each of its sides, the others after all vertices.
    #[must_use]
    pub fn vertices(&self, contact: i64, origin: &Vector) -> Option<Vec<VertexState>> {
        let in_plane = self.plane.vertices(contact, origin, |[t]| t);
        in_plane.or_else(|| {
            let of = |[s, t]: [f64; 2]| libm::hypot(s, t);
            self.space.vertices(contact, origin, of)
        })
    }

    /// Vertices of the boundary of a body, or of a rigid line or surface, in the coordinates of the scene \[m\].
    #[must_use]
    pub fn boundary_vertices(&self, id: i64, origin: &Vector) -> Option<Vec<Vector>> {
        let in_space = || self.space.positions(id, origin);
        self.plane.positions(id, origin).or_else(in_space)
    }

    /// Mortar contact force on the vertices of a body, or of a rigid line or surface, in the last step \[N\].
    #[must_use]
    pub fn force_on(&self, id: i64) -> Option<Vector> {
        self.plane.force_on(id).or_else(|| self.space.force_on(id))
    }
}

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    fn vertices(
        &self,
        contact: i64,
        origin: &Vector,
        traction: impl Fn([f64; T]) -> f64,
    ) -> Option<Vec<VertexState>> {
        let pair = self.pairs.iter().find(|p| p.id == contact)?;
        let boundary = &self.surfaces[pair.slave].boundary;
        let states = boundary.sites().vertices().iter().enumerate();
        let states = states.map(|(site, vertex)| {
            let x = &boundary.points()[*vertex];
            let seen = pair.forces.sites.get(site).copied().flatten();
            VertexState {
                position: in_scene(x, origin),
                normal: seen.map_or([0.0; 3], |v| to_vector(&v.normal)),
                gap: seen.map_or(f64::INFINITY, |v| v.gap),
                pressure: seen.map_or(0.0, |v| v.pressure),
                traction: seen.map_or(0.0, |v| traction(v.traction)),
                measure: seen.map_or(0.0, |v| v.measure),
            }
        });
        Some(states.collect())
    }

    fn add_to_mesh(&self, origin: &Vector, mesh: &mut BoundaryMesh) {
        let BoundaryMesh { vertices, edges } = mesh;
        for (s, surface) in self.surfaces.iter().enumerate() {
            let first = vertices.len();
            let boundary = &surface.boundary;
            let mut own: Vec<[usize; 2]> = boundary
                .elements()
                .iter()
                .flat_map(|element| {
                    // A segment has one edge, a triangle three.
                    (0..if D == 2 { 1 } else { D }).map(|k| [element[k], element[(k + 1) % D]])
                })
                .collect();
            if D == 3 {
                for edge in &mut own {
                    edge.sort_unstable();
                }
                own.sort_unstable();
                own.dedup();
            }
            edges.extend(own.iter().map(|edge| edge.map(|k| first + k)));
            let loudest: Vec<_> = self
                .pairs
                .iter()
                .filter(|pair| pair.slave == s)
                .map(|pair| loudest(&pair.forces, boundary.points().len()))
                .collect();
            for (k, x) in boundary.points().iter().enumerate() {
                let (mut pressure, mut gap) = (0.0, f64::NAN);
                let mut traction = PointIn::<D>::zeros();
                for (site, v) in loudest.iter().filter_map(|of_pair| of_pair[k]) {
                    pressure += v.pressure;
                    gap = v.gap.min(gap);
                    traction -= v.pressure * v.normal;
                    for (tangent, t) in boundary.tangents(site, &v.normal).iter().zip(v.traction) {
                        traction -= t * tangent;
                    }
                }
                vertices.push(BoundaryVertex {
                    id: surface.id,
                    vertex: k as i64,
                    position: in_scene(x, origin),
                    displacement: to_vector(&(x - surface.start[k])),
                    pressure,
                    gap,
                    traction: to_vector(&traction),
                    force: to_vector(&surface.force[k]),
                });
            }
        }
    }

    fn positions(&self, id: i64, origin: &Vector) -> Option<Vec<Vector>> {
        let surface = self.surfaces.iter().find(|s| s.id == id)?;
        let points = surface.boundary.points().iter();
        Some(points.map(|x| in_scene(x, origin)).collect())
    }

    fn force_on(&self, id: i64) -> Option<Vector> {
        let surface = self.surfaces.iter().find(|s| s.id == id)?;
        Some(to_vector(&surface.force.iter().sum()))
    }

    pub(super) fn energy(&self) -> f64 {
        self.pairs.iter().map(|p| p.forces.energy).sum()
    }
}

/// Site of each vertex of a slave that decides for it, with its gap and pressure: of the sides of a corner the one that is
/// pressed most.
fn loudest<const D: usize, const T: usize>(
    forces: &PairForces<D, T>,
    vertices: usize,
) -> Vec<Option<(usize, &VertexContact<D, T>)>> {
    let mut of_vertices = vec![None; vertices];
    for (site, seen) in forces.sites.iter().enumerate() {
        if let Some(seen) = seen {
            let known: &mut Option<(usize, &VertexContact<D, T>)> = &mut of_vertices[seen.vertex];
            if known.is_none_or(|(_, known)| seen.pressure > known.pressure) {
                *known = Some((site, seen));
            }
        }
    }
    of_vertices
}
