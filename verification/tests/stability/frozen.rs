//! Reductions of a frozen scene.

use proctor_verification::stability::frozen::poisson;

#[test]
fn poisson_of_the_two_moduli() {
    for nu in [0.0, 0.2, 0.3, 0.49] {
        let ratio = (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu);
        assert!((poisson(ratio) - nu).abs() < 1e-12, "{nu}");
    }
}
