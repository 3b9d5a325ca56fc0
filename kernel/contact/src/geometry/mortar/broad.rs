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

    /// True if two boxes share a point.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..D).all(|axis| {
            self.lower[axis] <= other.upper[axis] && other.lower[axis] <= self.upper[axis]
        })
    }
}

/// Pairs of elements that are close enough to be looked at. Kept from step to step for its memory alone.
#[derive(Clone, Debug, Default)]
pub struct NearElements<const D: usize> {
    /// Element of the slave and element of the master, ascending.
    pub pairs: Vec<[usize; 2]>,
    /// Elements of the slave near the master, ascending, and those of the master near them, along an axis.
    slaves: Vec<ElementBox<D>>,
    masters: Vec<ElementBox<D>>,
    axis: usize,
    /// Longest extent of a box of the master along the axis \[m\].
    widest: f64,
}

/// An element in its box.
pub type ElementBox<const D: usize> = (usize, Bounds<D>);

impl<const D: usize> NearElements<D> {
    /// Finds the elements of the slave and those of the master that come within `reach` \[m\] of their box.
    pub fn find<B: Elements<D, T>, const T: usize>(&mut self, slave: &B, master: &B, reach: f64) {
        self.look(slave, master, reach);
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.clear();
        self.pairs_of(&self.slaves, &mut pairs);
        self.pairs = pairs;
    }

    /// Finds which elements may have a partner, those of the slave in order.
    pub fn look<B: Elements<D, T>, const T: usize>(&mut self, slave: &B, master: &B, reach: f64) {
        let all = Bounds::around(master.points(), reach);
        let mut region = Bounds::<D>::around([], 0.0);
        self.slaves.clear();
        for (s, bounds) in boxes(slave, 0.0) {
            if bounds.overlaps(&all) {
                region.lower = region.lower.inf(&bounds.lower);
                region.upper = region.upper.sup(&bounds.upper);
                self.slaves.push((s, bounds));
            }
        }
        self.masters.clear();
        if self.slaves.is_empty() {
            return;
        }
        self.masters
            .extend(boxes(master, reach).filter(|(_, bounds)| bounds.overlaps(&region)));
        // Sorted along the axis in which the region is longest: along another one all boxes may overlap.
        let extent = region.upper - region.lower;
        let longer = |best, axis| {
            if extent[axis] > extent[best] {
                axis
            } else {
                best
            }
        };
        let axis = (1..D).fold(0, longer);
        self.masters.sort_unstable_by(|a, b| {
            a.1.lower[axis]
                .total_cmp(&b.1.lower[axis])
                .then(a.0.cmp(&b.0))
        });
        let extents = self.masters.iter();
        let extents = extents.map(|(_, b)| b.upper[axis] - b.lower[axis]);
        (self.axis, self.widest) = (axis, extents.fold(0.0, f64::max));
    }

    /// The elements of the slave that [`NearElements::look`] found.
    #[must_use]
    pub fn slaves(&self) -> &[ElementBox<D>] {
        &self.slaves
    }

    /// Adds the pairs of some of these.
    pub fn pairs_of(&self, slaves: &[ElementBox<D>], pairs: &mut Vec<[usize; 2]>) {
        let (axis, widest) = (self.axis, self.widest);
        for (s, bounds) in slaves {
            let first = self
                .masters
                .partition_point(|(_, b)| b.lower[axis] < bounds.lower[axis] - widest);
            let own = pairs.len();
            pairs.extend(
                self.masters[first..]
                    .iter()
                    .take_while(|(_, b)| b.lower[axis] <= bounds.upper[axis])
                    .filter(|(_, b)| b.overlaps(bounds))
                    .map(|(m, _)| [*s, *m]),
            );
            pairs[own..].sort_unstable();
        }
    }

    /// The pairs of each element of the slave that has any.
    pub fn by_slave(&self) -> impl Iterator<Item = &[[usize; 2]]> {
        by_slave(&self.pairs)
    }
}

/// Pairs by the element of the slave.
pub fn by_slave(pairs: &[[usize; 2]]) -> impl Iterator<Item = &[[usize; 2]]> {
    pairs.chunk_by(|a, b| a[0] == b[0])
}

/// The boxes of the elements, `margin` \[m\] larger on all sides.
fn boxes<const D: usize, const T: usize>(
    boundary: &impl Elements<D, T>,
    margin: f64,
) -> impl Iterator<Item = ElementBox<D>> {
    let points = boundary.points();
    let margin = PointIn::repeat(margin);
    boundary
        .elements()
        .iter()
        .enumerate()
        .map(move |(element, vertices)| {
            let of = |k: usize| points[vertices[k]];
            let bounds = Bounds {
                lower: (1..D).fold(of(0), |low, k| low.inf(&of(k))) - margin,
                upper: (1..D).fold(of(0), |high, k| high.sup(&of(k))) + margin,
            };
            (element, bounds)
        })
}
