//! Enclosed bodies: the inside of a closed surface of triangles.

use crate::number::fingerprint_of;
use crate::sheet::{Bins, PlanPoint, rectangle};
use crate::vector::Vector;
use std::fmt;

/// The inside of a closed surface: a point lies inside if a ray from it meets the surface an odd number of times.
#[derive(Clone, PartialEq)]
pub struct EnclosedRegion {
    corners: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
    bins: Bins,
    bounds: [Vector; 2],
    volume: f64,
}

impl EnclosedRegion {
    /// A closed surface by corners that its triangles share \[m\], each edge in two triangles that run along it in opposite
    /// directions.
    #[must_use]
    pub fn new(corners: Vec<Vector>, triangles: Vec<[u32; 3]>) -> Self {
        let of = |triangle: &[u32; 3]| triangle.map(|corner| corners[corner as usize]);
        let rectangles: Vec<_> = triangles.iter().map(|t| rectangle(&of(t))).collect();
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for corner in &corners {
            bounds[0] = std::array::from_fn(|axis| bounds[0][axis].min(corner[axis]));
            bounds[1] = std::array::from_fn(|axis| bounds[1][axis].max(corner[axis]));
        }
        // From a corner: far from the origin the products of coordinates would cancel.
        let base = corners.first().copied().unwrap_or_default();
        let sixfold: f64 = (triangles.iter())
            .map(|triangle| {
                let [a, b, c] = of(triangle)
                    .map(|x| -> Vector { std::array::from_fn(|axis| x[axis] - base[axis]) });
                a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0])
            })
            .sum();
        Self {
            bins: Bins::new(&rectangles),
            bounds,
            volume: sixfold.abs() / 6.0,
            corners,
            triangles,
        }
    }

    /// Volume \[m³\]; that of a cavity counts negative if its triangles face into it.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Lower and upper corner of the box around it \[m\].
    #[must_use]
    pub fn bounds(&self) -> [Vector; 2] {
        self.bounds
    }

    /// Appends its intervals of height above a point of the plan, in ascending order \[m\].
    pub fn intervals(&self, at: PlanPoint, into: &mut Vec<[f64; 2]>) {
        let mut heights: Vec<f64> = (self.bins.at(at).iter())
            .filter_map(|triangle| {
                let corners =
                    self.triangles[*triangle as usize].map(|corner| self.corners[corner as usize]);
                meets(&corners, at).then(|| height(&corners, at))
            })
            .collect();
        heights.sort_unstable_by(f64::total_cmp);
        into.extend(heights.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
    }

    /// The same body in coordinates that begin at `origin` \[m\].
    #[must_use]
    pub fn relative_to(&self, origin: &Vector) -> Self {
        let moved = |x: &Vector| -> Vector { std::array::from_fn(|axis| x[axis] - origin[axis]) };
        Self {
            corners: self.corners.iter().map(moved).collect(),
            triangles: self.triangles.clone(),
            bins: self.bins.relative_to([origin[0], origin[1]]),
            bounds: [moved(&self.bounds[0]), moved(&self.bounds[1])],
            volume: self.volume,
        }
    }
}

impl fmt::Debug for EnclosedRegion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Enclosed")
            .field("triangles", &self.triangles.len())
            .field("bounds", &self.bounds)
            .field("volume", &self.volume)
            .field(
                "fingerprint",
                &fingerprint_of(&self.corners, &self.triangles),
            )
            .finish_non_exhaustive()
    }
}

/// Meeting of a vertical line with a triangle. A line through an edge meets exactly one of the two triangles that share it in
/// plan, as each asks the same question of the edge.
fn meets(corners: &[Vector; 3], [u, v]: PlanPoint) -> bool {
    let crosses = |side: &usize| {
        let (a, b) = (corners[*side], corners[(side + 1) % 3]);
        let (a, b) = if (a[1], a[0]) <= (b[1], b[0]) {
            (a, b)
        } else {
            (b, a)
        };
        a[1] <= v && v < b[1] && u < a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    (0..3).filter(crosses).count() % 2 == 1
}

/// Height of the plane of a triangle, within those of its corners.
fn height(&[a, b, c]: &[Vector; 3], at: PlanPoint) -> f64 {
    let [p, q]: [Vector; 2] = [b, c].map(|x| std::array::from_fn(|k| x[k] - a[k]));
    let (du, dv) = (at[0] - a[0], at[1] - a[1]);
    let area = p[0] * q[1] - p[1] * q[0];
    let (s, t) = (
        (du * q[1] - dv * q[0]) / area,
        (p[0] * dv - p[1] * du) / area,
    );
    let z = a[2] + s * p[2] + t * q[2];
    z.max(a[2].min(b[2]).min(c[2]))
        .min(a[2].max(b[2]).max(c[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_through_edges_and_corners_of_a_tetrahedron() {
        let corners = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
        let body = EnclosedRegion::new(corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        assert!((body.volume() - 8.0 / 6.0).abs() < 1e-15);
        for (at, length) in [([0.5, 0.5], 1.0), ([0.25, 0.75], 1.0), ([1.5, 1.0], 0.0)] {
            let mut found = vec![];
            body.intervals(at, &mut found);
            let sum: f64 = found.iter().map(|[low, high]| high - low).sum();
            assert!((sum - length).abs() < 1e-15, "{at:?} {found:?}");
        }
        let far = body.relative_to(&[-1e3; 3]);
        let mut found = vec![];
        far.intervals([1000.5, 1000.5], &mut found);
        assert_eq!(found, [[1000.0, 1001.0]]);
    }
}
