//! Closed forms at a point, against their rate equations integrated in small steps.

use approx::assert_relative_eq;
use proctor_verification::exact::material_point::{
    ShearedSoil, bingham, held_dilation, to_and_fro, turned,
};

const SHEAR: f64 = 40.0;
const LAMBDA: f64 = 60.0;

/// Integrates y' = rate(y) over `end` by the method of Runge and Kutta.
fn integrated<const N: usize>(
    start: [f64; N],
    end: f64,
    rate: impl Fn(&[f64; N]) -> [f64; N],
) -> [f64; N] {
    const STEPS: u32 = 2000;
    let h = end / f64::from(STEPS);
    let mut y = start;
    let ahead = |y: &[f64; N], k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    for _ in 0..STEPS {
        let a = rate(&y);
        let b = rate(&ahead(&y, &a, 0.5 * h));
        let c = rate(&ahead(&y, &b, 0.5 * h));
        let d = rate(&ahead(&y, &c, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    y
}

/// The deviator n at a radius R keeps its size: s' = 2 G (e' - (n : e') n) with e' = g'/2 in x and y.
#[test]
fn a_deviator_turns() {
    let strength = 0.3;
    // The normal part, over its value at first, and the shear stress; s : s = 2 strength² of both.
    let rate = |&[left, tau]: &[f64; 2]| {
        let along = tau * SHEAR / (strength * strength);
        [-along * left, SHEAR - along * tau]
    };
    for angle in [1e-3, 0.01, 0.03] {
        let [left, tau] = integrated([1.0, 0.0], angle, rate);
        let exact = turned(SHEAR, strength, angle);
        assert_relative_eq!(exact[0], tau, max_relative = 1e-10);
        assert_relative_eq!(exact[1], left, max_relative = 1e-10);
    }
}

/// tau' = G g' below the limit, which grows with the plastic angle, G H/(3 G + H) beyond it in either direction.
#[test]
fn shear_goes_to_and_fro() {
    let (hardening, limit) = (12.0, 0.2);
    let (there, back, steps) = (0.02, 0.03, 200_000);
    let (mut tau, mut strength) = (0.0_f64, limit);
    for (way, sign) in [(there, 1.0), (back, -1.0)] {
        for _ in 0..steps {
            let trial = tau + sign * SHEAR * way / f64::from(steps);
            let excess = (trial.abs() - strength).max(0.0);
            // Plastic angle, and sqrt(3) times it is the plastic strain by which Y = sqrt(3) strength grows.
            let plastic = excess / (SHEAR + hardening / 3.0);
            strength += hardening / 3.0 * plastic;
            tau = trial - trial.signum() * SHEAR * plastic;
        }
    }
    let exact = to_and_fro([SHEAR, hardening], limit, there, back);
    assert_relative_eq!(exact, tau, max_relative = 1e-9);
    assert_relative_eq!(to_and_fro([SHEAR, hardening], limit, 0.001, 0.0), 0.04);
}

/// In the plane of shear the circle of Mohr keeps its radius where the mean stress stays.
#[test]
fn soil_turns_its_circle() {
    for stress in [[-0.6, -1.0], [-1.0, -0.6]] {
        let soil = ShearedSoil::new(SHEAR, stress, 30.0, 0.02);
        let first = soil.first();
        let [x, y, tau] = soil.at(first);
        assert_relative_eq!(
            0.25 * (x - y).powi(2) + tau * tau,
            soil.radius.powi(2),
            max_relative = 1e-12
        );
        let rate = |&[apart, tau]: &[f64; 2]| {
            let along = tau * SHEAR / soil.radius.powi(2);
            [-along * apart, SHEAR - along * tau]
        };
        let more = 0.4 * soil.radius / SHEAR;
        let [apart, tau] = integrated([soil.apart, SHEAR * first], more, rate);
        let exact = soil.at(first + more);
        assert_relative_eq!(exact[2], tau, max_relative = 1e-10);
        assert_relative_eq!(exact[0] - exact[1], 2.0 * apart, max_relative = 1e-10);
        assert_relative_eq!(
            exact[0] + exact[1],
            stress[0] + stress[1],
            max_relative = 1e-12
        );
    }
}

/// At constant volume the plastic dilation of a multiplier is undone by an elastic compression; consistency gives the
/// multiplier.
#[test]
fn held_dilation_compresses() {
    let (soil, mean) = ([30.0_f64, 0.02, 12.0_f64], -1.0);
    let (sine, cosine) = soil[0].to_radians().sin_cos();
    let flow = soil[2].to_radians().sin();
    let first = (soil[1] * cosine - mean * sine) / SHEAR;
    // f = tau + m sin(phi) - c cos(phi), plastic angle mu, plastic area strain mu sin(psi).
    let rate = |_: &[f64; 2]| {
        let mu = SHEAR / (SHEAR + sine * flow * (LAMBDA + SHEAR));
        [-(LAMBDA + SHEAR) * flow * mu, SHEAR * (1.0 - mu)]
    };
    let [m, tau] = integrated([mean, SHEAR * first], 3.0 * first, rate);
    let exact = held_dilation([LAMBDA, SHEAR], mean, soil, 4.0 * first);
    assert_relative_eq!(exact[0], m, max_relative = 1e-10);
    assert_relative_eq!(exact[1], tau, max_relative = 1e-10);
    let below = held_dilation([LAMBDA, SHEAR], mean, soil, 0.5 * first);
    assert_relative_eq!(below[1], 0.5 * first * SHEAR);
}

/// tau' = G (g' - (tau - limit)/mu) beyond the limit.
#[test]
fn mud_begins_to_flow() {
    let (viscosity, limit, rate) = (3.0, 2.0, 1.5);
    let first = limit / (SHEAR * rate);
    let flow = |&[tau]: &[f64; 1]| [SHEAR * (rate - (tau - limit) / viscosity)];
    let [tau] = integrated([limit], 0.1, flow);
    let exact = bingham([SHEAR, viscosity, limit], rate, first + 0.1);
    assert_relative_eq!(exact, tau, max_relative = 1e-10);
    let half = bingham([SHEAR, viscosity, limit], rate, 0.5 * first);
    assert_relative_eq!(half, 0.5 * limit);
}
