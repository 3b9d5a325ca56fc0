//! Boundaries in each other: crossing, contained, touching, apart.

use crate::mortar::support::{moved, open, point};
use proctor_contact::geometry::mortar::boundary::Boundary;
use proctor_contact::geometry::mortar::outline::{distance_to_outline, outline};
use proctor_contact::geometry::mortar::overlap::{BoundaryOverlap, overlap};
use proctor_scene::Shape;
use std::sync::Arc;

fn of(shape: &Shape) -> Boundary {
    Boundary::new(&outline(shape, 0.3).expect("has one")).expect("sound")
}

fn square(size: f64) -> Shape {
    Shape::Cuboid {
        p1: [0.0; 3],
        p2: [size, size, 0.0],
    }
}

#[test]
fn squares_cross_touch_or_lie_in_each_other() {
    let (large, small) = (of(&square(2.0)), of(&square(1.0)));
    let at = |x: f64, y: f64| overlap(&moved(&small, 0.0, point(x, y)), &large);
    assert!(matches!(
        at(1.6, 0.45),
        Some(BoundaryOverlap::Crossing { .. })
    ));
    // Where they cross is a vertex.
    assert!(at(1.5, 0.45).is_some());
    assert_eq!(at(0.5, 0.45), Some(BoundaryOverlap::SlaveInside(0)));
    assert_eq!(
        overlap(&large, &moved(&small, 0.0, point(0.5, 0.45))),
        Some(BoundaryOverlap::MasterInside(0))
    );
    // On an edge, at a corner, apart.
    assert_eq!(at(2.0, 0.45), None);
    assert_eq!(at(2.0, 2.0), None);
    assert_eq!(at(3.0, 0.0), None);
    // A line inside is inside, one beside is not.
    assert_eq!(
        overlap(&large, &open(&[[0.5, 0.5], [1.5, 0.7]])),
        Some(BoundaryOverlap::MasterInside(0))
    );
    assert_eq!(overlap(&large, &open(&[[0.0, -0.1], [2.0, -0.1]])), None);
    assert!(overlap(&large, &open(&[[-0.1, -0.1], [2.0, 0.5]])).is_some());
}

#[test]
fn a_hole_is_not_inside() {
    let ring = of(&Shape::Ring {
        center: [0.5, 0.5, 0.0],
        inner: 1.0,
        outer: 2.0,
    });
    assert_eq!(overlap(&of(&square(1.0)), &ring), None);
    let within = moved(&of(&square(0.2)), 0.0, point(1.9, 0.4));
    assert_eq!(
        overlap(&within, &ring),
        Some(BoundaryOverlap::SlaveInside(0))
    );
}

#[test]
fn distances_to_outlines() {
    let distance =
        |shape: &Shape, x: f64, y: f64| distance_to_outline(shape, &point(x, y)).expect("has one");
    let square = square(2.0);
    for (x, y, expected) in [
        (1.0, 0.3, 0.3),
        (3.0, 3.0, 2.0_f64.sqrt()),
        (2.0, 1.0, 0.0),
        (-0.5, 1.0, 0.5),
    ] {
        assert!((distance(&square, x, y) - expected).abs() < 1e-15);
    }
    let ring = Shape::Ring {
        center: [1.0, 0.0, 0.0],
        inner: 1.0,
        outer: 2.0,
    };
    for (x, y, expected) in [
        (1.0, 0.0, 1.0),
        (1.0, 1.25, 0.25),
        (-2.0, 0.0, 1.0),
        (2.75, 0.0, 0.25),
    ] {
        assert!((distance(&ring, x, y) - expected).abs() < 1e-15);
    }
    assert_eq!(
        distance_to_outline(&Shape::Particles(Arc::new(vec![])), &point(0.0, 0.0)),
        None
    );
}
