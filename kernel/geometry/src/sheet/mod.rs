//! Sheets: surfaces with one height above each point of the plan, such as a terrain or the base of a layer.
//!
//! The plan is x and y in three dimensions. In two dimensions it is x, and a strip of 1 m across it: areas are then volumes
//! for unit thickness. Between its corners a sheet is made of plane triangles, so that volumes between sheets are exact.

mod bins;
mod facets;
mod overlay;

pub(crate) use bins::Bins;
pub use facets::Facets;
pub(crate) use facets::rectangle;
pub(crate) use overlay::{clip, overlay, polygon_area};

use crate::vector::Vector;
use std::sync::Arc;

/// A point of the plan \[m\].
pub type PlanPoint = [f64; 2];

/// A rectangle of the plan \[m\]: lower and upper coordinate per axis.
pub type PlanRange = [[f64; 2]; 2];

/// Share of an area below which a gap or a fold of a sheet is round-off.
const NEARLY: f64 = 1e-9;
/// Halvings of a rectangle until the place of a fault is known to a thousandth of it.
const HALVINGS: usize = 20;

/// A surface with one height above each point of the plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Sheet {
    /// The same height everywhere \[m\].
    Level(f64),
    /// Plane triangles.
    Facets(Arc<Facets>),
}

/// A place where a sheet has not exactly one height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SheetFault {
    /// There is no height.
    Hole(PlanPoint),
    /// There is more than one height.
    Fold(PlanPoint),
}

impl Sheet {
    /// A line of points x, y in ascending order of x, for two dimensions \[m\].
    #[must_use]
    pub fn polyline(points: &[[f64; 2]]) -> Self {
        let u: Vec<f64> = points.iter().map(|point| point[0]).collect();
        let row = points.iter().map(|point| point[1]);
        let heights: Vec<f64> = row.clone().chain(row).collect();
        Self::grid(&u, &[0.0, 1.0], &heights)
    }

    /// Heights at the points of a grid \[m\], row by row of the second coordinate. A cell with a corner that is not a number is
    /// a hole. Each other cell is two triangles, divided from its lower left to its upper right corner.
    #[must_use]
    pub fn grid(u: &[f64], v: &[f64], heights: &[f64]) -> Self {
        let corners = (v.iter())
            .flat_map(|y| u.iter().map(move |x| [*x, *y]))
            .zip(heights)
            .map(|([x, y], z)| [x, y, *z])
            .collect();
        let mut triangles = vec![];
        for row in 1..v.len() {
            for column in 1..u.len() {
                let upper = row * u.len() + column;
                let lower = upper - u.len();
                let cell = [lower - 1, lower, upper, upper - 1];
                if cell.iter().all(|corner| heights[*corner].is_finite()) {
                    let [a, b, c, d] = cell.map(|corner| corner as u32);
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        Self::Facets(Arc::new(Facets::new(corners, triangles)))
    }

    /// Triangles by their corners \[m\]; the last coordinate is the height.
    #[must_use]
    pub fn triangles(corners: Vec<Vector>, triangles: Vec<[u32; 3]>) -> Self {
        Self::Facets(Arc::new(Facets::new(corners, triangles)))
    }

    /// The height above a point \[m\]; `None` in a hole.
    #[must_use]
    pub fn height(&self, at: PlanPoint) -> Option<f64> {
        match self {
            Self::Level(height) => Some(*height),
            Self::Facets(facets) => facets.height(at),
        }
    }

    /// The rectangle around it in plan \[m\]; `None` of a level, which has no end.
    #[must_use]
    pub fn extent(&self) -> Option<PlanRange> {
        match self {
            Self::Level(_) => None,
            Self::Facets(facets) => Some(facets.extent()),
        }
    }

    /// A place in the rectangle where it has not exactly one height.
    #[must_use]
    pub fn fault(&self, range: &PlanRange) -> Option<SheetFault> {
        let excess = |range: &PlanRange| {
            let whole = polygon_area(&corners_of(range));
            let mut covered = 0.0;
            overlay(range, &[self], &mut |polygon, _| {
                covered += polygon_area(polygon);
            });
            covered / whole - 1.0
        };
        let whole = excess(range);
        if whole.abs() <= NEARLY {
            return None;
        }
        let mut range = *range;
        for halving in 0..HALVINGS {
            let axis = halving % 2;
            let middle = 0.5 * (range[axis][0] + range[axis][1]);
            let (mut low, mut high) = (range, range);
            (low[axis][1], high[axis][0]) = (middle, middle);
            range = if excess(&low) * whole.signum() >= excess(&high) * whole.signum() {
                low
            } else {
                high
            };
        }
        let at = range.map(|[low, high]| 0.5 * (low + high));
        Some(if whole < 0.0 {
            SheetFault::Hole(at)
        } else {
            SheetFault::Fold(at)
        })
    }

    /// Its lowest and its highest point in a rectangle of the plan \[m\].
    #[must_use]
    pub fn extremes(&self, range: &PlanRange) -> [Vector; 2] {
        let at = range.map(|[low, _]| low);
        let mut found = match self {
            Self::Level(height) => return [[at[0], at[1], *height]; 2],
            Self::Facets(_) => [
                [at[0], at[1], f64::INFINITY],
                [at[0], at[1], f64::NEG_INFINITY],
            ],
        };
        overlay(range, &[self], &mut |polygon, planes| {
            for point in polygon {
                let height = planes[0].at(*point);
                let here = [point[0], point[1], height];
                if height < found[0][2] {
                    found[0] = here;
                }
                if height > found[1][2] {
                    found[1] = here;
                }
            }
        });
        found
    }

    /// The same sheet in coordinates that begin at `origin` \[m\].
    #[must_use]
    pub fn relative_to(&self, origin: &Vector) -> Self {
        match self {
            Self::Level(height) => Self::Level(height - origin[2]),
            Self::Facets(facets) => Self::Facets(Arc::new(facets.relative_to(origin))),
        }
    }

    /// The place where the other sheet lies farthest below this one in a rectangle of the plan, with both heights \[m\];
    /// `None` where it lies nowhere below.
    #[must_use]
    pub fn above(&self, other: &Self, range: &PlanRange) -> Option<(PlanPoint, [f64; 2])> {
        let mut worst: Option<(PlanPoint, [f64; 2])> = None;
        overlay(range, &[self, other], &mut |polygon, planes| {
            for point in polygon {
                let heights = [planes[0].at(*point), planes[1].at(*point)];
                let by = heights[0] - heights[1];
                let round_off = NEARLY * (heights[0].abs() + heights[1].abs());
                if by > round_off && worst.is_none_or(|(_, [a, b])| by > a - b) {
                    worst = Some((*point, heights));
                }
            }
        });
        worst
    }
}

/// The corners of a rectangle, counter-clockwise.
pub(crate) fn corners_of([[a, b], [c, d]]: &PlanRange) -> Vec<PlanPoint> {
    vec![[*a, *c], [*b, *c], [*b, *d], [*a, *d]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: PlanRange = [[0.0, 2.0], [0.0, 1.0]];

    fn line() -> Sheet {
        Sheet::polyline(&[[0.0, 1.0], [1.0, 3.0], [2.0, 3.0]])
    }

    #[test]
    fn heights_of_a_line_are_linear_between_its_points() {
        for (x, y) in [(0.0, 1.0), (0.25, 1.5), (1.0, 3.0), (1.9, 3.0), (2.0, 3.0)] {
            assert!((line().height([x, 0.5]).unwrap() - y).abs() < 1e-15, "{x}");
        }
        assert_eq!(line().height([2.1, 0.5]), None);
        let [low, high] = line().extremes(&UNIT);
        assert_eq!((low[0], low[2], high[2]), (0.0, 1.0, 3.0));
    }

    #[test]
    fn a_hole_is_found_where_it_is() {
        let ticks: Vec<f64> = (0..11).map(f64::from).collect();
        let mut heights = vec![1.0; 121];
        assert_eq!(
            Sheet::grid(&ticks, &ticks, &heights).fault(&[[0.0, 10.0]; 2]),
            None
        );
        heights[7 * 11 + 3] = f64::NAN;
        let sheet = Sheet::grid(&ticks, &ticks, &heights);
        let Some(SheetFault::Hole([x, y])) = sheet.fault(&[[0.0, 10.0]; 2]) else {
            panic!("no hole");
        };
        assert!(
            (2.0..=4.0).contains(&x) && (6.0..=8.0).contains(&y),
            "{x} {y}"
        );
        assert_eq!(sheet.fault(&[[4.0, 10.0], [0.0, 10.0]]), None);
    }

    #[test]
    fn a_fold_is_found() {
        let corners = vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ];
        let twice = Sheet::triangles(corners, vec![[0, 1, 2], [0, 2, 3], [0, 1, 3]]);
        let fault = twice.fault(&[[0.0, 1.0]; 2]);
        assert!(
            matches!(fault, Some(SheetFault::Fold([x, y])) if x + y < 1.0),
            "{fault:?}"
        );
    }

    #[test]
    fn sheets_that_cross_are_told_with_the_place() {
        let falling = Sheet::polyline(&[[0.0, 4.0], [2.0, 0.0]]);
        let (at, heights) = falling.above(&line(), &UNIT).unwrap();
        assert_eq!((at[0], heights), (0.0, [4.0, 1.0]));
        assert_eq!(Sheet::Level(1.0).above(&line(), &UNIT), None);
    }
}
