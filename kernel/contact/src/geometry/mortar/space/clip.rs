//! Overlap of two triangles of a plane, and points of a quadrature on it.

use crate::geometry::mortar::cross;
use nalgebra::Vector2;

/// A point of an auxiliary plane \[m\].
pub type PlanePoint = Vector2<f64>;

/// Corners that two triangles can have in common at most.
const MOST: usize = 6;

/// A convex polygon, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon {
    corners: [PlanePoint; MOST + 1],
    count: usize,
}

impl Polygon {
    fn new() -> Self {
        Self {
            corners: [PlanePoint::zeros(); MOST + 1],
            count: 0,
        }
    }

    fn push(&mut self, corner: PlanePoint) {
        // Round-off can give a corner twice, but never more than one too many.
        if self.count <= MOST {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }

    /// The corners.
    #[must_use]
    pub fn corners(&self) -> &[PlanePoint] {
        &self.corners[..self.count]
    }

    /// Triangles from the first corner to all others.
    pub fn fan(&self) -> impl Iterator<Item = [PlanePoint; 3]> {
        let corners = self.corners();
        corners
            .windows(2)
            .skip(1)
            .map(move |pair| [corners[0], pair[0], pair[1]])
    }

    /// Area \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        self.fan().map(|t| area(&t)).sum()
    }
}

/// Area of a triangle \[m²\], positive when counter-clockwise.
#[must_use]
pub fn area([a, b, c]: &[PlanePoint; 3]) -> f64 {
    0.5 * cross(&(b - a), &(c - a))
}

/// Intersection of two counter-clockwise triangles: the first cut along each edge of the second in turn
/// (Sutherland and Hodgman 1974).
#[must_use]
pub fn overlap(subject: &[PlanePoint; 3], clip: &[PlanePoint; 3]) -> Polygon {
    let mut polygon = Polygon::new();
    for corner in subject {
        polygon.push(*corner);
    }
    for edge in 0..3 {
        let (from, to) = (clip[edge], clip[(edge + 1) % 3]);
        // Distance inside of the edge, times its length.
        let inside = |p: &PlanePoint| cross(&(to - from), &(p - from));
        let mut cut = Polygon::new();
        let corners = polygon.corners();
        for (k, p) in corners.iter().enumerate() {
            let q = &corners[(k + 1) % corners.len()];
            let (here, next) = (inside(p), inside(q));
            if here >= 0.0 {
                cut.push(*p);
            }
            if (here > 0.0 && next < 0.0) || (here < 0.0 && next > 0.0) {
                cut.push(p + (q - p) * (here / (here - next)));
            }
        }
        polygon = cut;
    }
    polygon
}

/// Shares of the corners of a triangle at the three points of a quadrature that is exact for squares, each with a third
/// of the area. Products of two shape functions, each linear in the plane, are squares, so that more points would change
/// nothing.
pub const GAUSS: [[f64; 3]; 3] = [
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// Shares of the corners of a triangle at a point of its plane; their sum is 1, and all are positive inside.
#[must_use]
pub fn shares(p: &PlanePoint, triangle @ [a, b, c]: &[PlanePoint; 3]) -> [f64; 3] {
    let twice = 2.0 * area(triangle);
    let of_b = cross(&(p - a), &(c - a)) / twice;
    let of_c = cross(&(b - a), &(p - a)) / twice;
    [1.0 - of_b - of_c, of_b, of_c]
}
