//! The largest eigenvalue of a map, where it is known.

use proctor_verification::stability::arnoldi::{dot, largest};

#[test]
fn the_largest_eigenvalue_of_a_chain() {
    // Masses on springs between two walls: 2 - 2 cos(pi n/(n+1)).
    let n = 40;
    let chain = |x: &[f64]| {
        let at = |i: usize| x.get(i).copied().unwrap_or(0.0);
        Ok((0..n)
            .map(|i| 2.0 * x[i] - at(i + 1) - at(i.wrapping_sub(1)))
            .collect())
    };
    let found = largest(n, n, chain).expect("an eigenvalue").expect("one");
    let exact = 2.0 - 2.0 * (std::f64::consts::PI * 40.0 / 41.0).cos();
    assert!((found.value - exact).abs() < 1e-6 * exact, "{found:?}");
    assert!(dot(&found.vector, &found.vector) > 0.999);
}

#[test]
fn a_map_that_gives_nothing_has_none() {
    let none = largest(10, 5, |x| Ok(vec![0.0; x.len()]));
    assert!(none.expect("no error").is_none());
}
