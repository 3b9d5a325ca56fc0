//! Master triangles as seen from a slave triangle, and the points at which integrals over their contact are evaluated.
//!
//! The corners of the master are moved along the normal of the slave triangle into its plane and clipped there; the part
//! that both cover is cut into triangles with Gauss points. Shape functions are linear in that plane on both sides, so
//! that D and M are exact for flat surfaces however they are triangulated.

use super::Point;
use super::clip::{GAUSS, PlanePoint, Polygon, area, overlap, shares};
use super::facets::Facets;
use crate::geometry::mortar::broad::NearElements;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::points::{FACING, MasterSearch, MortarPoint};
use std::array;

/// Parts of a triangle smaller than this share of its area are left out: they hold nothing but round-off.
const SMALLEST: f64 = 1.0e-12;

/// Largest negative share on the edge of a triangle, so that no ray slips through between two.
const ON_EDGE: f64 = 1.0e-12;

/// A plane with coordinates of its own.
#[derive(Clone, Copy, Debug)]
struct Plane {
    origin: Point,
    normal: Point,
    axes: [Point; 2],
}

impl Plane {
    /// Through a point, at right angles to a unit vector.
    fn new(origin: Point, normal: Point) -> Self {
        // The axis along which the normal is shortest gives the best-conditioned frame.
        let mut least = Point::zeros();
        least[normal.iamin()] = 1.0;
        let first = (least - normal * normal.dot(&least)).normalize();
        Self {
            origin,
            normal,
            axes: [first, normal.cross(&first)],
        }
    }

    fn flat(&self, x: &Point) -> PlanePoint {
        let d = x - self.origin;
        PlanePoint::new(self.axes[0].dot(&d), self.axes[1].dot(&d))
    }

    fn height(&self, x: &Point) -> f64 {
        self.normal.dot(&(x - self.origin))
    }
}

/// A master triangle in the plane of a slave triangle, turned around to be counter-clockwise there.
#[derive(Clone, Copy, Debug)]
struct ProjectedTriangle {
    vertices: [usize; 3],
    corners: [PlanePoint; 3],
    heights: [f64; 3],
}

/// A part of a slave triangle that a master triangle covers.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry::mortar) struct CoveredPart {
    seen: ProjectedTriangle,
    both: Polygon,
}

impl ProjectedTriangle {
    /// Nothing where the triangle does not face the plane.
    fn new(plane: &Plane, master: &Facets, triangle: usize) -> Option<Self> {
        if plane.normal.dot(&master.triangle_normal(triangle)) >= FACING {
            return None;
        }
        let [a, b, c] = master.triangles()[triangle];
        let vertices = [a, c, b];
        Some(Self {
            vertices,
            corners: vertices.map(|v| plane.flat(&master.points[v])),
            heights: vertices.map(|v| plane.height(&master.points[v])),
        })
    }

    /// Shape functions of the three vertices at a point of the plane, and the gap there.
    fn at(&self, p: &PlanePoint) -> ([f64; 3], f64) {
        let shares = shares(p, &self.corners);
        let gap = (0..3).map(|k| shares[k] * self.heights[k]).sum();
        (shares, gap)
    }

    fn master(&self, shares: [f64; 3]) -> [(usize, f64); 3] {
        array::from_fn(|k| (self.vertices[k], shares[k]))
    }

    /// True if the triangle is in front of a gap at a point of the plane.
    fn hides(&self, p: &PlanePoint, gap: f64, search: MasterSearch) -> bool {
        let (shares, own) = self.at(p);
        shares.iter().all(|s| *s > 0.0) && search.contains(own) && own.abs() < gap.abs()
    }
}

/// Points of one slave triangle and the master triangles near it.
pub(super) fn points_of_triangle(
    slave: &Facets,
    master: &Facets,
    pairs: &[[usize; 2]],
    search: MasterSearch,
    parts: &mut Vec<CoveredPart>,
    points: &mut Vec<MortarPoint<3>>,
) {
    let triangle = pairs[0][0];
    let vertices = slave.triangles()[triangle];
    let normal = slave.triangle_normal(triangle);
    let plane = Plane::new(slave.points[vertices[0]], normal);
    let own = vertices.map(|v| plane.flat(&slave.points[v]));
    let smallest = SMALLEST * area(&own);
    parts.clear();
    parts.extend(pairs.iter().filter_map(|[_, m]| {
        let seen = ProjectedTriangle::new(&plane, master, *m)?;
        let both = overlap(&seen.corners, &own);
        (both.area() > smallest).then_some(CoveredPart { seen, both })
    }));
    for (k, CoveredPart { seen, both }) in parts.iter().enumerate() {
        for cell in both.fan() {
            let weight = area(&cell) / 3.0;
            if weight <= 0.0 {
                continue;
            }
            for [u, v, w] in GAUSS {
                let p = cell[0] * u + cell[1] * v + cell[2] * w;
                let (on_master, gap) = seen.at(&p);
                if !search.contains(gap) {
                    continue;
                }
                let mut others = parts.iter().enumerate().filter(|(other, _)| *other != k);
                if others.any(|(_, other)| other.seen.hides(&p, gap, search)) {
                    continue;
                }
                let on_slave = shares(&p, &own);
                points.push(MortarPoint {
                    slave: array::from_fn(|i| (vertices[i], on_slave[i])),
                    sites: slave.sites().elements()[triangle],
                    master: seen.master(on_master),
                    weight,
                });
            }
        }
    }
}

/// Points at the sites of the slave, each with a third of its triangles.
pub(super) fn points_of_vertices(
    slave: &Facets,
    normals: &[Point],
    master: &Facets,
    near: &NearElements<3>,
    search: MasterSearch,
    points: &mut Vec<MortarPoint<3>>,
) {
    let areas = slave.tributary_areas();
    let mut candidates: Vec<Vec<usize>> = vec![vec![]; normals.len()];
    for [triangle, m] in &near.pairs {
        for site in slave.sites().elements()[*triangle] {
            candidates[site].push(*m);
        }
    }
    for (site, mut masters) in candidates.into_iter().enumerate() {
        masters.sort_unstable();
        masters.dedup();
        if normals[site] == Point::zeros() {
            continue;
        }
        let v = slave.sites().vertices()[site];
        let plane = Plane::new(slave.points[v], normals[site]);
        let found = masters
            .iter()
            .filter_map(|m| {
                let seen = ProjectedTriangle::new(&plane, master, *m)?;
                let (shares, gap) = seen.at(&PlanePoint::zeros());
                let on = shares.iter().all(|s| *s >= -ON_EDGE);
                (on && search.contains(gap)).then_some((seen.master(shares), gap.abs()))
            })
            .min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((master, _)) = found {
            points.push(MortarPoint {
                slave: [(v, 1.0), (v, 0.0), (v, 0.0)],
                sites: [site; 3],
                master,
                weight: areas[site],
            });
        }
    }
}
