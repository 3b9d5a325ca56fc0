//! The motion of vertices under rotations and linear fields, in a full patch and beside empty nodes.

use crate::mortar::support::point;
use nalgebra::Matrix2;
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::motion::{FollowMode, NodalGradient, vertex_velocity};
use proctor_contact::geometry::mortar::weights::VertexWeights;
use proctor_contact::mortar::weighting::vertex_weights;
use proctor_kernel::weights::Family;

const CELL: [f64; 2] = [0.25, 0.5];

/// Velocity of a vertex at a place given in cells, in a field v = c + G x on nodes with the given masses.
fn follow(xi: Point, gradient: Matrix2<f64>, masses: &[f64; 9], how: FollowMode) -> (Point, Point) {
    let cell = Point::from(CELL);
    let w = vertex_weights(Family::Gimp, &xi, 0.25)
        .augmented(masses)
        .expect("has mass");
    let field = |x: Point| point(0.3, -0.7) + gradient * x;
    let velocities: [Point; 9] = std::array::from_fn(|k| {
        let node = point(
            (w.base[0] + (k / 3) as i64) as f64,
            (w.base[1] + (k % 3) as i64) as f64,
        );
        field(node.component_mul(&cell))
    });
    let found = vertex_velocity(&w, |k| velocities[k], |_| gradient, how, &cell);
    (found, field(xi.component_mul(&cell)))
}

/// Only the nodes with x below the vertex have mass, as at a boundary on the right of a body.
const LEFT: [f64; 9] = [3.0, 2.0, 1.0, 1.0, 0.5, 0.2, 0.0, 0.0, 0.0];

#[test]
fn gradients_carry_every_linear_field_past_empty_nodes() {
    let xi = point(7.3, 2.1);
    let spin = Matrix2::new(0.0, -2.0, 2.0, 0.0);
    let shear = Matrix2::new(0.4, 1.5, -0.3, -0.9);
    let error = |gradient, masses, how| {
        let (found, exact): (Point, Point) = follow(xi, gradient, masses, how);
        (found - exact).norm()
    };
    // With equal masses the weights reproduce linear fields by themselves.
    for how in [FollowMode::Velocity, FollowMode::Spin, FollowMode::Gradient] {
        assert!(error(spin, &[1.0; 9], how) < 1e-14, "{how:?}");
    }
    // Beside empty nodes the velocity alone is that of a point inside the body: 2/s times a quarter of a cell.
    assert!(error(spin, &LEFT, FollowMode::Velocity) > 0.1);
    assert!(error(spin, &LEFT, FollowMode::Spin) < 1e-14);
    assert!(error(spin, &LEFT, FollowMode::Gradient) < 1e-14);
    assert!(error(shear, &LEFT, FollowMode::Spin) > 0.05);
    assert!(error(shear, &LEFT, FollowMode::Gradient) < 1e-14);
}

#[test]
fn the_nodal_gradient_is_the_mean_by_mass() {
    let mut node = NodalGradient::default();
    assert_eq!(node.mean(), Matrix2::zeros());
    let a = Matrix2::new(1.0, 2.0, 3.0, 4.0);
    node.add(0.5, 2.0, &a);
    node.add(0.25, 12.0, &(-a));
    // (0.5 * 2 - 0.25 * 12) / (1 + 3).
    assert!((node.mean() + 0.5 * a).norm() < 1e-15);
}

/// Without augmentation the shares of empty nodes, which have no velocity, are lost: the vertex lags even behind a
/// translation, and drifts off the body.
#[test]
fn without_augmentation_a_vertex_lags_behind_a_translation() {
    let raw = vertex_weights(Family::Gimp, &point(7.3, 2.1), 0.25);
    let v = point(2.0, -1.0);
    let velocities = LEFT.map(|mass| if mass > 0.0 { v } else { Point::zeros() });
    let still = |_| Matrix2::zeros();
    let found = |w: &VertexWeights<2, 9>| {
        vertex_velocity(
            w,
            |k| velocities[k],
            still,
            FollowMode::Spin,
            &Point::from(CELL),
        )
    };
    let augmented = raw.augmented(&LEFT).expect("has mass");
    assert!((found(&augmented) - v).norm() < 1e-14);
    assert!((found(&raw) - v).norm() > 0.1 * v.norm());
}
