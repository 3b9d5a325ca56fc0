//! Paths of strain at a material point.

use nalgebra::Matrix3;
use proctor_laws::{AnyLaw, Point};

/// Initial density of the points \[kg/m³\]; no stress depends on it.
pub(crate) const DENSITY: f64 = 2000.0;

/// A point at rest.
pub(crate) fn point(law: &AnyLaw) -> Point {
    Point::new(law, DENSITY, [0.0; 6])
}

/// Strain of the midpoint configuration: the velocity gradient times time step whose increment the law sees as `d`.
pub(crate) fn midpoint(d: &Matrix3<f64>) -> [[f64; 3]; 3] {
    let inverse = (Matrix3::identity() - 0.5 * d)
        .try_inverse()
        .expect("a small strain");
    let gradient = inverse * d;
    std::array::from_fn(|i| std::array::from_fn(|j| gradient[(i, j)]))
}

/// Strains a point by `strain` in equal steps.
pub(crate) fn strain(point: &mut Point, strain: &Matrix3<f64>, steps: u32) {
    let gradient = midpoint(&(strain / f64::from(steps)));
    for _ in 0..steps {
        point.step(&gradient, 1.0).expect("a finite stress");
    }
}

/// A strain along x alone.
pub(crate) fn uniaxial(e: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&nalgebra::Vector3::new(e, 0.0, 0.0))
}

/// A shear of x and y without spin, of an angle g.
pub(crate) fn shear(g: f64) -> Matrix3<f64> {
    let mut strain = Matrix3::zeros();
    (strain[(0, 1)], strain[(1, 0)]) = (0.5 * g, 0.5 * g);
    strain
}

/// A stress as a matrix.
pub(crate) fn tensor(s: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2])
}

/// Deterministic numbers in [-1, 1].
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// True if two numbers agree to a share of a scale.
pub(crate) fn close(found: f64, exact: f64, share: f64, scale: f64) {
    assert!(
        (found - exact).abs() <= share * scale,
        "{found} instead of {exact}: off by {:e} of {scale}",
        (found - exact).abs() / scale
    );
}

/// Observed order of errors of halved steps, coarse to fine: 1 within five hundredths.
pub(crate) fn first_order(errors: &[f64]) {
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 1.0).abs() < 0.05, "order {order} of {errors:?}");
    }
}
