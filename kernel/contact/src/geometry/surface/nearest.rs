//! The nearest point of a triangle, and the side of the surface that a point is on.

use super::{Point, Surface, dot, minus};

/// Part of a triangle on which its nearest point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Inside.
    Face,
    /// The edge from corner i to corner i + 1.
    Edge(usize),
    /// The corner i.
    Vertex(usize),
}

/// The point of a surface nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// Triangle, counted from 0.
    pub triangle: usize,
    /// Feature of the triangle.
    pub feature: Feature,
    /// The point \[m\].
    pub point: Point,
    /// Distance \[m\], positive on the side to which the normals point.
    pub distance: f64,
    /// Unit normal, the direction in which the distance grows fastest: of the triangle over its inside, else along
    /// the line to the point.
    pub normal: Point,
    /// True if the nearest point lies on an edge of one triangle only: the surface ends there, and the point lies
    /// beside it rather than over it.
    pub on_rim: bool,
}

/// The best triangle so far.
pub(super) struct NearestTriangle {
    /// Squared distance, triangle, feature, point.
    found: Option<(f64, usize, Feature, Point)>,
    limit: f64,
}

impl NearestTriangle {
    pub fn new(within: f64) -> Self {
        Self {
            found: None,
            limit: within * within,
        }
    }

    /// Squared distance that a triangle must not exceed.
    pub fn limit(&self) -> f64 {
        self.found.map_or(self.limit, |found| found.0)
    }

    pub fn look_at(&mut self, surface: &Surface, triangle: usize, x: &Point) {
        let (point, feature) = on_triangle(x, &surface.corners(triangle));
        let d = minus(x, &point);
        let square = dot(&d, &d);
        let better = match &self.found {
            None => square < self.limit,
            // Of equally near triangles the first one, in whatever order they are looked at.
            Some((best, first, ..)) => (square, triangle) < (*best, *first),
        };
        if better {
            self.found = Some((square, triangle, feature, point));
        }
    }

    pub fn finish(self, surface: &Surface, x: &Point) -> Option<NearestPoint> {
        let (square, triangle, feature, point) = self.found?;
        let (pseudo, on_rim) = match feature {
            Feature::Face => (surface.normals[triangle], false),
            Feature::Edge(i) => (
                surface.edge_normals[triangle][i],
                surface.edge_is_open[triangle][i],
            ),
            Feature::Vertex(i) => {
                let v = surface.triangles[triangle][i] as usize;
                (surface.vertex_normals[v], surface.vertex_is_open[v])
            }
        };
        let away = minus(x, &point);
        let side = dot(&away, &pseudo);
        let sign = if side < 0.0 { -1.0 } else { 1.0 };
        let distance = square.sqrt();
        let scale = x.iter().chain(&point).fold(0.0_f64, |m, c| m.max(c.abs()));
        // Over a face the normal is that of the triangle, the same bits wherever the point is; so close to an edge
        // that the line to the point is round-off, it is the pseudo-normal.
        let normal = if feature == Feature::Face || distance <= 1e-9 * scale {
            pseudo
        } else {
            away.map(|c| sign * c / distance)
        };
        let on_face = if feature == Feature::Face {
            side
        } else {
            sign * distance
        };
        Some(NearestPoint {
            triangle,
            feature,
            point,
            distance: on_face,
            normal,
            on_rim,
        })
    }
}

/// The point of a triangle nearest to `x` (Ericson 2005, Real-Time Collision Detection, section 5.1.5).
fn on_triangle(x: &Point, [a, b, c]: &[Point; 3]) -> (Point, Feature) {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let (ax, bx, cx) = (minus(x, a), minus(x, b), minus(x, c));
    let (d1, d2) = (dot(&ab, &ax), dot(&ac, &ax));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (*a, Feature::Vertex(0));
    }
    let (d3, d4) = (dot(&ab, &bx), dot(&ac, &bx));
    if d3 >= 0.0 && d4 <= d3 {
        return (*b, Feature::Vertex(1));
    }
    let along = |from: &Point, to: &Point, share: f64| -> Point {
        std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]))
    };
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (along(a, b, d1 / (d1 - d3)), Feature::Edge(0));
    }
    let (d5, d6) = (dot(&ab, &cx), dot(&ac, &cx));
    if d6 >= 0.0 && d5 <= d6 {
        return (*c, Feature::Vertex(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (along(a, c, d2 / (d2 - d6)), Feature::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (along(b, c, share), Feature::Edge(1));
    }
    let denominator = 1.0 / (va + vb + vc);
    let (v, w) = (vb * denominator, vc * denominator);
    (
        std::array::from_fn(|axis| a[axis] + v * ab[axis] + w * ac[axis]),
        Feature::Face,
    )
}
