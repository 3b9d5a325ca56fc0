//! Modified Cam clay in closed form against its rates, integrated by Runge and Kutta.

use approx::assert_relative_eq;
use proctor_verification::exact::cam_clay::CamClayExact;

const CLAY: CamClayExact = CamClayExact {
    critical_ratio: 1.2,
    compression: 0.1,
    swelling: 0.02,
    poisson: 0.25,
    pressure: 100.0,
};
/// Shear modulus over bulk modulus of that Poisson's ratio.
const R: f64 = 0.6;

/// Rates of p, q and deviator strain where the volume strains by dv and q rises by dq on the yield surface `(q/M)² = p
/// (p_c - p)`:
/// `dp_c = p_c de_v^p/(lambda - kappa)`, `de_v^p : de_q^p = (M² - eta²) : 2 eta`.
fn plastic(p: f64, q: f64, dp: f64, dq: f64) -> [f64; 2] {
    let m = CLAY.critical_ratio;
    let (eta, square) = (q / p, m * m);
    // d ln p_c = d ln p + d ln(1 + eta²/M²).
    let d_eta = (dq - eta * dp) / p;
    let hardened = dp / p + 2.0 * eta * d_eta / (square + eta * eta);
    let volume = (CLAY.compression - CLAY.swelling) * hardened;
    [volume, volume * 2.0 * eta / (square - eta * eta)]
}

/// Integrates [p, volume strain, deviator strain] over eta.
fn integrated(rate: impl Fn(f64, [f64; 3]) -> [f64; 3], from: f64, to: f64) -> [f64; 3] {
    let count = 20_000;
    let h = (to - from) / f64::from(count);
    let mut y = [CLAY.pressure, 0.0, 0.0];
    for i in 0..count {
        let eta = from + h * f64::from(i);
        let with = |k: [f64; 3], share: f64| std::array::from_fn(|j| y[j] + share * h * k[j]);
        let a = rate(eta, y);
        let b = rate(eta + 0.5 * h, with(a, 0.5));
        let c = rate(eta + 0.5 * h, with(b, 0.5));
        let d = rate(eta + h, with(c, 1.0));
        y = std::array::from_fn(|j| y[j] + h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]));
    }
    y
}

#[test]
fn drained_paths_are_their_rates() {
    let to = 1.1;
    let rate = |eta: f64, [p, _, _]: [f64; 3]| {
        // dq = 3 dp and q = eta p: p d_eta = (3 - eta) dp.
        let dp = p / (3.0 - eta);
        let [volume, shear] = plastic(p, eta * p, dp, 3.0 * dp);
        let elastic = CLAY.swelling * dp / p;
        [
            dp,
            volume + elastic,
            shear + 3.0 * dp * CLAY.swelling / (3.0 * R * p),
        ]
    };
    let [p, volume, shear] = integrated(rate, 0.0, to);
    assert_relative_eq!(CLAY.drained_pressure(to), p, max_relative = 1e-10);
    assert_relative_eq!(CLAY.drained_volume_strain(to), volume, max_relative = 1e-10);
    assert_relative_eq!(CLAY.drained_strain(to), shear, max_relative = 1e-10);
    // The critical state.
    assert_relative_eq!(CLAY.drained_pressure(1.2), 166.666_67, max_relative = 1e-7);
    assert_relative_eq!(
        CLAY.drained_volume_strain(1.2),
        0.106_534_34,
        max_relative = 1e-7
    );
}

#[test]
fn undrained_paths_are_their_rates() {
    for first in [0.0, 0.5] {
        let to = 1.1;
        let rate = |eta: f64, [p, _, _]: [f64; 3]| {
            // The volume stays: elastic and plastic rates cancel, which gives dp for d_eta = 1.
            let square = CLAY.critical_ratio.powi(2) + eta * eta;
            let dp = -CLAY.plastic_share() * p * 2.0 * eta / square;
            let dq = p + eta * dp;
            let [volume, shear] = plastic(p, eta * p, dp, dq);
            let off = volume + CLAY.swelling * dp / p;
            [dp, off, shear + dq * CLAY.swelling / (3.0 * R * p)]
        };
        let [p, volume, shear] = integrated(rate, first, to);
        assert!(volume.abs() < 1e-14, "{volume:e}");
        assert_relative_eq!(CLAY.undrained_pressure(to, first), p, max_relative = 1e-10);
        assert_relative_eq!(
            CLAY.undrained_strain(to, first),
            shear,
            max_relative = 1e-10
        );
    }
    assert_relative_eq!(
        CLAY.undrained_pressure(1.2, 0.0),
        57.434_918,
        max_relative = 1e-7
    );
    let on_the_surface = 1.2 * 0.6_f64.sqrt();
    let p = CLAY.undrained_pressure(1.2, on_the_surface);
    assert_relative_eq!(0.6 * p, 50.190_699, max_relative = 1e-7);
}

#[test]
fn earth_pressure_at_rest_keeps_the_sides() {
    assert_relative_eq!(CLAY.at_rest(), 0.642_867_3, max_relative = 1e-7);
    // Along a constant ratio no side strains: e_q = 2/3 e_v.
    let eta = CLAY.ratio_at_rest();
    let [volume, shear] = plastic(100.0, 100.0 * eta, 1.0, eta);
    let all = volume + CLAY.swelling / 100.0;
    let sheared = shear + eta * CLAY.swelling / (300.0 * R);
    assert_relative_eq!(sheared / all, 2.0 / 3.0, max_relative = 1e-10);
    assert_relative_eq!(all, CLAY.compression / 100.0, max_relative = 1e-10);
}
