//! Edges that cross are found where faces are blind, and only there.

use super::support::{at_rest, law, moved, of_shape, point};
use nalgebra::{Rotation3, Vector3};
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_contact::geometry::mortar::space::ridges::crossing;
use proctor_scene::Shape;
use std::f64::consts::FRAC_PI_4;

fn cube(segment: f64) -> Facets {
    of_shape(
        &Shape::Cuboid {
            p1: [-0.5; 3],
            p2: [0.5; 3],
        },
        segment,
    )
}

/// Two cubes on their edges, one across the other, like roofs.
fn roofs(gap: f64) -> [Facets; 2] {
    let lower = moved(
        &cube(1.0),
        &Rotation3::from_axis_angle(&Vector3::x_axis(), FRAC_PI_4),
        &point(0.0, 0.0, 0.0),
    );
    let height = 2.0_f64.sqrt() + gap;
    let upper = moved(
        &cube(1.0),
        &Rotation3::from_axis_angle(&Vector3::y_axis(), FRAC_PI_4),
        &point(0.1, 0.05, height),
    );
    [upper, lower]
}

#[test]
fn crossed_roofs_meet_at_their_edges() {
    for gap in [0.05, 0.01, -0.01] {
        let [upper, lower] = roofs(gap);
        let found = crossing(&upper, &lower, 0.1, 0.1).expect("they cross");
        assert!((found.distance - gap).abs() < 1e-14, "{found:?}");
        let at = point(0.1, 0.0, 0.5_f64.sqrt() + gap);
        assert!((found.position - at).norm() < 1e-14, "{}", found.position);
    }
    let [upper, lower] = roofs(0.2);
    assert_eq!(crossing(&upper, &lower, 0.1, 0.1), None);
}

/// Reason of the refusal: by their faces, a pair of roofs that pass through each other is apart.
#[test]
fn faces_do_not_see_crossed_roofs_in_time() {
    let [upper, lower] = roofs(-0.02);
    let found = at_rest(&upper, &lower, &law(Detection::Mortar, 0.0));
    assert!(found.smallest_gap().is_none_or(|(_, gap)| gap > 0.0));
}

/// Plates on each other, one turned, and a corner on a face: faces do this, and no crossing is reported.
#[test]
fn faces_on_faces_are_no_crossing() {
    let lower = cube(0.25);
    for angle in [0.0, 0.3, FRAC_PI_4] {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let upper = moved(&cube(0.25), &turn, &point(0.2, 0.1, 1.02));
        assert_eq!(crossing(&upper, &lower, 0.1, 0.1), None, "{angle}");
    }
    let corner = Rotation3::from_euler_angles(0.6, 0.5, 0.3);
    let upper = moved(&cube(0.25), &corner, &point(0.1, 0.0, 1.3));
    assert_eq!(crossing(&upper, &lower, 0.1, 0.1), None);
}
