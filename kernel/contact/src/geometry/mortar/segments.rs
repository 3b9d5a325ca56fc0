//! Projection of a slave boundary onto a master boundary in the plane.
//!
//! Slave points are projected along the normal field of the slave, interpolated between its vertices. A slave segment
//! is cut where master vertices project onto it; on each piece (mortar segment) one master segment is seen, and two
//! Gauss points lie on it (algorithm 1).

use super::boundary::Boundary;
use super::broad::NearElements;
use super::elements::Elements;
use super::overlap::overlap;
use super::points::{Cuts, FACING, MasterSearch, MortarPoint};
use super::sites::Sites;
use super::{Point, cross};

/// Pieces of a segment shorter than this share of it are left out: they hold nothing but round-off.
const SHORTEST: f64 = 1.0e-12;

/// Places of the two Gauss points in a piece, in shares of its length.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

impl Elements<2, 1> for Boundary {
    fn points(&self) -> &[Point] {
        &self.points
    }

    fn points_mut(&mut self) -> &mut [Point] {
        &mut self.points
    }

    fn elements(&self) -> &[[usize; 2]] {
        self.segments()
    }

    fn longest(&self) -> f64 {
        self.longest_segment()
    }

    fn normals_to(&self, normals: &mut Vec<Point>) {
        Self::normals_to(self, normals);
    }

    fn lies_in(&self, master: &Self) -> Option<String> {
        overlap(self, master).map(|found| found.to_string())
    }

    fn sites(&self) -> &Sites<2> {
        Self::sites(self)
    }

    fn tangents(&self, _site: usize, normal: &Point) -> [Point; 1] {
        [Point::new(-normal.y, normal.x)]
    }

    fn points_of_element(
        &self,
        normals: &[Point],
        master: &Self,
        pairs: &[[usize; 2]],
        search: MasterSearch,
        cuts: &mut Cuts,
        points: &mut Vec<MortarPoint<2>>,
    ) {
        points_of_segment(self, normals, master, pairs, search, cuts, points);
    }

    fn points_of_vertices(
        &self,
        normals: &[Point],
        master: &Self,
        near: &NearElements<2>,
        search: MasterSearch,
        points: &mut Vec<MortarPoint<2>>,
    ) {
        points_of_vertices(self, normals, master, near, search, points);
    }
}

/// Point where the ray from a point along a direction meets a master segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Position on the segment, 0 at its first vertex and 1 at its second.
    pub eta: f64,
    /// Distance along the direction, negative behind the point \[m\].
    pub gap: f64,
}

/// Projects a point along a direction (of any length) onto the line through a master segment; nothing where the
/// segment does not face the direction.
#[must_use]
pub fn project(
    x: &Point,
    direction: &Point,
    master: &Boundary,
    segment: usize,
) -> Option<Projection> {
    let n = direction.try_normalize(0.0)?;
    if n.dot(&master.segment_normal(segment)) >= FACING {
        return None;
    }
    let y = master.points[master.segments()[segment][0]];
    let edge = master.edge(segment);
    let eta = cross(&(x - y), &n) / cross(&edge, &n);
    Some(Projection {
        eta,
        gap: n.dot(&(y + eta * edge - x)),
    })
}

/// Positions xi in (0, 1) on a slave segment whose interpolated normals pass through a point: the roots of
/// (y - x(xi)) x n(xi) = 0, a quadratic.
pub fn feet(y: &Point, x: [&Point; 2], n: [&Point; 2]) -> impl Iterator<Item = f64> {
    // About the middle of the segment, so that the wanted root is the one that is small, which is computed without
    // cancellation also where the normals are parallel and the equation is linear.
    let (edge, turn) = (x[1] - x[0], n[1] - n[0]);
    let (d, middle) = (y - 0.5 * (x[0] + x[1]), 0.5 * (n[0] + n[1]));
    let a = -cross(&edge, &turn);
    let b = cross(&d, &turn) - cross(&edge, &middle);
    let c = cross(&d, &middle);
    let discriminant = b * b - 4.0 * a * c;
    // Not a number where there is no root, and then neither of them lies on the segment.
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let (first, second) = (0.5 + c / q, 0.5 + q / a);
    let second = (second != first).then_some(second);
    [Some(first), second]
        .into_iter()
        .flatten()
        .filter(|xi| 0.0 < *xi && *xi < 1.0)
}

fn points_of_segment(
    slave: &Boundary,
    normals: &[Point],
    master: &Boundary,
    pairs: &[[usize; 2]],
    search: MasterSearch,
    Cuts { along: cuts, .. }: &mut Cuts,
    points: &mut Vec<MortarPoint<2>>,
) {
    let segment = pairs[0][0];
    let [a, b] = slave.segments()[segment];
    let sites = slave.sites().elements()[segment];
    let of_ends = sites.map(|site| &normals[site]);
    let x = |xi: f64| slave.points[a] * (1.0 - xi) + slave.points[b] * xi;
    let n = |xi: f64| of_ends[0] * (1.0 - xi) + of_ends[1] * xi;
    // Only vertices that are seen cut: others would change the quadrature with what else is near.
    cuts.clear();
    cuts.extend([0.0, 1.0]);
    for &[_, m] in pairs {
        for v in master.segments()[m] {
            let ends = [&slave.points[a], &slave.points[b]];
            let feet = feet(&master.points[v], ends, of_ends);
            cuts.extend(feet.filter(|xi| {
                project(&x(*xi), &n(*xi), master, m).is_some_and(|p| search.contains(p.gap))
            }));
        }
    }
    cuts.sort_unstable_by(f64::total_cmp);
    let length = slave.edge(segment).norm();
    for cut in cuts.windows(2) {
        let (from, width) = (cut[0], cut[1] - cut[0]);
        if width < SHORTEST {
            continue;
        }
        let middle = from + 0.5 * width;
        let Some(seen) = nearest(&x(middle), &n(middle), master, pairs, search) else {
            continue;
        };
        for place in GAUSS {
            let xi = from + place * width;
            let Some(projection) = project(&x(xi), &n(xi), master, seen) else {
                continue;
            };
            // Between the cuts the point lies on the segment but for round-off.
            let eta = projection.eta.clamp(0.0, 1.0);
            let [c, d] = master.segments()[seen];
            points.push(MortarPoint {
                slave: [(a, 1.0 - xi), (b, xi)],
                sites,
                master: [(c, 1.0 - eta), (d, eta)],
                weight: 0.5 * width * length,
            });
        }
    }
}

/// The master segment that a ray meets first, of those that face it within the search.
fn nearest(
    x: &Point,
    n: &Point,
    master: &Boundary,
    pairs: &[[usize; 2]],
    search: MasterSearch,
) -> Option<usize> {
    pairs
        .iter()
        .filter_map(|[_, m]| {
            let p = project(x, n, master, *m)?;
            let on = (0.0..=1.0).contains(&p.eta);
            (on && search.contains(p.gap)).then_some((*m, p.gap.abs()))
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(m, _)| m)
}

fn points_of_vertices(
    slave: &Boundary,
    normals: &[Point],
    master: &Boundary,
    near: &NearElements<2>,
    search: MasterSearch,
    points: &mut Vec<MortarPoint<2>>,
) {
    let lengths = slave.tributary_lengths();
    let mut seen = vec![vec![]; normals.len()];
    for pair in &near.pairs {
        for site in slave.sites().elements()[pair[0]] {
            seen[site].push(*pair);
        }
    }
    for (site, masters) in seen.into_iter().enumerate() {
        let v = slave.sites().vertices()[site];
        let (x, n) = (&slave.points[v], &normals[site]);
        let Some(m) = nearest(x, n, master, &masters, search) else {
            continue;
        };
        let Some(projection) = project(x, n, master, m) else {
            continue;
        };
        let [c, d] = master.segments()[m];
        points.push(MortarPoint {
            slave: [(v, 1.0), (v, 0.0)],
            sites: [site; 2],
            master: [(c, 1.0 - projection.eta), (d, projection.eta)],
            weight: lengths[site],
        });
    }
}
