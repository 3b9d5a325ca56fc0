//! The weighting functions that the book draws.

use proctor_benchmark::book::diagrams::{FUNCTIONS, gradient, weight};

#[test]
fn weights_of_all_nodes_sum_to_one_and_their_gradients_to_nothing() {
    for (l, name) in FUNCTIONS {
        for k in 1..50 {
            let x = 0.01 + f64::from(k) / 51.0;
            let sum = |value: fn(f64, f64) -> f64| -> f64 {
                (-3..=3).map(|node| value(x - f64::from(node), l)).sum()
            };
            assert!((sum(weight) - 1.0).abs() < 1e-14, "{name} at {x}");
            assert!(sum(gradient).abs() < 1e-13, "{name} at {x}");
            let slope = (weight(x + 1e-6, l) - weight(x - 1e-6, l)) / 2e-6;
            assert!((slope - gradient(x, l)).abs() < 1e-4, "{name} at {x}");
        }
    }
}
