//! Simple polygons, convex or not, and polygons extruded along an axis.

use super::FilledBody;
use super::error::FillError;
use super::lattice::Lattice;
use crate::shape::Vector;
use std::ops::Range;

/// A point of the plane, relative to the mesh \[m\].
type Point = [f64; 2];

/// Area between the corners \[m²\], either orientation.
pub(super) fn area(points: &[Point]) -> f64 {
    let Some(base) = points.first() else {
        return 0.0;
    };
    // Corners from the first one: far from the origin the products of coordinates would cancel.
    let mut twice = 0.0;
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| [p[0] - base[0], p[1] - base[1]]);
        twice += a[0] * b[1] - b[0] * a[1];
    }
    0.5 * twice.abs()
}

/// Smallest and largest coordinate \[m\]. Not finite where a corner is not.
fn bounds(points: &[Point], axis: usize) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for point in points {
        if !point[axis].is_finite() {
            return [point[axis]; 2];
        }
        range = [range[0].min(point[axis]), range[1].max(point[axis])];
    }
    range
}

/// Effect of the edges on one row of sub-cells.
#[derive(Default)]
struct Cuts {
    /// Coordinates where an edge crosses the line through the centres of the row.
    crossings: Vec<f64>,
    /// Ranges of the line that are on an edge, within the tolerance.
    bands: Vec<[f64; 2]>,
}

/// The sub-cells inside a polygon, as runs along the second of two axes.
struct Rows {
    first: i64,
    runs: Vec<Vec<Range<i64>>>,
}

impl Rows {
    /// Visits each edge once for each row that it meets.
    ///
    /// # Errors
    /// Rows and edges that need more memory than there is room for.
    fn new(
        lattice: &Lattice,
        axes: [usize; 2],
        points: &[Point],
        rows: Range<i64>,
    ) -> Result<Self, FillError> {
        let tolerance = lattice.distance_tolerance();
        let mut needed =
            (rows.end - rows.start) as f64 * size_of::<(Cuts, Vec<Range<i64>>)>() as f64;
        for (corner, a) in points.iter().enumerate() {
            let b = points[(corner + 1) % points.len()];
            let met = lattice.between(axes[0], a[0].min(b[0]), a[0].max(b[0]));
            needed +=
                (met.end - met.start) as f64 * size_of::<([f64; 2], f64, Range<i64>)>() as f64;
        }
        lattice.require_room(0.0, needed)?;
        let mut cuts: Vec<Cuts> = rows.clone().map(|_| Cuts::default()).collect();
        for (corner, &a) in points.iter().enumerate() {
            let b = points[(corner + 1) % points.len()];
            let (a, b) = if a[0] <= b[0] { (a, b) } else { (b, a) };
            // The end points themselves where the line misses the edge, so that a corner is one number.
            let at = |x: f64| {
                if x <= a[0] {
                    a[1]
                } else if x >= b[0] {
                    b[1]
                } else {
                    a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
                }
            };
            let near = lattice.between(axes[0], a[0] - tolerance, b[0] + tolerance);
            for k in near.start.max(rows.start)..near.end.min(rows.end) {
                let x = lattice.centre(axes[0], k);
                let cut = &mut cuts[(k - rows.start) as usize];
                // The edge thickened by a square of the tolerance, cut by the line.
                let (y0, y1) = (at(x - tolerance), at(x + tolerance));
                cut.bands
                    .push([y0.min(y1) - tolerance, y0.max(y1) + tolerance]);
                // Half-open, so that a line through a corner crosses one of its edges, or both, or none.
                if a[0] <= x && x < b[0] {
                    cut.crossings.push(at(x));
                }
            }
        }
        let inside = |cut: Cuts| {
            cut.inside()
                .map(|[y0, y1]| lattice.between(axes[1], y0, y1))
                .collect()
        };
        Ok(Self {
            first: rows.start,
            runs: cuts.into_iter().map(inside).collect(),
        })
    }

    fn row(&self, k: i64) -> &[Range<i64>] {
        usize::try_from(k - self.first)
            .ok()
            .and_then(|row| self.runs.get(row))
            .map_or(&[], Vec::as_slice)
    }

    fn contains(&self, row: i64, k: i64) -> bool {
        let runs = self.row(row);
        let after = runs.partition_point(|run| run.start <= k);
        after > 0 && k < runs[after - 1].end
    }
}

impl Cuts {
    /// The open intervals inside the polygon, ascending.
    ///
    /// Bands hold every crossing, so each gap between bands is inside or outside as a whole, and the parity
    /// of the crossings below it cannot be spoilt by their round-off.
    fn inside(mut self) -> impl Iterator<Item = [f64; 2]> {
        self.crossings.sort_unstable_by(f64::total_cmp);
        self.bands.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let mut end = f64::INFINITY;
        self.bands.into_iter().filter_map(move |[lower, upper]| {
            let gap = [end, lower];
            end = if end.is_finite() {
                end.max(upper)
            } else {
                upper
            };
            if gap[0] >= gap[1] {
                return None;
            }
            let middle = 0.5 * (gap[0] + gap[1]);
            let below = self.crossings.partition_point(|&y| y < middle);
            (below % 2 == 1).then_some(gap)
        })
    }
}

/// Particles of a polygon in two dimensions; corners in the coordinates of the scene \[m\].
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill(lattice: &Lattice, points: &[Vector]) -> Result<FilledBody, FillError> {
    let points: Vec<Point> = points
        .iter()
        .map(|&point| lattice.relative(point))
        .map(|[x, y, _]| [x, y])
        .collect();
    let bounds = [bounds(&points, 0), bounds(&points, 1), [0.0, 0.0]];
    let volume = area(&points);
    FillError::require_positive("area of the polygon", None, volume)?;
    let [rows, ..] = lattice.reach(&bounds)?;
    let rows = Rows::new(lattice, [0, 1], &points, rows)?;
    lattice.sweep(&bounds, volume, |[i, _], runs| {
        runs.extend_from_slice(rows.row(i));
    })
}

/// Particles of a polygon extruded along an axis; coordinates of the scene \[m\].
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill_extruded(
    lattice: &Lattice,
    points: &[Point],
    axis: usize,
    range: [f64; 2],
) -> Result<FilledBody, FillError> {
    let plane = match axis {
        0 => [1, 2],
        1 => [0, 2],
        2 => [0, 1],
        _ => return Err(FillError::Axis(axis)),
    };
    let relative = |axis: usize, x: f64| {
        let mut point = [0.0; 3];
        point[axis] = x;
        lattice.relative(point)[axis]
    };
    let points: Vec<Point> = points
        .iter()
        .map(|point| [relative(plane[0], point[0]), relative(plane[1], point[1])])
        .collect();
    let [lower, upper] = range.map(|x| relative(axis, x));
    let area = area(&points);
    FillError::require_positive("area of the polygon", None, area)?;
    let mut box_of_body = [[lower, upper]; 3];
    for side in 0..2 {
        box_of_body[plane[side]] = bounds(&points, side);
    }
    let reach = lattice.reach(&box_of_body)?;
    let rows = Rows::new(lattice, plane, &points, reach[plane[0]].clone())?;
    let tolerance = lattice.distance_tolerance();
    let along = lattice.between(axis, lower + tolerance, upper - tolerance);
    lattice.sweep(
        &box_of_body,
        area * (upper - lower),
        |[i, j], runs| match axis {
            0 if along.contains(&i) => runs.extend_from_slice(rows.row(j)),
            1 if along.contains(&j) => runs.extend_from_slice(rows.row(i)),
            2 if rows.contains(i, j) => runs.push(along.clone()),
            _ => {}
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_far_from_the_origin_either_orientation() {
        let mut l_shape: Vec<Point> =
            [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 3.], [0., 3.]].to_vec();
        assert_eq!(area(&l_shape), 4.0);
        l_shape.reverse();
        for point in &mut l_shape {
            *point = [point[0] + 1e9, point[1] - 1e9];
        }
        assert_eq!(area(&l_shape), 4.0);
        assert_eq!(area(&[]), 0.0);
    }

    #[test]
    fn gaps_with_an_odd_number_of_crossings_below_are_inside() {
        // Two teeth, and a notch whose tip touches the line at 0.5: a band without crossing.
        let cuts = Cuts {
            crossings: vec![3.0, 0.0, 2.0, 1.0],
            bands: vec![[2.9, 3.1], [0.4, 0.6], [-0.1, 0.1], [1.9, 2.1], [0.9, 1.1]],
        };
        let inside: Vec<[f64; 2]> = cuts.inside().collect();
        assert_eq!(inside, [[0.1, 0.4], [0.6, 0.9], [2.1, 2.9]]);
    }
}
