//! Rows at the multiples of an interval.

use proctor_benchmark::refine::dense::Dense;

#[test]
fn rows_lie_between_the_states_around_them() {
    let mut dense = Dense::new(0.5);
    assert!(!dense.is_near(0.1, 0.1) && dense.is_near(0.3, 0.1));
    assert!(dense.rows(0.4, vec![4.0, 1.0]).is_empty());
    // A step over two multiples, of which the second is the state itself.
    let rows = dense.rows(1.0, vec![10.0, 1.0]);
    let expected = [(0.5, vec![5.0, 1.0]), (1.0, vec![10.0, 1.0])];
    assert_eq!(rows.len(), 2);
    for ((time, row), (at, values)) in rows.iter().zip(&expected) {
        assert_eq!(time, at);
        let off = row.iter().zip(values).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-14, "{row:?}");
    }
}
