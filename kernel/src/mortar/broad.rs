//! Broad phase: which bodies, and which of their elements, are close enough to be looked at.

use super::PointIn;
use super::elements::Elements;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<const D: usize> {
    /// Lower corner \[m\].
    pub lower: PointIn<D>,
    /// Upper corner \[m\].
    pub upper: PointIn<D>,
}

impl<const D: usize> Bounds<D> {
    /// The box around some points, `margin` \[m\] larger on all sides (eq. 57 takes half the critical gap, which finds
    /// every pair in contact; a deeper search for penetration needs more). Vertices bound a body, particles do not: they
    /// lie inside. Without points the box is empty and overlaps nothing.
    #[must_use]
    pub fn around<'a>(points: impl IntoIterator<Item = &'a PointIn<D>>, margin: f64) -> Self {
        let mut bounds = Self {
            lower: PointIn::repeat(f64::INFINITY),
            upper: PointIn::repeat(f64::NEG_INFINITY),
        };
        for p in points {
            bounds.lower = bounds.lower.inf(p);
            bounds.upper = bounds.upper.sup(p);
        }
        bounds.lower -= PointIn::repeat(margin);
        bounds.upper += PointIn::repeat(margin);
        bounds
    }

    /// Whether two boxes share a point.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..D).all(|axis| {
            self.lower[axis] <= other.upper[axis] && other.lower[axis] <= self.upper[axis]
        })
    }
}

/// Elements of the slave with the elements of the master that come within `reach` \[m\] of their box, both ascending.
/// Slave elements without any are left out.
#[must_use]
pub fn near<const D: usize, const T: usize>(
    slave: &impl Elements<D, T>,
    master: &impl Elements<D, T>,
    reach: f64,
) -> Vec<(usize, Vec<usize>)> {
    let all = Bounds::around(master.points(), reach);
    let slaves: Vec<(usize, Bounds<D>)> = boxes(slave, 0.0)
        .filter(|(_, bounds)| bounds.overlaps(&all))
        .collect();
    let region = slaves
        .iter()
        .fold(Bounds::<D>::around([], 0.0), |sum, (_, bounds)| Bounds {
            lower: sum.lower.inf(&bounds.lower),
            upper: sum.upper.sup(&bounds.upper),
        });
    let mut masters: Vec<(usize, Bounds<D>)> = boxes(master, reach)
        .filter(|(_, bounds)| bounds.overlaps(&region))
        .collect();
    // Sorted along the axis in which the region is longest: along another one all boxes may overlap.
    let extent = region.upper - region.lower;
    let axis = (1..D).fold(0, |best, axis| {
        if extent[axis] > extent[best] {
            axis
        } else {
            best
        }
    });
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

/// Boxes of the elements of a boundary, each `margin` \[m\] larger on all sides.
fn boxes<const D: usize, const T: usize>(
    boundary: &impl Elements<D, T>,
    margin: f64,
) -> impl Iterator<Item = (usize, Bounds<D>)> {
    let points = boundary.points();
    boundary
        .elements()
        .iter()
        .map(move |element| Bounds::around(element.iter().map(|k| &points[*k]), margin))
        .enumerate()
}
