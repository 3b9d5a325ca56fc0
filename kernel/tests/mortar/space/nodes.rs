//! Weights of vertices on nodes, how vertices follow, and the bound of the time step, in space.

use super::support::point;
use crate::common::cases;
use nalgebra::Matrix3;
use proctor_contact::geometry::mortar::bound::NodalStiffness;
use proctor_contact::geometry::mortar::motion::{FollowMode, NodalGradient, vertex_velocity};
use proctor_contact::geometry::mortar::space::Point;
use proctor_contact::geometry::mortar::weights::{LostVertex, VertexWeights, in_patch};
use proctor_contact::mortar::weighting::vertex_weights;
use proctor_kernel::weights::Family;
use proptest::prelude::*;

type Weights = VertexWeights<3, 27>;

fn node(w: &Weights, k: usize) -> Point {
    let at = in_patch::<3>(k);
    Point::from_fn(|axis, _| (w.base[axis] + at[axis] as i64) as f64)
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn weights_are_a_partition_of_unity_and_know_where_the_vertex_is(
        at in prop::array::uniform3(-20.0..20.0_f64), l in 0.01..=0.5_f64, hat in any::<bool>(),
    ) {
        let x = Point::from(at);
        let w = vertex_weights(if hat { Family::Hat } else { Family::Gimp }, &x, l);
        prop_assert!((w.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        for k in 0..27 {
            prop_assert!((node(&w, k) + w.offset(k) - x).norm() < 1e-13);
        }
        let even = w.augmented(&[2.5; 27]).unwrap();
        let off = (0..27).fold(Point::zeros(), |s, k| s + even.weights[k] * even.offset(k));
        prop_assert!(off.norm() < 1e-14);
    }

    /// Beside nodes without mass vertices follow turning bodies with the spin, and all linear fields with the gradient.
    #[test]
    fn linear_fields_are_followed_past_empty_nodes(
        at in prop::array::uniform3(0.0..3.0_f64), g in prop::array::uniform9(-2.0..2.0_f64),
        full in prop::collection::vec(any::<bool>(), 27),
    ) {
        let cell = point(0.25, 0.5, 0.1);
        let x = Point::from(at);
        let masses = std::array::from_fn(|k| if full[k] { 1.0 + k as f64 } else { 0.0 });
        let raw = vertex_weights(Family::Gimp, &x, 0.25);
        let reachable = (0..27).any(|k| raw.weights[k] * masses[k] > 0.0);
        let w = match raw.augmented(&masses) {
            Err(LostVertex) => { prop_assert!(!reachable); return Ok(()); }
            Ok(w) => w,
        };
        let gradient = Matrix3::from_row_slice(&g);
        let spin = 0.5 * (gradient - gradient.transpose());
        for (field, follow) in [(gradient, FollowMode::Gradient), (spin, FollowMode::Spin)] {
            let velocity = |x: Point| point(0.3, -0.7, 0.2) + field * x.component_mul(&cell);
            let found = vertex_velocity(&w, |k| velocity(node(&w, k)), |_| field, follow, &cell);
            prop_assert!((found - velocity(x)).norm() < 1e-13);
        }
    }
}

#[test]
fn the_nodal_gradient_is_the_mean_by_mass() {
    let mut node = NodalGradient::<3>::default();
    let a = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    node.add(0.5, 2.0, &a);
    node.add(0.25, 12.0, &(-a));
    assert!((node.mean() + 0.5 * a).norm() < 1e-15);
}

/// The bound is not below the largest eigenvalue of a patch on springs.
#[test]
fn the_bound_is_above_the_frequencies_of_a_patch() {
    let masses: [f64; 27] = std::array::from_fn(|k| match k % 4 {
        0 => 1.0,
        1 => 0.3,
        2 => 1e-12,
        _ => 0.0,
    });
    let mut nodes = NodalStiffness::default();
    let mut k = nalgebra::DMatrix::<f64>::zeros(27, 27);
    for (x, y, z, stiffness) in [
        (0.7, 0.8, 1.2, 30.0),
        (1.1, 1.2, 0.9, 70.0),
        (1.4, 1.45, 1.3, 20.0),
    ] {
        let w = vertex_weights(Family::Gimp, &point(x, y, z), 0.25)
            .augmented(&masses)
            .expect("has mass");
        assert_eq!(w.base, [0; 3]);
        nodes.add(&std::array::from_fn(|k| k), &w.weights, &masses, stiffness);
        for i in (0..27).filter(|i| masses[*i] > 0.0) {
            for j in (0..27).filter(|j| masses[*j] > 0.0) {
                k[(i, j)] +=
                    stiffness * w.weights[i] * w.weights[j] / (masses[i] * masses[j]).sqrt();
            }
        }
    }
    let largest = k.symmetric_eigenvalues().max();
    let bound = nodes.frequency();
    assert!(bound * bound >= largest, "{} {largest}", bound * bound);
    assert!(
        bound * bound < 60.0 * largest,
        "{} {largest}",
        bound * bound
    );
}
