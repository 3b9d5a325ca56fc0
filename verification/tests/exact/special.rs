//! Values from Abramowitz and Stegun's tables and `CPython`'s `math` module.

use approx::assert_relative_eq;
use proctor_verification::exact::special::{
    cos_pi, erf, erf_over_x, erfc, gauss_legendre, gaussian_field_over_x, sin_pi, sinc_pi,
};

#[test]
fn erfc_has_the_tabulated_values() {
    let table = [
        (-3.0, 1.999_977_909_503_001_5),
        (-1.0, 1.842_700_792_949_715),
        (-0.25, 1.276_326_390_168_237),
        (0.0, 1.0),
        (0.25, 0.723_673_609_831_763_1),
        (0.5, 0.479_500_122_186_953_5),
        (1.0, 0.157_299_207_050_285_13),
        (1.5, 0.033_894_853_524_689_274),
        (1.999, 0.004_698_443_348_629_488),
        (2.0, 0.004_677_734_981_047_265),
        (2.5, 0.000_406_952_017_444_958_9),
        (3.0, 2.209_049_699_858_543_8e-05),
        (4.0, 1.541_725_790_028_002e-08),
        (5.0, 1.537_459_794_428_035_1e-12),
        (6.0, 2.151_973_671_249_891_6e-17),
    ];
    for (x, value) in table {
        let error: f64 = erfc(x) - value;
        assert!(error.abs() < 2e-15, "erfc({x}) is {error:e} off");
        if x >= 2.0 {
            assert_relative_eq!(erfc(x), value, max_relative = 1e-14);
        }
        assert!((erf(x) + value - 1.0).abs() < 2e-15);
    }
}

#[test]
fn ratios_are_smooth_through_zero_and_across_their_switch() {
    let two_over_sqrt_pi = 2.0 / std::f64::consts::PI.sqrt();
    assert_relative_eq!(erf_over_x(0.0), two_over_sqrt_pi, max_relative = 1e-15);
    assert_relative_eq!(
        gaussian_field_over_x(0.0),
        two_over_sqrt_pi * 2.0 / 3.0,
        max_relative = 1e-15
    );
    for x in [0.5_f64, 1.0, 1.99, 2.01, 4.0] {
        assert_relative_eq!(erf_over_x(x), erf(x) / x, max_relative = 1e-14);
        let direct = (erf(x) - two_over_sqrt_pi * x * (-x * x).exp()) / x.powi(3);
        assert_relative_eq!(gaussian_field_over_x(x), direct, max_relative = 1e-13);
    }
}

#[test]
fn half_turns_are_exact() {
    for n in 0..8 {
        let n = f64::from(n);
        assert_eq!(cos_pi(n + 0.5), 0.0);
        assert_eq!(sin_pi(n), 0.0);
        assert_eq!(cos_pi(n).abs(), 1.0);
    }
    for t in [-2.3, -0.4, 0.1, 0.3, 0.6, 0.9, 1.2, 7.77_f64] {
        assert_relative_eq!(cos_pi(t), (std::f64::consts::PI * t).cos(), epsilon = 1e-14);
        assert_relative_eq!(sin_pi(t), (std::f64::consts::PI * t).sin(), epsilon = 1e-14);
    }
    assert_eq!(sinc_pi(0.0), 1.0);
    assert_eq!(sinc_pi(3.0), 0.0);
}

#[test]
fn gauss_points_integrate_polynomials() {
    for count in [1, 2, 5, 20, 51] {
        let rule = gauss_legendre(count);
        for degree in 0..2 * count {
            let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
            let exact = if degree % 2 == 0 {
                2.0 / (degree as f64 + 1.0)
            } else {
                0.0
            };
            assert!(
                (sum - exact).abs() < 1e-14,
                "{count} points, degree {degree}: {sum} for {exact}"
            );
        }
    }
}
