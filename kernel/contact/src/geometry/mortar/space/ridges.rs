//! Sharp edges that meet sharp edges.
//!
//! Contact between faces spreads pressure over the area that faces cover of each other; where two convex edges cross,
//! that area is a point, and the bodies would pass into each other before there is any pressure. Such pairs are found
//! here, so that a run ends with their names instead.

use super::Point;
use super::facets::{Facets, Ridge};
use crate::geometry::mortar::broad::Bounds;

/// Two edges that cross each other within reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Vertices of the edge of the slave.
    pub slave: [usize; 2],
    /// Vertices of the edge of the master.
    pub master: [usize; 2],
    /// Distance, negative when past each other \[m\].
    pub distance: f64,
    /// The point of the slave's edge \[m\].
    pub position: Point,
}

/// Sine of the angle that the line between two edges must keep from the faces beside them. Along the normal of a face it
/// is the face that is touched, as where the rims of two plates cross that lie on each other.
const CLEAR: f64 = 0.1;

/// The nearest crossing of a convex edge of the slave with one of the master at a distance between `-depth` and `reach`
/// \[m\]: edges whose common perpendicular lies between the normals of the faces on both sides of both.
#[must_use]
pub fn crossing(slave: &Facets, master: &Facets, reach: f64, depth: f64) -> Option<Crossing> {
    let margin = reach.max(depth);
    let around = |facets: &Facets, ridge: &Ridge| {
        Bounds::around(ridge.vertices.map(|v| &facets.points[v]), 0.5 * margin)
    };
    let all = Bounds::around(&master.points, margin);
    let masters: Vec<(&Ridge, Bounds<3>)> = master
        .ridges()
        .iter()
        .map(|ridge| (ridge, around(master, ridge)))
        .collect();
    let mut nearest: Option<Crossing> = None;
    for ridge in slave.ridges() {
        let bounds = around(slave, ridge);
        if !bounds.overlaps(&all) {
            continue;
        }
        for (other, _) in masters.iter().filter(|(_, b)| b.overlaps(&bounds)) {
            if let Some(found) = cross(slave, ridge, master, other)
                && (-depth..=reach).contains(&found.distance)
                && nearest.is_none_or(|n| found.distance < n.distance)
            {
                nearest = Some(found);
            }
        }
    }
    nearest
}

/// The crossing of two edges, if their common perpendicular has its ends on both and leaves both between their faces.
fn cross(slave: &Facets, s: &Ridge, master: &Facets, m: &Ridge) -> Option<Crossing> {
    let [a, b] = s.vertices.map(|v| slave.points[v]);
    let [c, d] = m.vertices.map(|v| master.points[v]);
    let (e, f) = (b - a, d - c);
    let normal = e.cross(&f).try_normalize(CLEAR * e.norm() * f.norm())?;
    let [s1, s2] = s.triangles.map(|t| slave.triangle_normal(t));
    let [m1, m2] = m.triangles.map(|t| master.triangle_normal(t));
    let outward = if normal.dot(&(s1 + s2)) >= 0.0 {
        normal
    } else {
        -normal
    };
    if !(between(&outward, &s1, &s2) && between(&-outward, &m1, &m2)) {
        return None;
    }
    // a + xi e + distance outward = c + eta f.
    let (across, gap) = (e.cross(&f), c - a);
    let square = across.norm_squared();
    let xi = gap.cross(&f).dot(&across) / square;
    let eta = gap.cross(&e).dot(&across) / square;
    let on = |share: f64| (0.0..=1.0).contains(&share);
    (on(xi) && on(eta)).then(|| Crossing {
        slave: s.vertices,
        master: m.vertices,
        distance: outward.dot(&gap),
        position: a + e * xi,
    })
}

/// True if a unit vector at right angles to an edge lies between the normals beside it, clear of both.
fn between(n: &Point, first: &Point, second: &Point) -> bool {
    let axis = first.cross(second);
    let turn = axis.norm();
    first.cross(n).dot(&axis) > CLEAR * turn && n.cross(second).dot(&axis) > CLEAR * turn
}
