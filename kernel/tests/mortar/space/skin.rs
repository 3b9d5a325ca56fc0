//! Surfaces of shapes: closed, outside out, with vertices on them, and areas and volumes that tend to the exact ones.

use super::support::of_shape;
use proctor_contact::geometry::mortar::outline::OutlineError;
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_contact::geometry::mortar::space::skin::skin;
use proctor_scene::Shape;
use std::f64::consts::PI;

fn closed(shape: &Shape, segment: f64) -> Facets {
    let corners = skin(shape, segment).expect("has a surface");
    let surface = proctor_contact::geometry::surface::Surface::new(&corners).expect("is sound");
    assert_eq!(surface.require_closed(), Ok(()));
    Facets::new(&surface).expect("is outside out")
}

#[test]
fn cuboids() {
    for segment in [2.0, 0.3, 0.25] {
        let shape = Shape::Cuboid {
            p1: [1.0, 2.0, -1.0],
            p2: [1.5, 3.0, 1.0],
        };
        let box_of = closed(&shape, segment);
        assert!((box_of.volume() - 1.0).abs() < 1e-14);
        assert!((box_of.area() - 2.0 * (0.5 + 1.0 + 2.0)).abs() < 1e-13);
        assert!(box_of.longest_edge() <= segment.min(2.0) * 2.0_f64.sqrt() * (1.0 + 1e-12));
    }
}

#[test]
fn spheres() {
    let shape = Shape::Sphere {
        center: [1.0, -2.0, 0.5],
        radius: 2.0,
    };
    let error = |segment: f64| {
        let ball = closed(&shape, segment);
        for p in &ball.points {
            let r = (p - nalgebra::Vector3::new(1.0, -2.0, 0.5)).norm();
            assert!((r - 2.0).abs() < 1e-14);
        }
        assert!(ball.longest_edge() < 1.5 * segment);
        let volume = 4.0 / 3.0 * PI * 8.0;
        [volume - ball.volume(), 16.0 * PI - ball.area()]
    };
    let (coarse, fine) = (error(0.4), error(0.2));
    for k in 0..2 {
        assert!(
            fine[k] > 0.0 && (coarse[k] / fine[k]).log2() > 1.8,
            "{coarse:?} {fine:?}"
        );
    }
}

#[test]
fn cylinders() {
    let shape = Shape::Cylinder {
        p1: [0.0, 1.0, 0.0],
        p2: [2.0, 2.0, 2.0],
        radius: 0.5,
    };
    let rod = closed(&shape, 0.05);
    assert!((rod.volume() / (3.0 * PI * 0.25) - 1.0).abs() < 2e-3);
    assert!((rod.area() / (PI * 3.0 + 0.5 * PI) - 1.0).abs() < 2e-3);
    // Both circles at the ends, and nothing else.
    let sharp = rod.ridges().len();
    assert_eq!(sharp, 2 * 4 * (0.25 * PI / 0.05_f64).ceil() as usize);
}

#[test]
fn extruded_polygons_along_every_axis() {
    // An L of area 3, given in either direction.
    let corners = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    for axis in 0..3 {
        for reversed in [false, true] {
            for segment in [5.0, 0.3] {
                let mut points = corners.to_vec();
                if reversed {
                    points.reverse();
                }
                let shape = Shape::ExtrudedPolygon {
                    points,
                    axis,
                    range: [-0.5, 0.0],
                };
                let body = closed(&shape, segment);
                assert!(
                    (body.volume() - 1.5).abs() < 1e-14,
                    "{axis} {}",
                    body.volume()
                );
                assert!((body.area() - (2.0 * 3.0 + 8.0 * 0.5)).abs() < 1e-13);
                assert!(body.longest_edge() <= 5.0_f64.min(segment * 1.5));
            }
        }
    }
}

#[test]
fn what_has_no_surface_is_refused() {
    let ring = Shape::Ring {
        center: [0.0; 3],
        inner: 1.0,
        outer: 2.0,
    };
    assert_eq!(skin(&ring, 0.1), Err(OutlineError::Shape));
    let ball = Shape::Sphere {
        center: [0.0; 3],
        radius: 1.0,
    };
    assert_eq!(skin(&ball, -1.0), Err(OutlineError::Segment(-1.0)));
    assert!(of_shape(&ball, 100.0).volume() > 0.0);
}
