//! The bound of the time step against frequencies that are known.

use crate::mortar::support::point;
use proctor_contact::geometry::mortar::bound::{
    ClosingRate, NodalStiffness, SAFETY, allowed_approach,
};
use proctor_contact::geometry::mortar::pair::VertexContact;
use proctor_contact::mortar::weighting::vertex_weights;
use proctor_kernel::weights::Family;

const NODES: [usize; 9] = [7, 8, 9, 17, 18, 19, 27, 28, 29];

#[test]
fn one_node_on_a_spring() {
    // All of the vertex hangs on one node of mass m: omega² = k/m on a rigid body, 2 k/m between two equal ones.
    let mut masses = [0.0; 9];
    masses[4] = 2.0;
    let w = vertex_weights(Family::Gimp, &point(1.1, 0.9), 0.25)
        .augmented(&masses)
        .expect("has mass");
    let mut nodes = NodalStiffness::default();
    assert_eq!(nodes.time_step(), f64::INFINITY);
    nodes.add(&NODES, &w.weights, &masses, 0.0);
    assert_eq!(nodes.frequency(), 0.0);
    nodes.add(&NODES, &w.weights, &masses, 50.0);
    let between_equals = (2.0 * 50.0 / 2.0_f64).sqrt();
    assert!((nodes.frequency() - between_equals).abs() < 1e-14);
    assert!((nodes.time_step() - SAFETY * 2.0 / between_equals).abs() < 1e-15);
    nodes.clear();
    assert_eq!(nodes.frequency(), 0.0);
}

/// The bound is not below the largest eigenvalue of a patch on springs to a rigid body, K = sum S k S^T, and stays
/// finite beside nodes of nearly no mass.
#[test]
fn the_bound_is_above_the_frequencies_of_a_patch() {
    let masses = [1.0, 0.3, 1e-12, 0.8, 0.1, 1e-15, 0.5, 0.0, 0.0];
    let mut nodes = NodalStiffness::default();
    let mut k = nalgebra::SMatrix::<f64, 9, 9>::zeros();
    for (x, y, stiffness) in [(0.7, 0.8, 30.0), (1.1, 1.2, 70.0), (1.4, 1.45, 20.0)] {
        let w = vertex_weights(Family::Gimp, &point(x, y), 0.25)
            .augmented(&masses)
            .expect("has mass");
        assert_eq!(w.base, [0, 0]);
        nodes.add(&NODES, &w.weights, &masses, stiffness);
        let s = nalgebra::SVector::from(w.weights);
        k += stiffness * s * s.transpose();
    }
    // M^-1/2 K M^-1/2 on the nodes with mass.
    let scale = nalgebra::SVector::<f64, 9>::from_fn(|i, _| {
        if masses[i] > 0.0 {
            1.0 / masses[i].sqrt()
        } else {
            0.0
        }
    });
    let scaled = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| scale[i] * k[(i, j)] * scale[j]);
    let largest = nalgebra::DMatrix::from_fn(9, 9, |i, j| scaled[(i, j)])
        .symmetric_eigenvalues()
        .max();
    let bound = nodes.frequency();
    assert!(bound * bound >= largest, "{} {largest}", bound * bound);
    assert!(
        bound * bound < 40.0 * largest,
        "{} {largest}",
        bound * bound
    );
}

#[test]
fn a_gap_may_close_to_half_the_critical_one_or_by_that_much() {
    let gc = 0.2;
    assert_eq!(allowed_approach(1.0, gc), 0.9);
    assert_eq!(allowed_approach(gc, gc), 0.1);
    assert_eq!(allowed_approach(0.01, gc), 0.1);
    assert_eq!(allowed_approach(-1.0, gc), 0.1);
}

#[test]
fn the_vertex_that_is_in_most_of_a_hurry_decides() {
    let site = |vertex: usize, gap: f64, closing: f64| {
        Some(VertexContact {
            vertex,
            gap,
            normal: point(0.0, 1.0),
            pressure: 0.0,
            traction: [0.0],
            measure: 1.0,
            approach: 0.0,
            closing,
        })
    };
    let (gc, reach) = (0.2, 1.1);
    let of = |sites: &[Option<VertexContact<2, 1>>]| ClosingRate::of(sites, gc, reach, [3.0, 2.0]);
    // Nothing faces anything: both at full speed towards each other, from just out of reach.
    let whole = of(&[None]);
    assert_eq!((whole.vertex, whole.time_step()), (None, 1.0 / 5.0));
    // 0.1 m allowed at 1 m/s, against 0.4 m at 3 m/s and one that leaves.
    let found = of(&[
        site(0, 0.5, 3.0),
        None,
        site(7, 0.1, 1.0),
        site(2, 0.0, -9.0),
    ]);
    assert_eq!(found.vertex, Some(7));
    assert!((found.time_step() - 0.1).abs() < 1e-15);
    assert_eq!(ClosingRate::NONE.time_step(), f64::INFINITY);
}

/// Weights of a face on a light node: row sums grow as its mass goes to zero, the frequency does not, nor does the second product.
#[test]
fn a_light_node_of_a_face_is_no_stiff_one() {
    for d in [1e-2, 1e-5, 1e-9] {
        let mut masses = [0.0; 9];
        (masses[0], masses[1]) = (d * d / 2.0, 0.5);
        let mut weights = [0.0; 9];
        (weights[0], weights[1]) = (d, 1.0 - d);
        let mut nodes = NodalStiffness::default();
        nodes.add(&NODES, &weights, &masses, 50.0);
        let of_rows = nodes.frequency();
        assert!(of_rows >= (2.0 * 50.0 * 2.0 / d).sqrt() * (1.0 - 1e-12));
        nodes.sharpen(&NODES, &weights, &masses, 50.0);
        // Of one spring it is the frequency itself, K sum w²/m, with the factor for the other body.
        let exact = 2.0 * 50.0 * (2.0 + (1.0 - d).powi(2) / 0.5);
        assert!((nodes.frequency().powi(2) / exact - 1.0).abs() < 1e-12);
        nodes.clear();
        assert_eq!(nodes.frequency(), 0.0);
    }
}
