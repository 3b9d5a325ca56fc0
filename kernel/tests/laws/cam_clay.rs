//! Modified Cam clay against closed forms, and what must hold of each return.

use crate::laws::support::{DENSITY, close, first_order, numbers};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_laws::{AnyLaw, CamClay, Law, Point};

/// M, slopes of ln v against ln p in first compression and in swelling, Poisson's ratio.
const M: f64 = 1.2;
const FIRST: f64 = 0.1;
const SWELLING: f64 = 0.02;
const POISSON: f64 = 0.25;
const SHARE: f64 = 1.0 - SWELLING / FIRST;
const START: f64 = 100.0;

fn clay() -> CamClay {
    CamClay::new(M, FIRST, SWELLING, POISSON)
}

fn pressed(law: impl Into<AnyLaw>, p: f64) -> Point {
    Point::new(&law.into(), DENSITY, [-p, -p, -p, 0.0, 0.0, 0.0])
}

/// Pressure and deviator stress.
fn invariants(s: &[f64; 6]) -> [f64; 2] {
    let mean = (s[0] + s[1] + s[2]) / 3.0;
    let normal: f64 = s[..3].iter().map(|x| (x - mean).powi(2)).sum();
    let beside: f64 = s[3..].iter().map(|x| x * x).sum();
    [-mean, (1.5 * normal + 3.0 * beside).sqrt()]
}

fn preconsolidation(point: &Point) -> f64 {
    point.variables()[4]
}

/// In isotropic compression and swelling ln v is straight in ln p, for any step.
#[test]
fn isotropic_lines_are_straight_for_any_step() {
    for steps in [8, 40] {
        let mut point = pressed(clay(), START);
        let by = |point: &mut Point, strain: f64| {
            let e = -strain / 3.0 / f64::from(steps);
            for _ in 0..steps {
                point
                    .strain(&[e, e, e, 0.0, 0.0, 0.0], 1.0)
                    .expect("a stress");
            }
        };
        // The logarithm of a volume ratio of increments half way differs from their sum in the third order: it is read.
        by(&mut point, 0.02);
        let p = START * (-point.volume().ln() / FIRST).exp();
        close(invariants(&point.stress())[0], p, 1e-10, p);
        close(preconsolidation(&point), p, 1e-10, p);
        let before = point.volume();
        by(&mut point, -0.01);
        let p = p * ((before / point.volume()).ln() / SWELLING).exp();
        close(invariants(&point.stress())[0], p, 1e-10, p);
        by(&mut point, 0.02);
        let p = START * (-point.volume().ln() / FIRST).exp();
        close(invariants(&point.stress())[0], p, 1e-10, p);
    }
}

/// Shear at constant volume by a deviator strain, in equal steps.
fn undrained(law: CamClay, strain: f64, steps: u32) -> Point {
    let mut point = pressed(law, START);
    let e = strain / f64::from(steps);
    for _ in 0..steps {
        let increment = [0.5 * e, 0.5 * e, -e, 0.0, 0.0, 0.0];
        point.strain(&increment, 1.0).expect("a stress");
    }
    point
}

/// Deviator strain on the undrained path up to a stress ratio, q there given: elastic to the ellipse and along it.
fn undrained_strain(shear: f64, ocr: f64, [p, q]: [f64; 2]) -> f64 {
    let (eta, first) = (q / p, M * (ocr - 1.0).sqrt());
    let plastic = |x: f64| {
        let y = x / M;
        SWELLING * SHARE * 2.0 / M * (y.atanh() - y.atan())
    };
    let r = 3.0 * (1.0 - 2.0 * POISSON) / (2.0 * (1.0 + POISSON));
    let elastic = if shear > 0.0 {
        q / (3.0 * shear)
    } else {
        let to = |x: f64| x * (1.0 - 2.0 * SHARE) + 2.0 * SHARE * M * (x / M).atan();
        SWELLING / (3.0 * r) * (to(eta) - to(first) + first)
    };
    elastic + plastic(eta) - plastic(first)
}

/// On an undrained path p = p_0 ((M² + eta_0²)/(M² + eta²))^(1 - kappa/lambda) for any step, since both volume strains
/// are
/// logarithms; the strain there is of first order.
#[test]
fn an_undrained_path_is_the_closed_form() {
    for (shear, ocr) in [(0.0, 1.0), (3000.0, 1.0), (0.0, 1.6), (3000.0, 1.6)] {
        let law = clay().with_shear(shear).overconsolidated(ocr);
        let strain = 0.02;
        let off = |steps: u32| {
            let [p, q] = invariants(&undrained(law, strain, steps).stress());
            let first = M * M * (ocr - 1.0);
            let exact = START * ((M * M + first) / (M * M + (q / p).powi(2))).powf(SHARE);
            assert!(q > 0.5 * M * p);
            // Increments half way change the volume in the third order.
            let volume = 2.0 * f64::from(steps) * (strain / f64::from(steps)).powi(3);
            close(p, exact, volume / SWELLING + 1e-12, START);
            (undrained_strain(shear, ocr, [p, q]) - strain).abs()
        };
        let errors = [400, 800, 1600].map(off);
        first_order(&errors);
        assert!(errors[2] < 1e-3 * strain, "{errors:?}");
    }
}

/// Critical states: p_f = p_0 (R/2)^(1 - kappa/lambda), q = M p_f.
#[test]
fn an_undrained_strength_is_that_of_the_critical_state() {
    for (ocr, p_end, strength) in [(1.0, 57.434_918, 34.460_951), (1.6, 83.651_164, 50.190_699)] {
        let of =
            |steps: u32| invariants(&undrained(clay().overconsolidated(ocr), 0.6, steps).stress());
        let [coarse, middle, fine] = [6000, 12000, 24000].map(of);
        let extrapolated = |i: usize| {
            let first = [2.0 * middle[i] - coarse[i], 2.0 * fine[i] - middle[i]];
            (4.0 * first[1] - first[0]) / 3.0
        };
        close(extrapolated(0), p_end, 1e-6, START);
        close(0.5 * extrapolated(1), strength, 1e-6, START);
    }
}

/// Compressed along z by a strain in equal steps, under a pressure around that stays: the strain across is looked for by halvings.
fn drained(law: CamClay, strain: f64, steps: u32) -> Point {
    let mut point = pressed(law, START);
    let e = strain / f64::from(steps);
    for _ in 0..steps {
        let stepped = |across: f64| {
            let mut after = point.clone();
            let strained = after.strain(&[across, across, -e, 0.0, 0.0, 0.0], 1.0);
            strained.expect("a stress");
            after
        };
        let (mut low, mut high) = (-e, e);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if stepped(middle).stress()[0] > -START {
                high = middle;
            } else {
                low = middle;
            }
        }
        point = stepped(0.5 * (low + high));
    }
    point
}

/// On the drained path q = 3 (p - p_0) the volume strain is kappa ln(p/p_0) + (lambda - kappa) ln(p_c/p_0) for any step; the
/// strain is of first order.
#[test]
fn a_drained_path_is_the_closed_form() {
    let off = |steps: u32| {
        let point = drained(clay(), 0.05, steps);
        let [p, q] = invariants(&point.stress());
        close(q, 3.0 * (p - START), 1e-9, START);
        let eta = q / p;
        let risen = (p / START).ln();
        let hardened = risen + (eta / M).powi(2).ln_1p();
        let volume = SWELLING * risen + (FIRST - SWELLING) * hardened;
        close(-point.volume().ln(), volume, 1e-10, 1.0);
        let integral = |x: f64| {
            let ends = -(M - x).ln() / (3.0 - M) - (M + x).ln() / (3.0 + M);
            ends + 6.0 / (9.0 - M * M) * (3.0 - x).ln()
        };
        let bent = 2.0 / M * ((eta / M).atanh() - (eta / M).atan());
        let sheared =
            (FIRST - SWELLING) * (integral(eta) - integral(0.0) + bent) + SWELLING / 0.6 * risen;
        (sheared + volume / 3.0 - 0.05).abs()
    };
    let errors = [100, 200, 400].map(off);
    first_order(&errors);
    assert!(errors[2] < 2e-4, "{errors:?}");
}

/// Random strains: the stress lies on the ellipse or within, flow is along its normal, nothing comes from plastic work.
#[test]
fn a_return_keeps_what_defines_it() {
    let mut next = numbers(11);
    for shear in [0.0, 3000.0] {
        let law = clay().with_shear(shear);
        for _ in 0..3000 {
            // A state on the ellipse of 100 Pa.
            let p = 50.5 + 48.0 * next();
            let q = M * (p * (START - p)).sqrt();
            let unit: [f64; 6] = std::array::from_fn(|_| next());
            let [mean, of_unit] = invariants(&unit);
            let stress: [f64; 6] = std::array::from_fn(|i| {
                let s = if i < 3 { unit[i] + mean } else { unit[i] };
                s * q / of_unit - if i < 3 { p } else { 0.0 }
            });
            let law: AnyLaw = law.preconsolidated(START * (1.0 + 1e-15)).into();
            let mut point = Point::new(&law, DENSITY, stress);
            let e = std::array::from_fn(|_| 3e-4 * next());
            point.strain(&e, 1.0).expect("a stress");
            let ([p, q], most) = (invariants(&point.stress()), preconsolidation(&point));
            let f = (q / M).powi(2) + p * (p - most);
            assert!(f < 1e-11 * most * most, "{f:e} of {stress:?} by {e:?}");
            let [strain, work, _, compression, _] = point.variables()[..] else {
                panic!("five variables");
            };
            assert!(work >= 0.0 && strain >= 0.0);
            if strain > 0.0 {
                assert!(f.abs() < 1e-11 * most * most, "{f:e}");
                // dq : dp as 2 q/M² : 2 p - p_c.
                let multiplier = strain * M * M / (2.0 * q);
                close(compression, multiplier * (2.0 * p - most), 1e-10, 1e-3);
                close(
                    (most / START).ln(),
                    compression / (FIRST - SWELLING),
                    1e-9,
                    1e-3,
                );
            } else {
                close(most, START, 1e-12, START);
            }
        }
    }
}

/// Pressures and moduli of twice the size have stresses of twice the size, bit by bit.
#[test]
fn scales_of_two_keep_the_bits() {
    let of = |unit: f64| {
        let law = clay().with_shear(3000.0 * unit);
        let mut point = pressed(law, START * unit);
        for step in 0..40 {
            let e = 1e-4 * f64::from(step % 7);
            let strained = point.strain(&[e, -2e-4, -e, 1e-4, 0.0, 2e-4], 1.0);
            strained.expect("a stress");
        }
        point.stress().map(|s| (s / unit).to_bits())
    };
    for unit in [2.0_f64.powi(-300), 0.5, 2.0, 2.0_f64.powi(300)] {
        assert_eq!(of(unit), of(1.0), "{unit:e}");
    }
}

#[test]
fn lanes_have_the_same_bits() {
    let at_end = |lanes: SelectedLanes| {
        let mut point = pressed(clay(), START).on(lanes);
        for step in 0..40 {
            let e = 1e-4 * f64::from(step % 7);
            let strained = point.strain(&[e, -2e-4, -e, 1e-4, 0.0, 2e-4], 1.0);
            strained.expect("a stress");
        }
        (point.stress().into_iter().chain(point.variables()))
            .map(f64::to_bits)
            .collect::<Vec<_>>()
    };
    let reference = at_end(SelectedLanes::plain());
    for choice in [LaneChoice::Scalar, LaneChoice::Avx2, LaneChoice::Avx512] {
        if let Ok(lanes) = SelectedLanes::new(choice) {
            assert_eq!(at_end(lanes), reference);
        }
    }
}

/// A small cycle within the ellipse gives back what it took, and the remainder of a path falls with its step.
#[test]
fn books_close_and_their_remainder_falls_with_the_step() {
    let law = clay().with_shear(3000.0).overconsolidated(4.0);
    let mut point = pressed(law, START);
    let start = point.energy();
    let n = 400;
    for step in 0..n {
        let phase = std::f64::consts::TAU * (f64::from(step) + 0.5) / f64::from(n);
        let (s, c) = (phase.sin(), phase.cos());
        let e = [8e-6 * c, 4e-6 * s, 6e-6 * c, 0.0, 0.0, 8e-6 * s];
        point.strain(&e, 1.0).expect("a stress");
    }
    assert!(point.dissipated() == 0.0);
    close(point.energy(), start, 1e-4, start);
    assert!(point.algorithmic().abs() < 1e-4 * start);
    let left = |steps: u32| {
        let point = undrained(clay().with_shear(3000.0), 0.02, steps);
        point.algorithmic().abs() / point.dissipated()
    };
    first_order(&[200, 400, 800].map(left));
}

/// The elastic slope of swelling has the speed that a step returns, and no stress but a pressure has one.
#[test]
fn stiffness_is_that_of_the_pressure() {
    let law = clay().overconsolidated(2.0).at_pressure(START);
    let [bulk, shear] = [START / SWELLING, 0.6 * START / SWELLING];
    let exact = ((bulk + 4.0 / 3.0 * shear) / DENSITY).sqrt();
    close(law.wave_speed(DENSITY), exact, 1e-12, exact);
    let mut point = pressed(law, START);
    let e = -1e-7;
    point
        .strain(&[e, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0)
        .expect("a stress");
    let slope = (-START - point.stress()[0]) / -e;
    close((slope / DENSITY).sqrt(), exact, 1e-5, exact);
    for p in [0.0, -1.0] {
        let mut point = pressed(clay(), p);
        assert!(point.step(&[[0.0; 3]; 3], 1.0).is_err());
    }
}
