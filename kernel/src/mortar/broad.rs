//! Broad phase: which bodies, and which of their segments, are close enough to be looked at.

use super::Point;
use super::boundary::Boundary;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower corner \[m\].
    pub lower: Point,
    /// Upper corner \[m\].
    pub upper: Point,
}

impl Bounds {
    /// The box around some points, `margin` \[m\] larger on all sides (eq. 57 takes half the critical gap, which finds
    /// every pair in contact; a deeper search for penetration needs more). Vertices bound a body, particles do not: they
    /// lie inside. Without points the box is empty and overlaps nothing.
    #[must_use]
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Point>, margin: f64) -> Self {
        let mut bounds = Self {
            lower: Point::repeat(f64::INFINITY),
            upper: Point::repeat(f64::NEG_INFINITY),
        };
        for p in points {
            bounds.lower = bounds.lower.inf(p);
            bounds.upper = bounds.upper.sup(p);
        }
        bounds.lower -= Point::repeat(margin);
        bounds.upper += Point::repeat(margin);
        bounds
    }

    /// Whether two boxes share a point.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|axis| {
            self.lower[axis] <= other.upper[axis] && other.lower[axis] <= self.upper[axis]
        })
    }
}

/// Segments of the slave with the segments of the master that come within `reach` \[m\] of their box, both ascending.
/// Slave segments without any are left out.
#[must_use]
pub fn near_segments(slave: &Boundary, master: &Boundary, reach: f64) -> Vec<(usize, Vec<usize>)> {
    let box_of = |boundary: &Boundary, s: usize, margin: f64| {
        Bounds::around(boundary.segments()[s].map(|k| &boundary.points[k]), margin)
    };
    let all = Bounds::around(&master.points, reach);
    let slaves: Vec<(usize, Bounds)> = (0..slave.segments().len())
        .map(|s| (s, box_of(slave, s, 0.0)))
        .filter(|(_, bounds)| bounds.overlaps(&all))
        .collect();
    let region = slaves
        .iter()
        .fold(Bounds::around([], 0.0), |sum, (_, bounds)| Bounds {
            lower: sum.lower.inf(&bounds.lower),
            upper: sum.upper.sup(&bounds.upper),
        });
    let mut masters: Vec<(usize, Bounds)> = (0..master.segments().len())
        .map(|m| (m, box_of(master, m, reach)))
        .filter(|(_, bounds)| bounds.overlaps(&region))
        .collect();
    // Sorted along the axis in which the region is longer: along the other one all boxes may overlap.
    let extent = region.upper - region.lower;
    let axis = usize::from(extent.y > extent.x);
    masters.sort_by(|a, b| {
        a.1.lower[axis]
            .total_cmp(&b.1.lower[axis])
            .then(a.0.cmp(&b.0))
    });
    let widest = masters
        .iter()
        .map(|(_, b)| b.upper[axis] - b.lower[axis])
        .fold(0.0, f64::max);
    let mut near = vec![];
    for (s, bounds) in slaves {
        let first = masters.partition_point(|(_, b)| b.lower[axis] < bounds.lower[axis] - widest);
        let mut found: Vec<usize> = masters[first..]
            .iter()
            .take_while(|(_, b)| b.lower[axis] <= bounds.upper[axis])
            .filter(|(_, b)| b.overlaps(&bounds))
            .map(|(m, _)| *m)
            .collect();
        if !found.is_empty() {
            found.sort_unstable();
            near.push((s, found));
        }
    }
    near
}
