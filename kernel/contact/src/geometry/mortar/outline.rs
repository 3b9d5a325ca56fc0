//! Polylines along the boundaries of shapes.

use super::boundary::{BoundarySide, Chain};
use super::{Point, cross};
use proctor_geometry::shape::{Shape, Vector};
use std::f64::consts::TAU;
use std::fmt;

/// Reason for which a shape gives no polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlineError {
    /// The length of a segment is not a positive number \[m\].
    Segment(f64),
    /// The shape has no boundary of its own: particles one by one, or a shape of another number of dimensions.
    Shape,
}

impl fmt::Display for OutlineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Segment(length) => {
                write!(f, "a segment of {length} m; its length must be positive")
            }
            Self::Shape => write!(
                f,
                "a shape without a boundary of its own: rectangles, discs, rings and polygons have one in two dimensions, \
                 cuboids, spheres, cylinders and extruded polygons in three"
            ),
        }
    }
}

impl std::error::Error for OutlineError {}

/// Vertices along the boundary of a shape, no more than `segment` \[m\] apart, equally spaced on each edge or circle.
/// The vertices of a circle lie on it.
///
/// # Errors
/// A length that is not positive, or a shape without an outline.
pub fn outline(shape: &Shape, segment: f64) -> Result<Vec<Chain>, OutlineError> {
    if !(segment > 0.0 && segment.is_finite()) {
        return Err(OutlineError::Segment(segment));
    }
    let outer = |points| Chain {
        points,
        side: BoundarySide::Outer,
    };
    match shape {
        Shape::Cuboid { p1, p2 } => Ok(vec![outer(along(&rectangle(p1, p2), segment))]),
        Shape::Sphere { center, radius } => Ok(vec![outer(circle(center, *radius, segment))]),
        Shape::Ring {
            center,
            inner,
            outer: radius,
        } => {
            let mut hole = circle(center, *inner, segment);
            hole.reverse();
            Ok(vec![
                outer(circle(center, *radius, segment)),
                Chain {
                    points: hole,
                    side: BoundarySide::Hole,
                },
            ])
        }
        Shape::Polygon { points } => Ok(vec![outer(along(&counter_clockwise(points), segment))]),
        Shape::Cylinder { .. }
        | Shape::ExtrudedPolygon { .. }
        | Shape::Stratum(_)
        | Shape::Enclosed(_)
        | Shape::Particles(_) => Err(OutlineError::Shape),
    }
}

/// Corners of the rectangle between two of them, counter-clockwise.
fn rectangle(p1: &Vector, p2: &Vector) -> [Point; 4] {
    [
        Point::new(p1[0], p1[1]),
        Point::new(p2[0], p1[1]),
        Point::new(p2[0], p2[1]),
        Point::new(p1[0], p2[1]),
    ]
}

/// Corners of a polygon, counter-clockwise.
fn counter_clockwise(points: &[Vector]) -> Vec<Point> {
    let mut corners: Vec<Point> = points.iter().map(|p| Point::new(p[0], p[1])).collect();
    if signed_area(&corners) < 0.0 {
        corners.reverse();
    }
    corners
}

/// Distance of a point from the boundary of a shape \[m\]; `None` for a shape without an outline of its own.
#[must_use]
pub fn distance_to_outline(shape: &Shape, x: &Point) -> Option<f64> {
    let from_circle = |center: &[f64; 3], radius: f64| {
        ((x - Point::new(center[0], center[1])).norm() - radius).abs()
    };
    let corners = match shape {
        Shape::Sphere { center, radius } => return Some(from_circle(center, *radius)),
        Shape::Ring {
            center,
            inner,
            outer,
        } => return Some(from_circle(center, *inner).min(from_circle(center, *outer))),
        Shape::Cuboid { p1, p2 } => rectangle(p1, p2).to_vec(),
        Shape::Polygon { points } => counter_clockwise(points),
        Shape::Cylinder { .. }
        | Shape::ExtrudedPolygon { .. }
        | Shape::Stratum(_)
        | Shape::Enclosed(_)
        | Shape::Particles(_) => {
            return None;
        }
    };
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges
        .map(|(a, b)| {
            let edge = b - a;
            let share = ((x - a).dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
            (x - a - share * edge).norm()
        })
        .min_by(f64::total_cmp)
}

/// About how many vertices [`outline`] would make, never far fewer: a number, since it may be too large to be one of
/// them. Zero for a shape without an outline.
#[must_use]
pub fn vertices(shape: &Shape, segment: f64) -> f64 {
    let circle = |radius: f64| TAU * radius / segment + 3.0;
    match shape {
        Shape::Cuboid { p1, p2 } => {
            2.0 * ((p2[0] - p1[0]) / segment + (p2[1] - p1[1]) / segment) + 4.0
        }
        Shape::Sphere { radius, .. } => circle(*radius),
        Shape::Ring { inner, outer, .. } => circle(*inner) + circle(*outer),
        Shape::Polygon { points } => {
            let corners: Vec<Point> = points.iter().map(|p| Point::new(p[0], p[1])).collect();
            around(&corners, segment)
        }
        Shape::Cylinder { .. }
        | Shape::ExtrudedPolygon { .. }
        | Shape::Stratum(_)
        | Shape::Enclosed(_)
        | Shape::Particles(_) => 0.0,
    }
}

/// About how many vertices [`along`] makes.
pub(super) fn around(corners: &[Point], segment: f64) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next);
    edges.map(|(a, b)| (b - a).norm() / segment + 1.0).sum()
}

/// Number of equal parts of a length that are no longer than `segment`. A length that is a multiple but for round-off
/// gets no part more.
pub(super) fn parts(length: f64, segment: f64) -> usize {
    ((length / segment) * (1.0 - 4.0 * f64::EPSILON))
        .ceil()
        .max(1.0) as usize
}

/// Vertices of a circle, counter-clockwise from the positive x axis.
fn circle(center: &[f64; 3], radius: f64, segment: f64) -> Vec<Point> {
    let count = parts(TAU * radius, segment).max(3);
    (0..count)
        .map(|k| {
            let (sin, cos) = libm::sincos(TAU * k as f64 / count as f64);
            Point::new(center[0] + radius * cos, center[1] + radius * sin)
        })
        .collect()
}

/// Corners of a closed polygon with vertices between them.
pub(super) fn along(corners: &[Point], segment: f64) -> Vec<Point> {
    let mut points = vec![];
    for (k, a) in corners.iter().enumerate() {
        let edge = corners[(k + 1) % corners.len()] - a;
        let count = parts(edge.norm(), segment);
        points.extend((0..count).map(|i| a + edge * (i as f64 / count as f64)));
    }
    points
}

pub(super) fn signed_area(corners: &[Point]) -> f64 {
    let Some(origin) = corners.first() else {
        return 0.0;
    };
    corners
        .windows(2)
        .map(|w| cross(&(w[0] - origin), &(w[1] - origin)))
        .sum()
}
