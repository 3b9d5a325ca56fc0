//! Bins: the triangles near a point of the plan, from a regular grid over all of them.

use super::{PlanPoint, PlanRange};

/// Triangles by the cells of a regular grid that their boxes reach.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bins {
    extent: PlanRange,
    counts: [usize; 2],
    /// First entry of each bin, and the end of the last.
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl Bins {
    /// About one triangle in a bin, each triangle by its rectangle in plan.
    pub fn new(rectangles: &[PlanRange]) -> Self {
        let mut extent = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for rectangle in rectangles {
            for axis in 0..2 {
                extent[axis][0] = extent[axis][0].min(rectangle[axis][0]);
                extent[axis][1] = extent[axis][1].max(rectangle[axis][1]);
            }
        }
        let count = rectangles.len().max(1) as f64;
        let [width, height] = extent.map(|[low, high]| (high - low).max(f64::MIN_POSITIVE));
        let along = (count * width / height).sqrt().ceil().clamp(1.0, count);
        let across = (count / along).ceil().max(1.0);
        let mut bins = Self {
            extent,
            counts: [along as usize, across as usize],
            starts: vec![],
            entries: vec![],
        };
        let mut sizes = vec![0_u32; bins.counts[0] * bins.counts[1] + 1];
        for rectangle in rectangles {
            bins.each(rectangle, |bin| sizes[bin + 1] += 1);
        }
        for bin in 1..sizes.len() {
            sizes[bin] += sizes[bin - 1];
        }
        let mut next = sizes.clone();
        let mut entries = vec![0; sizes.last().map_or(0, |end| *end as usize)];
        for (index, rectangle) in rectangles.iter().enumerate() {
            bins.each(rectangle, |bin| {
                entries[next[bin] as usize] = index as u32;
                next[bin] += 1;
            });
        }
        (bins.starts, bins.entries) = (sizes, entries);
        bins
    }

    /// The rectangle around all triangles.
    pub fn extent(&self) -> PlanRange {
        self.extent
    }

    /// The same bins in coordinates that begin at `origin`.
    pub fn relative_to(&self, origin: PlanPoint) -> Self {
        let mut moved = self.clone();
        for axis in 0..2 {
            moved.extent[axis] = self.extent[axis].map(|x| x - origin[axis]);
        }
        moved
    }

    fn index(&self, axis: usize, x: f64) -> usize {
        let [low, high] = self.extent[axis];
        let share = (x - low) / (high - low).max(f64::MIN_POSITIVE);
        ((share * self.counts[axis] as f64).max(0.0) as usize).min(self.counts[axis] - 1)
    }

    fn each(&self, rectangle: &PlanRange, mut visit: impl FnMut(usize)) {
        let [columns, rows] = [0, 1].map(|axis| rectangle[axis].map(|x| self.index(axis, x)));
        for row in rows[0]..=rows[1] {
            for column in columns[0]..=columns[1] {
                visit(row * self.counts[0] + column);
            }
        }
    }

    /// Triangles whose rectangles may hold a point.
    pub fn at(&self, point: PlanPoint) -> &[u32] {
        if self.entries.is_empty() {
            return &[];
        }
        let bin = self.index(1, point[1]) * self.counts[0] + self.index(0, point[0]);
        &self.entries[self.starts[bin] as usize..self.starts[bin + 1] as usize]
    }

    /// Triangles whose rectangles may reach a rectangle, each once, in ascending order.
    pub fn near(&self, rectangle: &PlanRange) -> Vec<u32> {
        let mut near = vec![];
        if self.entries.is_empty() {
            return near;
        }
        self.each(rectangle, |bin| {
            near.extend_from_slice(
                &self.entries[self.starts[bin] as usize..self.starts[bin + 1] as usize],
            );
        });
        near.sort_unstable();
        near.dedup();
        near
    }
}
