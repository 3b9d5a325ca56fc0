//! Outlines lie on their shapes, run the right way and are as fine as asked.

use proctor_contact::geometry::mortar::boundary::Boundary;
use proctor_contact::geometry::mortar::outline::{OutlineError, outline};
use proctor_scene::Shape;
use std::f64::consts::PI;
use std::sync::Arc;

fn boundary(shape: &Shape, segment: f64) -> Boundary {
    Boundary::new(&outline(shape, segment).expect("has an outline")).expect("is sound")
}

#[test]
fn a_rectangle_is_divided_evenly() {
    let shape = Shape::Cuboid {
        p1: [1.0, 2.0, 0.0],
        p2: [3.0, 2.7, 0.0],
    };
    // 2 / 0.1 is a whole number but for round-off: no segment more.
    let b = boundary(&shape, 0.1);
    assert_eq!(b.points.len(), 2 * (20 + 7));
    assert!((b.area() - 1.4).abs() < 1e-14);
    assert!(b.longest_segment() < 0.1 + 1e-15);
}

#[test]
fn circles_lie_on_their_radius() {
    let center = [4.0, -3.0, 0.0];
    let disc = boundary(
        &Shape::Sphere {
            center,
            radius: 0.5,
        },
        2.0 * PI * 0.5 / 64.0,
    );
    assert_eq!(disc.points.len(), 64);
    for p in &disc.points {
        assert!(((p.x - 4.0).hypot(p.y + 3.0) - 0.5).abs() < 1e-14);
    }
    // The area of a regular polygon.
    let exact = 32.0 * 0.25 * (PI / 32.0).sin();
    assert!((disc.area() - exact).abs() < 1e-14);
    let ring = boundary(
        &Shape::Ring {
            center,
            inner: 0.3,
            outer: 0.5,
        },
        0.001,
    );
    assert!((ring.area() - PI * 0.16).abs() < 1e-5);
}

#[test]
fn a_polygon_of_either_orientation_is_counter_clockwise() {
    let mut points = vec![
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 1.0, 0.0],
        [1.0, 0.5, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let area = boundary(
        &Shape::Polygon {
            points: points.clone(),
        },
        0.3,
    )
    .area();
    assert!((area - 1.5).abs() < 1e-14);
    points.reverse();
    let turned = boundary(&Shape::Polygon { points }, 0.3);
    assert!((turned.area() - 1.5).abs() < 1e-14);
}

#[test]
fn what_has_no_outline_is_refused() {
    let disc = Shape::Sphere {
        center: [0.0; 3],
        radius: 1.0,
    };
    for segment in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(outline(&disc, segment), Err(OutlineError::Segment(segment)));
    }
    assert!(matches!(
        outline(&disc, f64::NAN),
        Err(OutlineError::Segment(_))
    ));
    let particles = Shape::Particles(Arc::new(vec![]));
    assert_eq!(outline(&particles, 0.1), Err(OutlineError::Shape));
}
