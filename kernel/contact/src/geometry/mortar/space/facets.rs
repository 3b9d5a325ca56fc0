//! Triangulated boundaries of bodies.

use super::Point;
use super::projection::{points_of_triangle, points_of_vertices};
use super::ridges::crossing;
use crate::geometry::mortar::broad::NearElements;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::points::{Cuts, MasterSearch, MortarPoint};
use crate::geometry::mortar::sites::{SHARP, Sites};
use crate::geometry::surface::{Surface, SurfaceError};
use std::fmt;

/// Share of the size of a boundary within which a vertex lies in a plane.
const IN_PLANE: f64 = 1.0e-9;

/// Fault of triangles as the boundary of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum FacetsError {
    /// Triangles that are no surface.
    Surface(SurfaceError),
    /// The normals of a closed surface point inwards.
    InsideOut {
        /// Enclosed volume, negative \[m³\].
        volume: f64,
    },
    /// All triangles lie in planes of which nothing can be touched.
    Nothing,
}

impl fmt::Display for FacetsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Surface(error) => write!(f, "{error}"),
            Self::InsideOut { volume } => write!(
                f,
                "the triangles enclose {volume} m3; their normals must point out of the body, which makes it positive"
            ),
            Self::Nothing => write!(f, "all triangles lie in boundary planes of the mesh"),
        }
    }
}

impl std::error::Error for FacetsError {}

/// A convex sharp edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ridge {
    /// Its two vertices.
    pub vertices: [usize; 2],
    /// The triangles on both sides of it.
    pub triangles: [usize; 2],
}

/// Checked triangles of one body. Vertices move; how they are joined never changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Facets {
    /// Positions of the vertices \[m\].
    pub points: Vec<Point>,
    triangles: Vec<[usize; 3]>,
    /// Sites of the normals.
    sites: Sites<3>,
    /// Neighbour of each site in whose direction its first tangent points.
    beside: Vec<usize>,
    /// Axes along which each vertex has a mirror image, so that its normal has no component there.
    mirrored: Vec<[bool; 3]>,
    ridges: Vec<Ridge>,
}

impl Facets {
    /// Triangles of a surface, which is checked already. A closed one must have its normals outside.
    ///
    /// # Errors
    /// A closed surface whose normals point inwards.
    pub fn new(surface: &Surface) -> Result<Self, FacetsError> {
        let points: Vec<Point> = surface.vertices().iter().map(|x| Point::from(*x)).collect();
        let triangles = surface.triangles().iter();
        let facets = Self::join(points, triangles.map(|t| t.map(|v| v as usize)).collect());
        let volume = facets.volume();
        if surface.open_edges().is_none() && volume <= 0.0 {
            return Err(FacetsError::InsideOut { volume });
        }
        Ok(facets)
    }

    /// The same from the corners of the triangles \[m\]; corners at the same place are joined.
    ///
    /// # Errors
    /// All that [`Surface::new`] and [`Facets::new`] find.
    pub fn from_corners(corners: &[[[f64; 3]; 3]]) -> Result<Self, FacetsError> {
        Self::new(&Surface::new(corners).map_err(FacetsError::Surface)?)
    }

    fn join(points: Vec<Point>, triangles: Vec<[usize; 3]>) -> Self {
        let mut facets = Self {
            mirrored: vec![[false; 3]; points.len()],
            points,
            triangles,
            sites: Sites::default(),
            beside: vec![],
            ridges: vec![],
        };
        let mut smooth = vec![];
        for (vertices, triangles) in facets.edges_between() {
            let [m, n] = triangles.map(|t| facets.triangle_normal(t));
            if m.dot(&n) >= SHARP {
                smooth.push(triangles);
            } else if facets.convex(triangles) {
                facets.ridges.push(Ridge {
                    vertices,
                    triangles,
                });
            }
        }
        facets.sites = Sites::new(facets.points.len(), &facets.triangles, &smooth);
        facets.beside = vec![usize::MAX; facets.sites.vertices().len()];
        for (sites, t) in facets.sites.elements().iter().zip(&facets.triangles) {
            for k in 0..3 {
                let beside = &mut facets.beside[sites[k]];
                if *beside == usize::MAX {
                    *beside = t[(k + 1) % 3];
                }
            }
        }
        facets
    }

    /// Without the triangles in given planes, each an axis and a coordinate \[m\]: walls of the mesh and planes of
    /// symmetry, where nothing can be touched. Vertices in the planes get normals along them, as by symmetry.
    ///
    /// # Errors
    /// No triangle is left.
    pub fn without_planes(&self, planes: &[(usize, f64)]) -> Result<Self, FacetsError> {
        let size = |axis: usize| {
            let range = self.points.iter().map(|x| x[axis]);
            range.clone().fold(f64::NEG_INFINITY, f64::max) - range.fold(f64::INFINITY, f64::min)
        };
        let tolerance = IN_PLANE * (0..3).map(size).fold(0.0, f64::max);
        let inside =
            |v: usize, (axis, at): (usize, f64)| (self.points[v][axis] - at).abs() <= tolerance;
        let kept: Vec<[usize; 3]> = self
            .triangles
            .iter()
            .filter(|t| {
                !planes
                    .iter()
                    .any(|plane| t.iter().all(|v| inside(*v, *plane)))
            })
            .copied()
            .collect();
        if kept.is_empty() {
            return Err(FacetsError::Nothing);
        }
        // Vertices of removed triangles alone go too: they bound nothing.
        let mut used = vec![false; self.points.len()];
        for v in kept.iter().flatten() {
            used[*v] = true;
        }
        let mut new = vec![usize::MAX; self.points.len()];
        let mut points = vec![];
        let mut mirrored = vec![];
        for v in (0..self.points.len()).filter(|v| used[*v]) {
            new[v] = points.len();
            points.push(self.points[v]);
            let mut axes = self.mirrored[v];
            for plane in planes {
                axes[plane.0] |= inside(v, *plane);
            }
            mirrored.push(axes);
        }
        let mut facets = Self::join(points, kept.iter().map(|t| t.map(|v| new[v])).collect());
        facets.mirrored = mirrored;
        Ok(facets)
    }

    /// Vertices of each triangle, counter-clockwise from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Convex edges between triangles that turn by more than 30 degrees, as they were at the start.
    #[must_use]
    pub fn ridges(&self) -> &[Ridge] {
        &self.ridges
    }

    /// Normal of a triangle times twice its area \[m²\].
    fn spanned(&self, triangle: usize) -> Point {
        let [a, b, c] = self.triangles[triangle].map(|v| self.points[v]);
        (b - a).cross(&(c - a))
    }

    /// Outward unit normal of a triangle.
    #[must_use]
    pub fn triangle_normal(&self, triangle: usize) -> Point {
        self.spanned(triangle).normalize()
    }

    /// Length of the longest edge \[m\].
    #[must_use]
    pub fn longest_edge(&self) -> f64 {
        self.triangles
            .iter()
            .flat_map(|t| (0..3).map(|k| (self.points[t[(k + 1) % 3]] - self.points[t[k]]).norm()))
            .fold(0.0, f64::max)
    }

    /// A third of the area of the triangles at each site \[m²\].
    #[must_use]
    pub fn tributary_areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.sites.vertices().len()];
        for (triangle, sites) in self.sites.elements().iter().enumerate() {
            for site in sites {
                areas[*site] += self.spanned(triangle).norm() / 6.0;
            }
        }
        areas
    }

    /// Area of all triangles \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        (0..self.triangles.len())
            .map(|t| 0.5 * self.spanned(t).norm())
            .sum()
    }

    /// Enclosed volume \[m³\], positive with the normals outside; of an open surface that of the cone to a vertex.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let origin = self.points.first().copied().unwrap_or_default();
        self.triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| self.points[v] - origin);
                a.dot(&b.cross(&c)) / 6.0
            })
            .sum()
    }

    /// Outward unit normals of the sites.
    #[must_use]
    pub fn normals(&self) -> Vec<Point> {
        let mut normals = vec![];
        self.normals_to(&mut normals);
        normals
    }

    /// Edges with the triangles on both sides of them.
    fn edges_between(&self) -> Vec<([usize; 2], [usize; 2])> {
        let mut edges: Vec<([usize; 2], usize)> = self
            .triangles
            .iter()
            .enumerate()
            .flat_map(|(t, v)| {
                (0..3).map(move |k| {
                    let (a, b) = (v[k], v[(k + 1) % 3]);
                    ([a.min(b), a.max(b)], t)
                })
            })
            .collect();
        edges.sort_unstable();
        edges
            .windows(2)
            .filter(|pair| pair[0].0 == pair[1].0)
            .map(|pair| (pair[0].0, [pair[0].1, pair[1].1]))
            .collect()
    }

    /// True if the second of two neighbours turns away behind the first.
    fn convex(&self, triangles: [usize; 2]) -> bool {
        let [a, b] = triangles.map(|t| {
            let corners = self.triangles[t].iter().map(|v| self.points[*v]);
            corners.sum::<Point>() / 3.0
        });
        self.triangle_normal(triangles[0]).dot(&(b - a)) < 0.0
    }
}

impl Elements<3, 2> for Facets {
    fn points(&self) -> &[Point] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [Point] {
        &mut self.points
    }

    fn elements(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    fn longest(&self) -> f64 {
        self.longest_edge()
    }

    fn sites(&self) -> &Sites<3> {
        &self.sites
    }

    fn held(&self, vertex: usize, velocity: Point) -> Point {
        Point::from_fn(|axis, _| {
            if self.mirrored[vertex][axis] {
                0.0
            } else {
                velocity[axis]
            }
        })
    }

    fn edges_that_meet(&self, master: &Self, reach: f64, depth: f64) -> Option<(Point, f64)> {
        crossing(self, master, reach, depth).map(|found| (found.position, found.distance))
    }

    /// Weighted by area.
    fn normals_to(&self, sums: &mut Vec<Point>) {
        sums.clear();
        sums.resize(self.sites.vertices().len(), Point::zeros());
        for (triangle, sites) in self.sites.elements().iter().enumerate() {
            let spanned = self.spanned(triangle);
            for site in sites {
                sums[*site] += spanned;
            }
        }
        for (n, vertex) in sums.iter_mut().zip(self.sites.vertices()) {
            for axis in 0..3 {
                if self.mirrored[*vertex][axis] {
                    n[axis] = 0.0;
                }
            }
            *n = n.try_normalize(0.0).unwrap_or_default();
        }
    }

    /// The first points to a neighbour that never changes.
    fn tangents(&self, site: usize, normal: &Point) -> [Point; 2] {
        let vertex = self.sites.vertices()[site];
        let edge = self.points[self.beside[site]] - self.points[vertex];
        let first = (edge - normal * normal.dot(&edge))
            .try_normalize(0.0)
            .unwrap_or_default();
        [first, normal.cross(&first)]
    }

    fn points_of_element(
        &self,
        _normals: &[Point],
        master: &Self,
        pairs: &[[usize; 2]],
        search: MasterSearch,
        cuts: &mut Cuts,
        points: &mut Vec<MortarPoint<3>>,
    ) {
        points_of_triangle(self, master, pairs, search, &mut cuts.parts, points);
    }

    fn points_of_vertices(
        &self,
        normals: &[Point],
        master: &Self,
        near: &NearElements<3>,
        search: MasterSearch,
        points: &mut Vec<MortarPoint<3>>,
    ) {
        points_of_vertices(self, normals, master, near, search, points);
    }
}
