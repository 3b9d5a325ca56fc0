//! Augmented weights: partition of unity on the nodes with mass.

use crate::common::cases;
use crate::mortar::support::point;
use proctor_contact::geometry::mortar::weights::LostVertex;
use proctor_contact::mortar::weighting::{face_weights, vertex_weights};
use proctor_kernel::weights::Family;
use proptest::prelude::*;

fn family() -> impl Strategy<Value = (Family, f64)> {
    prop_oneof![
        Just((Family::Hat, 0.25)),
        (0.01..=0.5).prop_map(|l| (Family::Gimp, l))
    ]
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn weights_are_a_partition_of_unity_and_know_where_the_vertex_is(
        (family, l) in family(), x in -20.0..20.0_f64, y in -20.0..20.0_f64,
    ) {
        let w = vertex_weights(family, &point(x, y), l);
        prop_assert!((w.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        for k in 0..9 {
            let node = point((w.base[0] + k / 3) as f64, (w.base[1] + k % 3) as f64);
            prop_assert!((node + w.offset(k as usize) - point(x, y)).norm() < 1e-13);
        }
        // Linear fields are reproduced where all nodes have the same mass.
        let even = w.augmented(&[2.5; 9]).unwrap();
        let off = (0..9).fold(point(0.0, 0.0), |s, k| s + even.weights[k] * even.offset(k));
        prop_assert!(off.norm() < 1e-14);
    }

    #[test]
    fn empty_nodes_get_nothing(
        (family, l) in family(), x in 0.0..2.0_f64, y in 0.0..2.0_f64, masses in prop::array::uniform9(
            prop_oneof![Just(0.0), 1e-12..1.0_f64, 1.0..10.0_f64]),
    ) {
        let raw = vertex_weights(family, &point(x, y), l);
        // Those of a particle stay as they are on nodes with mass; what an empty node takes is lost.
        for (k, kept) in raw.on_mass(&masses).weights.iter().enumerate() {
            prop_assert_eq!(*kept, if masses[k] == 0.0 { 0.0 } else { raw.weights[k] });
        }
        let reachable = (0..9).any(|k| raw.weights[k] * masses[k] > 0.0);
        match raw.augmented(&masses) {
            Err(LostVertex) => prop_assert!(!reachable),
            Ok(w) => {
                prop_assert!(reachable);
                prop_assert!((w.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                for k in 0..9 {
                    prop_assert!(w.weights[k] >= 0.0);
                    prop_assert!(masses[k] > 0.0 || w.weights[k] == 0.0);
                }
                // Force over mass is bounded by one sum for all nodes: the mass of a light node cancels.
                let sum: f64 = (0..9).map(|k| raw.weights[k] * masses[k]).sum();
                for k in 0..9 {
                    if masses[k] > 0.0 {
                        prop_assert!(w.weights[k] / masses[k] <= raw.weights[k] / sum * (1.0 + 1e-14));
                    }
                }
            }
        }
    }
}

/// Of a face at y = -d beyond the nodes at 0, behind which a body lies upwards, nodes have the hats; the mass of the row at -1 is
/// d²/2 of a full cell's. A point that is a little above that end has the weight d all the same.
#[test]
fn weights_of_a_face_go_by_how_far_the_body_reaches() {
    let full = 3.0;
    for d in [1e-9, 1e-4, 0.02, 0.04_f64] {
        let (light, heavy) = (full * d * d / 2.0, full * (0.5 + d - d * d / 2.0));
        let masses = std::array::from_fn(|k| [light, heavy, full][k % 3]);
        for off in [0.0, (0.3 * d).min(0.009), (-0.8 * d).max(-0.009), 0.009] {
            // The patch begins at the light row.
            let at = point(0.8, 1.0 - d + off);
            let exact = face_weights::<2, 9>(&at, &[(1, 0.0); 2]);
            assert_eq!(exact.base, [0, 0]);
            let w = exact.as_reached(&masses, &[full; 2]);
            let row = |n: usize| (0..3).map(|k| w.weights[3 * k + n]).sum::<f64>();
            assert!((row(0) - d).abs() < 1e-12, "{d} {off}: {}", row(0));
            assert!((w.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            // Along the face nothing changes, and the distance says where the point is.
            let column: f64 = w.weights[..3].iter().sum();
            assert!((column - 0.2).abs() < 1e-14);
            let distance = w.distance(&exact);
            assert!(
                (distance - point(0.0, off)).norm() < 1e-12 || off.abs() > 0.5 * d,
                "{distance}"
            );
        }
    }
    // A point far off the end is on no face of these particles, and heavy nodes need no help.
    for (d, off) in [(0.02, 0.05), (0.4, 0.005)] {
        let masses = std::array::from_fn(|k| [full * d * d / 2.0, full, full][k % 3]);
        let exact = face_weights::<2, 9>(&point(0.8, 1.0 - d + off), &[(1, 0.0); 2]);
        assert_eq!(exact.as_reached(&masses, &[full; 2]), exact);
    }
}

/// A node takes no more than its mass bears, and what is more goes to the others.
#[test]
fn light_nodes_bear_what_their_mass_bears() {
    let full = 3.0;
    let mut masses = [full; 9];
    masses[0] = 1e-8 * full;
    let exact = face_weights::<2, 9>(&point(0.6, 0.7), &[(1, 0.0); 2]);
    let others = exact.augmented(&masses).expect("has mass");
    let w = exact.borne(&masses, 4.0 / full, &others);
    assert!((w.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
    assert!(w.weights[0] < 2.1e-4 && exact.weights[0] > 0.1);
    assert!((4.0 * masses[0] / full - w.weights[0].powi(2)).abs() < 1e-9);
    // Where all nodes bear their weights nothing changes, and the distance is no round-off.
    let same = exact.borne(&[full; 9], 4.0 / full, &others);
    assert_eq!(same, exact);
    assert_eq!(same.distance(&exact), point(0.0, 0.0));
}
