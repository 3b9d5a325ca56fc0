//! Curves of the paths of the laboratory in closed form.

use super::{Control, Test, cam_clay};
use proctor_laws::{AnyLaw, Bingham, CamClay, LinearElastic, Newtonian, VonMises};

/// Halvings of an interval in which a plastic strain is looked for.
const HALVINGS: usize = 100;

/// q \[Pa\] after a strain of the path, gone at a constant rate \[1/s\] from an isotropic pressure \[Pa\]: along Hooke's line up
/// to the strength, or on with hardening; for a fluid what its rate and its time make of it. `None` where that has no closed
/// form: where two stresses change by laws of their own, strength softens with its flow, or a relaxation time delays it.
#[must_use]
pub fn exact_deviator(
    test: Test,
    law: &AnyLaw,
    pressure: f64,
    strain: f64,
    rate: f64,
) -> Option<f64> {
    if law.is_fluid() {
        return of_fluid(test, law, strain, rate);
    }
    if constant(law, "relaxation_time").is_some_and(|tau| tau > 0.0) {
        return None;
    }
    if law.downcast::<CamClay>().is_some() {
        return cam_clay::deviator(test, law, pressure, strain);
    }
    let young = law.young();
    let shear = shear_modulus(young, law.wave_speed(1.0).powi(2));
    // What q grows by with the strain, and falls by with the plastic strain.
    let (slope, falls) = match test {
        Test::Triaxial | Test::Extension => (young, young),
        Test::Undrained => (3.0 * shear, 3.0 * shear),
        Test::Shear => (3.0_f64.sqrt() * shear, 3.0 * shear),
        Test::Oedometer => (2.0 * shear, 3.0 * shear),
        // Hooke's line is not that of q alone.
        Test::Biaxial | Test::Isotropic => return None,
    };
    let trial = slope * strain;
    if law.downcast::<LinearElastic>().is_some() {
        return Some(trial);
    }
    if law.downcast::<VonMises>().is_some() {
        return hardened(law, trial, falls);
    }
    Some(trial.min(test.strength(law, pressure)?))
}

/// q = `trial` - `falls` k on the yield stress Y(k) of von Mises, by bisection.
fn hardened(law: &AnyLaw, trial: f64, falls: f64) -> Option<f64> {
    let of = |key| constant(law, key);
    let (first, hardening) = (of("yield_stress")?, of("hardening")?);
    let (saturation, rate) = (of("hardening.saturation")?, of("hardening.rate")?);
    let rows: Vec<[f64; 2]> = law
        .curves()
        .into_iter()
        .flat_map(|(_, rows)| rows)
        .collect();
    let yield_stress = |k: f64| {
        let (mut from, mut slope) = ([0.0, first], hardening);
        for row in &rows {
            if k <= row[0] {
                slope = (row[1] - from[1]) / (row[0] - from[0]);
                break;
            }
            from = *row;
        }
        let saturated = saturation * -libm::expm1(-rate * k);
        (from[1] + slope * (k - from[0]) + saturated).max(0.0)
    };
    // Where it softens faster than that, the path turns back.
    let corners = [[0.0, first]].into_iter().chain(rows.iter().copied());
    let slopes = corners
        .clone()
        .zip(corners.skip(1))
        .map(|(a, b)| (b[1] - a[1]) / (b[0] - a[0]));
    if slopes.chain([hardening]).any(|slope| slope <= -falls) {
        return None;
    }
    if trial <= first {
        return Some(trial);
    }
    let (mut low, mut high) = (0.0, trial / falls);
    for _ in 0..HALVINGS {
        let k = 0.5 * (low + high);
        if trial - falls * k > yield_stress(k) {
            low = k;
        } else {
            high = k;
        }
    }
    Some(trial - falls * low)
}

/// q of a fluid where all strains are driven, in proportion: with the angle g of a shear that has the same invariant, Newton's
/// is mu g', and Bingham's G g up to its yield stress and tau_y + mu g' (1 - exp(-G (t - t_y)/mu)) from there on.
fn of_fluid(test: Test, law: &AnyLaw, strain: f64, rate: f64) -> Option<f64> {
    let [xx, yy, zz, yz, xz, xy] = strains(test, strain)?;
    let mean = (xx + yy + zz) / 3.0;
    let normal: f64 = [xx, yy, zz].iter().map(|e| (e - mean).powi(2)).sum();
    let beside = yz * yz + xz * xz + xy * xy;
    let angle = 2.0 * (0.5 * normal + beside).sqrt();
    if angle == 0.0 {
        return Some(0.0);
    }
    let angle_rate = angle / strain * rate;
    let of = |key| constant(law, key);
    let viscosity = of("viscosity")?;
    let tau = if law.downcast::<Newtonian>().is_some() {
        viscosity * angle_rate
    } else if law.downcast::<Bingham>().is_some() {
        let (limit, shear) = (of("yield_stress")?, of("shear")?);
        let time = (angle - limit / shear) / angle_rate;
        if time <= 0.0 {
            shear * angle
        } else if viscosity == 0.0 {
            limit
        } else {
            limit - viscosity * angle_rate * libm::expm1(-shear * time / viscosity)
        }
    } else {
        return None;
    };
    Some(3.0_f64.sqrt() * tau)
}

/// Pressure p \[Pa\] of a fluid after a strain of the path, from an isotropic pressure \[Pa\] on: K/n (J^-n - 1) of its volume, or
/// -K ln J. `None` where strains are not driven, where the volume grows, so that it may part, and for a solid.
#[must_use]
pub fn exact_pressure(test: Test, law: &AnyLaw, pressure: f64, strain: f64) -> Option<f64> {
    if !law.is_fluid() {
        return None;
    }
    let [xx, yy, zz, ..] = strains(test, strain)?;
    let swells = xx + yy + zz;
    if swells > 0.0 {
        return None;
    }
    let (bulk, n) = (constant(law, "bulk")?, constant(law, "exponent")?);
    Some(if n == 0.0 {
        pressure - bulk * swells
    } else {
        // J^-n at the start is 1 + n p/K.
        let start = 1.0 + n * pressure / bulk;
        bulk / n * (start * libm::exp(-n * swells) - 1.0)
    })
}

/// Strains xx, yy, zz, yz, xz, xy of a test that drives all of them.
fn strains(test: Test, strain: f64) -> Option<[f64; 6]> {
    let mut all = [0.0; 6];
    for (own, control) in all.iter_mut().zip(test.controls(strain)) {
        match control {
            Control::Strain(strain) => *own = strain,
            Control::Held => return None,
        }
    }
    Some(all)
}

/// A constant of a law by its key.
pub(super) fn constant(law: &AnyLaw, key: &str) -> Option<f64> {
    let all = law.constants().into_iter();
    all.into_iter()
        .find(|(constant, _)| constant.key == key)
        .map(|(_, value)| value)
}

/// Shear modulus from Young's modulus and the confined modulus \[Pa\]: with the ratio m of the latter to the former,
/// 2 nu = (1 - m + sqrt((m - 1)(9 m - 1)))/(2 m) of (1 - nu) = m (1 + nu)(1 - 2 nu).
fn shear_modulus(young: f64, confined: f64) -> f64 {
    let m = confined / young;
    let poisson = ((1.0 - m) + ((m - 1.0).max(0.0) * (9.0 * m - 1.0)).sqrt()) / (4.0 * m);
    young / (2.0 * (1.0 + poisson))
}
