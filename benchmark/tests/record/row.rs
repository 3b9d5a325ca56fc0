//! Rows of a record.

use proctor_benchmark::record::{Row, key};

#[test]
fn keys_are_flat_words() {
    assert_eq!(key("L2(u), r >= 0.2 m"), "l2_u_r_0_2_m");
    assert_eq!(key("u_z at (.5,.5,.5)"), "u_z_at_5_5_5");
}

#[test]
fn what_is_not_finite_is_left_out() {
    let mut row = Row::sample("a", 0, 1);
    row.count("nan", f64::NAN);
    row.count("b", 1.5);
    assert_eq!(
        row.counters.into_iter().collect::<Vec<_>>(),
        [("b".to_owned(), 1.5)]
    );
}
