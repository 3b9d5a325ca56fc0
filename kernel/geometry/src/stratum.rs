//! Strata: the ground between sheets, over a rectangle of the plan.

use crate::sheet::{PlanPoint, PlanRange, Sheet, clip, overlay, polygon_area};
use crate::vector::Vector;
use std::sync::Arc;

/// The ground above all of some sheets and below all of others, less some boxes. Heights are along the last axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Stratum {
    axes: usize,
    range: PlanRange,
    lower: Vec<Sheet>,
    upper: Vec<Sheet>,
    without: Vec<[Vector; 2]>,
    volume: f64,
    extremes: [Vector; 2],
    /// The ground of which it is a part.
    whole: Option<Arc<Self>>,
}

impl Stratum {
    /// The ground between two sheets over a rectangle of the plan, in a number of axes, 2 or 3. In two dimensions the second
    /// range is that of the unit thickness, 0 to 1 m.
    #[must_use]
    pub fn new(axes: usize, range: PlanRange, lower: Sheet, upper: Sheet) -> Self {
        Self::from_parts(axes, range, vec![lower], vec![upper], vec![])
    }

    /// An axis-aligned box, in two dimensions a rectangle, as the ground between two levels.
    #[must_use]
    pub fn of_box(axes: usize, p1: &Vector, p2: &Vector) -> Self {
        let lower = Sheet::Level(p1[axes - 1]);
        Self::new(
            axes,
            plan_of(axes, p1, p2),
            lower,
            Sheet::Level(p2[axes - 1]),
        )
    }

    fn from_parts(
        axes: usize,
        range: PlanRange,
        lower: Vec<Sheet>,
        upper: Vec<Sheet>,
        without: Vec<[Vector; 2]>,
    ) -> Self {
        if range.iter().any(|[low, high]| low >= high) {
            return Self {
                axes,
                range,
                lower,
                upper,
                without,
                volume: 0.0,
                extremes: [[0.0; 3]; 2],
                whole: None,
            };
        }
        let of = |sheets: &[Sheet], side: usize, sign: f64| {
            let points = sheets.iter().map(|sheet| sheet.extremes(&range)[side]);
            points.reduce(|a, b| if sign * b[2] > sign * a[2] { b } else { a })
        };
        // No part of it lies below the highest of the lowest points.
        let extremes = [of(&lower, 0, 1.0), of(&upper, 1, -1.0)].map(Option::unwrap_or_default);
        let volume = volume(axes, &range, &lower, &upper, &without);
        Self {
            axes,
            range,
            lower,
            upper,
            without,
            volume,
            extremes,
            whole: None,
        }
    }

    /// The part above some sheets, below others, in a box and outside of others.
    #[must_use]
    pub fn part(
        &self,
        above: &[Sheet],
        below: &[Sheet],
        inside: Option<&[Vector; 2]>,
        outside: &[[Vector; 2]],
    ) -> Self {
        let mut range = self.range;
        let mut lower = [&self.lower[..], above].concat();
        let mut upper = [&self.upper[..], below].concat();
        if let Some([p1, p2]) = inside {
            range = common_range(&range, &plan_of(self.axes, p1, p2));
            lower.push(Sheet::Level(p1[self.axes - 1]));
            upper.push(Sheet::Level(p2[self.axes - 1]));
        }
        let without = [&self.without[..], outside].concat();
        let whole = self.whole.clone().unwrap_or_else(|| Arc::new(self.clone()));
        Self {
            whole: Some(whole),
            ..Self::from_parts(self.axes, range, lower, upper, without)
        }
    }

    /// The ground that also lies in another stratum.
    #[must_use]
    pub fn common(&self, other: &Self) -> Self {
        Self::from_parts(
            self.axes,
            common_range(&self.range, &other.range),
            [&self.lower[..], &other.lower].concat(),
            [&self.upper[..], &other.upper].concat(),
            [&self.without[..], &other.without].concat(),
        )
    }

    /// A point in it, where it is thickest near the place that holds most of it \[m\]; `None` if it is empty.
    #[must_use]
    pub fn place(&self) -> Option<Vector> {
        /// Halvings of the plan along each axis.
        const HALVINGS: usize = 12;
        let mut range = self.range;
        let held =
            |range: &PlanRange| volume(self.axes, range, &self.lower, &self.upper, &self.without);
        for halving in 0..2 * HALVINGS {
            let axis = halving % 2;
            let middle = 0.5 * (range[axis][0] + range[axis][1]);
            let (mut low, mut high) = (range, range);
            (low[axis][1], high[axis][0]) = (middle, middle);
            range = if held(&low) >= held(&high) { low } else { high };
        }
        let at = range.map(|[low, high]| 0.5 * (low + high));
        let mut intervals = vec![];
        self.intervals(at, &mut intervals);
        let thickest = intervals
            .into_iter()
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        let height = 0.5 * (thickest[0] + thickest[1]);
        Some(if self.axes == 2 {
            [at[0], height, 0.0]
        } else {
            [at[0], at[1], height]
        })
    }

    /// The ground of which it is a part, or itself.
    #[must_use]
    pub fn whole(&self) -> &Self {
        self.whole.as_deref().unwrap_or(self)
    }

    /// Number of axes, 2 or 3.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.axes
    }

    /// The rectangle of the plan \[m\].
    #[must_use]
    pub fn range(&self) -> &PlanRange {
        &self.range
    }

    /// The sheets above which all of it lies.
    #[must_use]
    pub fn lower(&self) -> &[Sheet] {
        &self.lower
    }

    /// The sheets below which all of it lies.
    #[must_use]
    pub fn upper(&self) -> &[Sheet] {
        &self.upper
    }

    /// Exact volume \[m³\]; in two dimensions area times unit thickness.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Points of the plan and heights that no part of it lies below and above \[m\].
    #[must_use]
    pub fn extremes(&self) -> &[Vector; 2] {
        &self.extremes
    }

    /// Lower and upper corner of a box around it \[m\].
    #[must_use]
    pub fn bounds(&self) -> [Vector; 2] {
        [0, 1].map(|side| {
            let height = self.extremes[side][2];
            let [u, v] = self.range.map(|range| range[side]);
            if self.axes == 2 {
                [u, height, 0.0]
            } else {
                [u, v, height]
            }
        })
    }

    /// Appends its intervals of height above a point of the plan, in ascending order \[m\].
    pub fn intervals(&self, at: PlanPoint, into: &mut Vec<[f64; 2]>) {
        let lower = self.lower.iter().map(|sheet| sheet.height(at));
        let upper = self.upper.iter().map(|sheet| sheet.height(at));
        let low = lower.reduce(|a, b| Some(a?.max(b?))).flatten();
        let high = upper.reduce(|a, b| Some(a?.min(b?))).flatten();
        let (Some(low), Some(high)) = (low, high) else {
            return;
        };
        if low >= high || (0..2).any(|axis| !inside(self.range[axis], at[axis])) {
            return;
        }
        let mut parts = vec![[low, high]];
        for [p1, p2] in &self.without {
            let range = plan_of(self.axes, p1, p2);
            // A point on a side of the box lies outside.
            if (0..2).any(|axis| at[axis] <= range[axis][0] || range[axis][1] <= at[axis]) {
                continue;
            }
            let [bottom, top] = [p1, p2].map(|corner| corner[self.axes - 1]);
            parts = (parts.iter())
                .flat_map(|[low, high]| [[*low, high.min(bottom)], [low.max(top), *high]])
                .filter(|[low, high]| low < high)
                .collect();
        }
        into.extend(parts);
    }

    /// The same ground in coordinates that begin at `origin` \[m\].
    #[must_use]
    pub fn relative_to(&self, origin: &Vector) -> Self {
        let by = if self.axes == 2 {
            [origin[0], 0.0, origin[1]]
        } else {
            *origin
        };
        let moved = |x: &Vector| -> Vector { std::array::from_fn(|axis| x[axis] - by[axis]) };
        let sheets = |all: &[Sheet]| all.iter().map(|sheet| sheet.relative_to(&by)).collect();
        Self {
            axes: self.axes,
            range: [0, 1].map(|axis| self.range[axis].map(|x| x - by[axis])),
            lower: sheets(&self.lower),
            upper: sheets(&self.upper),
            without: (self.without.iter())
                .map(|corners| {
                    corners.map(|corner| std::array::from_fn(|axis| corner[axis] - origin[axis]))
                })
                .collect(),
            volume: self.volume,
            extremes: [moved(&self.extremes[0]), moved(&self.extremes[1])],
            whole: (self.whole.as_ref()).map(|whole| Arc::new(whole.relative_to(origin))),
        }
    }
}

fn inside([low, high]: [f64; 2], x: f64) -> bool {
    low <= x && x <= high
}

/// The plan of a box; in two dimensions with the unit thickness.
fn plan_of(axes: usize, p1: &Vector, p2: &Vector) -> PlanRange {
    let across = if axes == 2 {
        [0.0, 1.0]
    } else {
        [p1[1], p2[1]]
    };
    [[p1[0], p2[0]], across]
}

/// The rectangle that two share; one whose ends are not in order if they share none.
fn common_range(a: &PlanRange, b: &PlanRange) -> PlanRange {
    [0, 1].map(|axis| [a[axis][0].max(b[axis][0]), a[axis][1].min(b[axis][1])])
}

/// Volume above all lower and below all upper sheets, less that of the boxes \[m³\].
fn volume(
    axes: usize,
    range: &PlanRange,
    lower: &[Sheet],
    upper: &[Sheet],
    without: &[[Vector; 2]],
) -> f64 {
    if range.iter().any(|[low, high]| low >= high) {
        return 0.0;
    }
    let Some(([p1, p2], others)) = without.split_last() else {
        return between(range, lower, upper);
    };
    let common = common_range(range, &plan_of(axes, p1, p2));
    let low = [lower, &[Sheet::Level(p1[axes - 1])]].concat();
    let high = [upper, &[Sheet::Level(p2[axes - 1])]].concat();
    let whole = volume(axes, range, lower, upper, others);
    whole - volume(axes, &common, &low, &high, others)
}

/// Volume above all lower and below all upper sheets \[m³\].
fn between(range: &PlanRange, lower: &[Sheet], upper: &[Sheet]) -> f64 {
    let sheets: Vec<&Sheet> = lower.iter().chain(upper).collect();
    let mut total = 0.0;
    overlay(range, &sheets, &mut |polygon, planes| {
        let (low, high) = planes.split_at(lower.len());
        for i in 0..low.len() {
            let over_i = part(polygon, low.len(), i, |k, p| low[i].at(p) - low[k].at(p));
            for j in 0..high.len() {
                let under_j = part(&over_i, high.len(), j, |k, p| high[k].at(p) - high[j].at(p));
                let thickness = |p: PlanPoint| high[j].at(p) - low[i].at(p);
                total += integral(&clip(&under_j, thickness), thickness);
            }
        }
    });
    total
}

/// The part of a polygon where one of several planes is ahead of all others; of planes that are one, the first is.
fn part(
    polygon: &[PlanPoint],
    count: usize,
    own: usize,
    ahead: impl Fn(usize, PlanPoint) -> f64,
) -> Vec<PlanPoint> {
    let mut part = polygon.to_vec();
    for other in (0..count).filter(|other| *other != own) {
        if part.iter().all(|p| ahead(other, *p) == 0.0) {
            if other < own {
                return vec![];
            }
        } else {
            part = clip(&part, |p| ahead(other, p));
        }
    }
    part
}

/// Integral of a linear function over a convex polygon.
fn integral(polygon: &[PlanPoint], value: impl Fn(PlanPoint) -> f64) -> f64 {
    let Some(&base) = polygon.first() else {
        return 0.0;
    };
    (polygon.windows(2).skip(1))
        .map(|pair| {
            let triangle = [base, pair[0], pair[1]];
            let mean = triangle.iter().map(|p| value(*p)).sum::<f64>() / 3.0;
            polygon_area(&triangle) * mean
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-12 * b.abs().max(1.0), "{a} {b}");
    }

    #[test]
    fn area_below_a_line_is_that_of_its_trapezia() {
        let top = Sheet::polyline(&[[0.0, 4.0], [3.0, 4.0], [7.0, 1.0], [10.0, 2.0]]);
        let whole = Stratum::new(2, [[0.0, 10.0], [0.0, 1.0]], Sheet::Level(0.0), top.clone());
        close(whole.volume(), 12.0 + 10.0 + 4.5);
        // The level of 2 m meets the line at x = 17/3 and at its end.
        let upper = whole.part(&[Sheet::Level(2.0)], &[], None, &[]);
        close(upper.volume(), 6.0 + 0.5 * (17.0 / 3.0 - 3.0) * 2.0);
        close(
            whole.part(&[], &[Sheet::Level(2.0)], None, &[]).volume() + upper.volume(),
            whole.volume(),
        );
        // The same sheet twice changes nothing.
        close(whole.part(&[], &[top], None, &[]).volume(), whole.volume());
        assert_eq!(whole.bounds(), [[0.0, 0.0, 0.0], [10.0, 4.0, 0.0]]);
    }

    #[test]
    fn boxes_are_taken_out_once_even_where_they_overlap() {
        let block = Stratum::of_box(3, &[0.0; 3], &[4.0, 4.0, 4.0]);
        let boxes = [[[0.0; 3], [2.0; 3]], [[1.0; 3], [3.0; 3]]];
        let left = block.part(&[], &[], None, &boxes);
        close(left.volume(), 64.0 - 8.0 - 8.0 + 1.0);
        let mut intervals = vec![];
        left.intervals([1.5, 1.5], &mut intervals);
        assert_eq!(intervals, [[3.0, 4.0]]);
        close(
            block.part(&[], &[], Some(&boxes[0]), &boxes[1..]).volume(),
            7.0,
        );
        let common = block.common(&Stratum::of_box(3, &[3.0; 3], &[9.0; 3]));
        close(common.volume(), 1.0);
        let place = common.place().unwrap();
        assert!(place.iter().all(|x| (3.0..=4.0).contains(x)), "{place:?}");
        assert_eq!(
            block
                .common(&Stratum::of_box(3, &[5.0; 3], &[9.0; 3]))
                .volume(),
            0.0
        );
    }

    #[test]
    fn two_planes_of_space_that_cross_leave_a_wedge() {
        let corners = vec![
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 2.0],
            [2.0, 3.0, 2.0],
            [0.0, 3.0, 0.0],
        ];
        let slope = Sheet::triangles(corners, vec![[0, 1, 2], [0, 2, 3]]);
        let wedge = Stratum::new(3, [[0.0, 2.0], [0.0, 3.0]], Sheet::Level(1.0), slope);
        close(wedge.volume(), 1.5);
        let moved = wedge.relative_to(&[1e3, 1e3, 1e3]);
        let mut intervals = vec![];
        moved.intervals([1.5 - 1e3, 1.0 - 1e3], &mut intervals);
        close(intervals[0][1] - intervals[0][0], 0.5);
    }
}
