//! Overlay: a rectangle of the plan cut into polygons above each of which every sheet is one plane.

use super::facets::Plane;
use super::{PlanPoint, PlanRange, Sheet, corners_of};

/// Visits the polygons of a rectangle with the planes of the sheets, in their order. Where a sheet has a hole there is none.
pub(crate) fn overlay(
    range: &PlanRange,
    sheets: &[&Sheet],
    visit: &mut dyn FnMut(&[PlanPoint], &[Plane]),
) {
    cut(&corners_of(range), sheets, &mut vec![], visit);
}

fn cut(
    polygon: &[PlanPoint],
    sheets: &[&Sheet],
    planes: &mut Vec<Plane>,
    visit: &mut dyn FnMut(&[PlanPoint], &[Plane]),
) {
    let Some((first, others)) = sheets.split_first() else {
        visit(polygon, planes);
        return;
    };
    match first {
        Sheet::Level(height) => {
            planes.push(Plane::level(*height));
            cut(polygon, others, planes, visit);
            planes.pop();
        }
        Sheet::Facets(facets) => {
            for triangle in facets.near(&around(polygon)) {
                let corners = facets.plan(triangle);
                let mut part = polygon.to_vec();
                for side in 0..3 {
                    let (a, b) = (corners[side], corners[(side + 1) % 3]);
                    part = clip(&part, |p| {
                        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
                    });
                }
                if part.len() > 2 && polygon_area(&part) > 0.0 {
                    planes.push(facets.plane(triangle));
                    cut(&part, others, planes, visit);
                    planes.pop();
                }
            }
        }
    }
}

/// The part of a convex polygon where a linear function is not negative.
pub(crate) fn clip(polygon: &[PlanPoint], value: impl Fn(PlanPoint) -> f64) -> Vec<PlanPoint> {
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (at_a, at_b) = (value(a), value(b));
        if at_a >= 0.0 {
            part.push(a);
        }
        if (at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0) {
            let share = at_a / (at_a - at_b);
            part.push([0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis])));
        }
    }
    part
}

/// Area of a polygon that runs counter-clockwise \[m²\].
pub(crate) fn polygon_area(polygon: &[PlanPoint]) -> f64 {
    let Some(base) = polygon.first() else {
        return 0.0;
    };
    let mut twice = 0.0;
    for pair in polygon.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| [p[0] - base[0], p[1] - base[1]]);
        twice += a[0] * b[1] - b[0] * a[1];
    }
    0.5 * twice
}

fn around(polygon: &[PlanPoint]) -> PlanRange {
    [0, 1].map(|axis| {
        let x = polygon.iter().map(|point| point[axis]);
        x.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    })
}
