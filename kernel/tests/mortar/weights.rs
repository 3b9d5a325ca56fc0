//! Augmented weights: partition of unity on the nodes with mass.

use crate::common::cases;
use crate::support::point;
use proctor_kernel::mortar::weights::Lost;
use proctor_kernel::weights::Family;
use proctor_kernel::weights::vertex_weights;
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
            Err(Lost) => prop_assert!(!reachable),
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
