//! Boundaries that the tests share.

use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{Boundary, BoundarySide, Chain};

pub fn point(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

pub fn open(points: &[[f64; 2]]) -> Boundary {
    Boundary::new(&[chain(points, BoundarySide::Open)]).expect("the line is sound")
}

pub fn chain(points: &[[f64; 2]], side: BoundarySide) -> Chain {
    Chain {
        points: points.iter().map(|p| point(p[0], p[1])).collect(),
        side,
    }
}

/// A floor with its material below: outward is up. Vertices at the given x, at a height.
pub fn floor(xs: &[f64], y: f64) -> Boundary {
    let mut points: Vec<[f64; 2]> = xs.iter().map(|x| [*x, y]).collect();
    points.reverse();
    open(&points)
}

/// A ceiling with its material above: outward is down.
pub fn ceiling(xs: &[f64], y: f64) -> Boundary {
    open(&xs.iter().map(|x| [*x, y]).collect::<Vec<_>>())
}

/// Turns a boundary by an angle about the origin, then shifts it.
pub fn moved(boundary: &Boundary, angle: f64, shift: Point) -> Boundary {
    let turn = nalgebra::Rotation2::new(angle);
    let mut out = boundary.clone();
    for p in &mut out.points {
        *p = turn * *p + shift;
    }
    out
}

pub fn at_rest(boundary: &Boundary) -> Vec<Point> {
    vec![Point::zeros(); boundary.points.len()]
}
