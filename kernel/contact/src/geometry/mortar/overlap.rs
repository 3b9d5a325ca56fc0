//! Boundaries that lie in each other at the start.

use super::boundary::{Boundary, BoundarySide};
use super::broad::NearElements;
use super::{Point, cross};
use std::fmt;

/// Overlap of two boundaries. Segments are counted from 0 through all polylines of a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundaryOverlap {
    /// A segment of the slave crosses one of the master.
    Crossing {
        /// Segment of the slave.
        slave: usize,
        /// Segment of the master.
        master: usize,
    },
    /// A vertex of the slave lies inside the master.
    SlaveInside(usize),
    /// A vertex of the master lies inside the slave.
    MasterInside(usize),
}

impl fmt::Display for BoundaryOverlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Crossing { slave, master } => write!(
                f,
                "segment {slave} of the slave crosses segment {master} of the master"
            ),
            Self::SlaveInside(k) => write!(f, "vertex {k} of the slave lies inside the master"),
            Self::MasterInside(k) => write!(f, "vertex {k} of the master lies inside the slave"),
        }
    }
}

/// Finds how two boundaries lie in each other; nothing where they are apart or touch.
#[must_use]
pub fn overlap(slave: &Boundary, master: &Boundary) -> Option<BoundaryOverlap> {
    let mut near = NearElements::default();
    near.find(slave, master, 0.0);
    let crossing = near.pairs.iter().find(|[s, m]| {
        let [a, b] = slave.segments()[*s].map(|k| &slave.points[k]);
        let [c, d] = master.segments()[*m].map(|k| &master.points[k]);
        let side = |p: &Point, q: &Point, r: &Point| cross(&(q - p), &(r - p));
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    });
    if let Some([s, m]) = crossing {
        return Some(BoundaryOverlap::Crossing {
            slave: *s,
            master: *m,
        });
    }
    let within = |inner: &Boundary, outer: &Boundary| {
        let points = &inner.points;
        points
            .iter()
            .position(|x| inside(x, outer) && !touches(x, outer))
    };
    within(slave, master)
        .map(BoundaryOverlap::SlaveInside)
        .or_else(|| within(master, slave).map(BoundaryOverlap::MasterInside))
}

/// True if a point lies on a boundary but for round-off.
fn touches(x: &Point, boundary: &Boundary) -> bool {
    let round_off = 1.0e-9 * boundary.longest_segment();
    (0..boundary.segments().len()).any(|s| {
        let (a, edge) = (
            &boundary.points[boundary.segments()[s][0]],
            boundary.edge(s),
        );
        let share = ((x - a).dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
        (x - a - share * edge).norm() <= round_off
    })
}

/// True if a point lies in the material that the closed polylines of a boundary enclose (even-odd rule).
fn inside(x: &Point, boundary: &Boundary) -> bool {
    let mut crossings = 0;
    for (s, ends) in boundary.segments().iter().enumerate() {
        let [a, b] = ends.map(|k| &boundary.points[k]);
        if boundary.side(s) == BoundarySide::Open || (a.y > x.y) == (b.y > x.y) {
            continue;
        }
        let share = (x.y - a.y) / (b.y - a.y);
        if a.x + share * (b.x - a.x) > x.x {
            crossings += 1;
        }
    }
    crossings % 2 == 1
}
