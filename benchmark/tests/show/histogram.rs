//! Histograms of orders.

use proctor_benchmark::show::histogram::{Bars, counts, svg};

#[test]
fn every_order_is_counted_once() {
    let orders = [-2.0, 0.05, 1.98, 2.02, 2.04, 7.0, f64::INFINITY, f64::NAN];
    let counts = counts(&orders);
    assert_eq!(counts.iter().sum::<usize>(), orders.len() - 1);
    assert_eq!(counts[0], 2);
    assert_eq!(counts[19..21], [1, 2]);
    assert_eq!(counts[counts.len() - 1], 2);
}

#[test]
fn a_panel_tells_its_numbers_in_words() {
    let panel = Bars {
        title: "Order".to_owned(),
        expected: 2.0,
        held: vec![2.1, 1.9],
        missed: vec![0.3],
    };
    let drawn = svg(&[panel]);
    assert!(drawn.contains("Order: 3 problems, least 0.30, median 1.90; theory expects 2."));
    assert_eq!(drawn.matches("class=\"missed\"").count(), 1);
    assert_eq!(drawn.matches("class=\"held\"").count(), 2);
}
