//! Confined compression of a solid that yields, against Hooke's law, yield conditions and flow rules solved in small steps.

use approx::assert_relative_eq;
use proctor_verification::exact::two_slopes::TwoSlopes;

const YOUNG: f64 = 100.0;
const YIELD: f64 = 0.1;
const HARDENING: f64 = 10.0;
/// Friction (degrees), cohesion, dilation (degrees).
const SOILS: [[f64; 3]; 4] = [
    [0.0, 0.1, 0.0],
    [20.0, 0.05, 0.0],
    [25.0, 0.05, 10.0],
    [30.0, 0.05, 30.0],
];

/// Lamé's constants.
fn lame(poisson: f64) -> (f64, f64) {
    let shear = YOUNG / (2.0 * (1.0 + poisson));
    (2.0 * shear * poisson / (1.0 - 2.0 * poisson), shear)
}

/// Root of a rising function by bisection.
fn root(mut low: f64, mut high: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if of(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Compression along and across the axis, and plastic work per volume, after a compressive strain in `steps` steps: each
/// finds the multiplier that ends on the surface. `surface` is positive beyond it, of both compressions and the sum of
/// multipliers; `flow` the compressive plastic strain along and across per multiplier.
fn strained(
    poisson: f64,
    strain: f64,
    steps: u32,
    surface: impl Fn(f64, f64, f64) -> f64,
    flow: [f64; 2],
) -> [f64; 3] {
    let (lambda, shear) = lame(poisson);
    let stress = |along: f64, across: f64| {
        let volume = lambda * (along + 2.0 * across);
        [volume + 2.0 * shear * along, volume + 2.0 * shear * across]
    };
    let [mut along, mut across, mut sum, mut work] = [0.0; 4];
    for _ in 0..steps {
        along += strain / f64::from(steps);
        let at = |more: f64| stress(along - more * flow[0], across - more * flow[1]);
        let beyond = |more: f64| {
            let [q, s] = at(more);
            surface(q, s, sum + more)
        };
        if beyond(0.0) > 0.0 {
            let more = root(0.0, strain, |more| -beyond(more));
            let [q, s] = at(more);
            work += more * (q * flow[0] + 2.0 * s * flow[1]);
            along -= more * flow[0];
            across -= more * flow[1];
            sum += more;
        }
    }
    let [q, s] = stress(along, across);
    [q, s, work]
}

/// Compares both slopes and the plastic work with what small steps give.
fn agrees(
    solid: &TwoSlopes,
    poisson: f64,
    surface: impl Fn(f64, f64, f64) -> f64 + Copy,
    flow: [f64; 2],
) {
    let limit = solid.limit;
    assert!(limit > 0.0 && limit.is_finite());
    let elastic = poisson / (1.0 - poisson) * limit;
    assert!(surface(limit, elastic, 0.0).abs() < 1e-14);
    // Continuous where it yields.
    let [low, high] = [1.0, 1.0 + 1e-13].map(|share| solid.across(share * limit));
    assert_relative_eq!(low, high, epsilon = 1e-12 * limit);
    assert_relative_eq!(low, elastic, epsilon = 1e-12 * limit);
    for share in [1.0, 1.5, 3.0] {
        let q = share * limit;
        let [along, across, work] = strained(poisson, solid.strain(q), 4000, surface, flow);
        assert_relative_eq!(along, q, epsilon = 1e-10 * q);
        assert_relative_eq!(across, solid.across(q), epsilon = 1e-10 * q);
        let scale = q * solid.strain(q);
        assert!((work - solid.plastic_work(q)).abs() < 1e-3 * scale);
        assert!(solid.plastic_work(q) >= -1e-15 * scale);
    }
    assert_eq!(solid.plastic_work(0.5 * limit), 0.0);
}

/// Flow along the deviator: k along the axis and -k/2 across it have the equivalent plastic strain k.
#[test]
fn von_mises_follows_its_flow_rule() {
    for (poisson, hardening) in [(0.3, HARDENING), (0.3, 0.0), (0.0, 30.0)] {
        let solid = TwoSlopes::von_mises(YOUNG, poisson, YIELD, hardening);
        let surface = |q: f64, s: f64, k: f64| q - s - YIELD - hardening * k;
        agrees(&solid, poisson, surface, [1.0, -0.5]);
    }
}

/// The plastic work of von Mises in closed form: the integral of the yield stress over k.
#[test]
fn von_mises_dissipates_its_yield_stress() {
    let solid = TwoSlopes::von_mises(YOUNG, 0.3, YIELD, HARDENING);
    let (_, shear) = lame(0.3);
    for share in [1.1, 2.0, 5.0] {
        let q = share * solid.limit;
        let k = 2.0 * shear * (q - solid.limit) / solid.plastic_modulus / (3.0 * shear + HARDENING);
        let work = YIELD * k + 0.5 * HARDENING * k * k;
        assert_relative_eq!(solid.plastic_work(q), work, max_relative = 1e-11);
    }
}

/// Both planes through the edge flow: each along its own direction across and both along the axis.
#[test]
fn mohr_coulomb_follows_its_flow_rule() {
    for [friction, cohesion, dilation] in SOILS {
        let (sine, cosine) = f64::to_radians(friction).sin_cos();
        let flow = f64::to_radians(dilation).sin();
        let surface =
            |q: f64, s: f64, _: f64| (1.0 - sine) * q - (1.0 + sine) * s - 2.0 * cohesion * cosine;
        let solid = TwoSlopes::mohr_coulomb(YOUNG, 0.2, [friction, cohesion, dilation]);
        let directions = [2.0 * (1.0 - flow), -(1.0 + flow)];
        agrees(&solid, 0.2, surface, directions);
    }
}

#[test]
fn drucker_prager_follows_its_flow_rule() {
    for cone in [
        [0.0, 0.05, 0.0],
        [0.3, 0.05, 0.0],
        [0.4, 0.05, 0.2],
        [0.3, 0.05, 0.3],
    ] {
        let [eta, strength, eta_psi] = cone;
        let root = 3.0_f64.sqrt();
        let surface =
            |q: f64, s: f64, _: f64| (q - s) / root - eta * (q + 2.0 * s) / 3.0 - strength;
        // The derivative of sqrt(J_2) + eta_psi p by the compressions, that across for each of two axes.
        let flow = [1.0 / root - eta_psi / 3.0, -0.5 / root - eta_psi / 3.0];
        let solid = TwoSlopes::drucker_prager(YOUNG, 0.2, cone);
        agrees(&solid, 0.2, surface, flow);
    }
}

/// Confined compression is triaxial compression, where the outer cone touches the pyramid: the same limits and slopes.
#[test]
fn the_outer_cone_is_the_edge_of_the_pyramid() {
    for [friction, cohesion, dilation] in SOILS {
        let (sine, cosine) = f64::to_radians(friction).sin_cos();
        let flow = f64::to_radians(dilation).sin();
        let slope = |sine: f64| 6.0 * sine / (3.0_f64.sqrt() * (3.0 - sine));
        let strength = 6.0 * cohesion * cosine / (3.0_f64.sqrt() * (3.0 - sine));
        let cone = TwoSlopes::drucker_prager(YOUNG, 0.2, [slope(sine), strength, slope(flow)]);
        let pyramid = TwoSlopes::mohr_coulomb(YOUNG, 0.2, [friction, cohesion, dilation]);
        assert_relative_eq!(cone.limit, pyramid.limit, max_relative = 1e-12);
        assert_relative_eq!(
            cone.plastic_modulus,
            pyramid.plastic_modulus,
            max_relative = 1e-12
        );
        assert_relative_eq!(cone.across[0], pyramid.across[0], max_relative = 1e-12);
        assert_relative_eq!(cone.across[1], pyramid.across[1], max_relative = 1e-12);
    }
}
