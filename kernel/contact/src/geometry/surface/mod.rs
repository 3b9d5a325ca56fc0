//! Rigid surfaces made of triangles: checks, and the search for the nearest triangle.
//!
//! A surface has two sides. Its outside is where the normals of its triangles point, (b - a) x (c - a) for corners
//! a, b, c as they are listed.
//!
//! The tree is our own: a library of collision shapes would bring a second algebra into a kernel that depends on nalgebra
//! and rayon alone, for the two hundred lines of `tree`.

mod error;
mod nearest;
mod topology;
mod tree;

pub use error::{SurfaceError, SurfaceErrorKind};
pub use nearest::{Feature, NearestPoint};
pub use topology::OpenEdges;

use proctor_kernel::number::fingerprint_of;
use std::fmt;
use tree::Tree;

/// A point or a vector \[m\].
pub type Point = [f64; 3];

/// A checked surface that can be searched.
#[derive(Clone)]
pub struct Surface {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    /// Unit normal of each triangle.
    normals: Vec<Point>,
    /// Unit pseudo-normal of the three edges of each triangle; edge i runs from corner i to corner i + 1.
    edge_normals: Vec<[Point; 3]>,
    /// True if the edges belong to one triangle only.
    edge_is_open: Vec<[bool; 3]>,
    /// Unit pseudo-normal of each vertex.
    vertex_normals: Vec<Point>,
    /// True if the vertex lies on an open edge.
    vertex_is_open: Vec<bool>,
    open: Option<OpenEdges>,
    tree: Tree,
}

impl Surface {
    /// Welds corners, checks triangles and edges, and builds the tree.
    ///
    /// Corners closer than 1e-7 of the diagonal of the bounding box, the resolution of 32-bit coordinates, are one
    /// vertex. Open edges are allowed; see [`Surface::open_edges`] and [`Surface::require_closed`].
    ///
    /// # Errors
    /// No triangle, coordinates that are not finite, triangles without area, edges of more than two triangles,
    /// neighbours that are turned against each other.
    pub fn new(corners: &[[Point; 3]]) -> Result<Self, SurfaceError> {
        let topology = topology::Topology::new(corners)?;
        let tree = Tree::new(&topology.vertices, &topology.triangles);
        Ok(Self {
            vertices: topology.vertices,
            triangles: topology.triangles,
            normals: topology.normals,
            edge_normals: topology.edge_normals,
            edge_is_open: topology.edge_is_open,
            vertex_normals: topology.vertex_normals,
            vertex_is_open: topology.vertex_is_open,
            open: topology.open,
            tree,
        })
    }

    /// The same surface in coordinates that begin at `origin`. What is far from zero but near `origin` loses no digit.
    #[must_use]
    pub fn relative_to(&self, origin: &Point) -> Self {
        let mut moved = self.clone();
        for vertex in &mut moved.vertices {
            *vertex = minus(vertex, origin);
        }
        moved.tree = Tree::new(&moved.vertices, &moved.triangles);
        moved
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Number of vertices after welding.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// The vertices after welding \[m\].
    #[must_use]
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Vertices of each triangle, counter-clockwise from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Corners of a triangle, counted from 0 \[m\].
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].map(|v| self.vertices[v as usize])
    }

    /// Lower and upper corner of the box around the surface \[m\].
    #[must_use]
    pub fn bounds(&self) -> (Point, Point) {
        self.tree.bounds()
    }

    /// The edges that belong to one triangle only, if there are any.
    #[must_use]
    pub fn open_edges(&self) -> Option<&OpenEdges> {
        self.open.as_ref()
    }

    /// True if the surface encloses a body.
    ///
    /// # Errors
    /// Its open edges.
    pub fn require_closed(&self) -> Result<(), SurfaceError> {
        self.open.as_ref().map_or(Ok(()), |open| {
            Err(SurfaceErrorKind::Open {
                edges: open.count,
                triangle: open.triangle,
                edge: open.first,
            }
            .into())
        })
    }

    /// The point of the surface nearest to `x`, if one is closer than `within` \[m\]. Of triangles at the same
    /// distance the first of the file counts.
    #[must_use]
    pub fn nearest(&self, x: &Point, within: f64) -> Option<NearestPoint> {
        self.tree.nearest(self, x, within, None)
    }

    /// The same, sooner where the triangle of the nearest point is known but for a little: `guess` as in
    /// [`NearestPoint::triangle`]. Whatever is guessed, what is found has the same bits.
    ///
    /// # Panics
    /// If the surface has no such triangle.
    #[must_use]
    pub fn nearest_from(&self, guess: usize, x: &Point, within: f64) -> Option<NearestPoint> {
        self.tree.nearest(self, x, within, Some(guess))
    }

    /// The same by looking at every triangle, for tests of the tree.
    #[must_use]
    pub fn nearest_of_all(&self, x: &Point, within: f64) -> Option<NearestPoint> {
        let mut best = nearest::NearestTriangle::new(within);
        for triangle in 0..self.triangles.len() {
            best.look_at(self, triangle, x);
        }
        best.finish(self, x)
    }

    /// Hash of vertices and triangles, so that two surfaces can be told apart without printing them.
    fn fingerprint(&self) -> u64 {
        fingerprint_of(&self.vertices, &self.triangles)
    }
}

impl fmt::Debug for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Surface")
            .field("triangles", &self.triangles.len())
            .field("vertices", &self.vertices.len())
            .field("fingerprint", &self.fingerprint())
            .finish_non_exhaustive()
    }
}

fn minus(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: &Point, b: &Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Point, b: &Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(a: &Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|c| c / length)
}
