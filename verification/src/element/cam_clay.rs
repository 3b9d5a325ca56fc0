//! Cam clay along paths of the laboratory, in closed form.

use super::Test;
use super::closed_form::constant;
use crate::exact::cam_clay::CamClayExact;
use proctor_laws::{AnyLaw, CamClay};

/// Halvings of an interval in which a stress ratio is looked for.
const HALVINGS: usize = 100;

/// The clay of an isotropic pressure \[Pa\], and by how much its ellipse is larger than that; `None` for another law,
/// and on the
/// dry side, where strength falls and a path turns back.
fn clay(law: &AnyLaw, pressure: f64) -> Option<(CamClayExact, f64)> {
    let own = law.downcast::<CamClay>()?;
    let of = |key| constant(law, key);
    let over = own.overconsolidation(pressure);
    let clay = CamClayExact {
        critical_ratio: of("critical_ratio")?,
        compression: of("compression")?,
        swelling: of("swelling")?,
        poisson: of("poisson")?,
        pressure,
    };
    (1.0..2.0).contains(&over).then_some((clay, over))
}

/// q \[Pa\] at the critical state, drained under one pressure that is held, or at constant volume.
#[must_use]
pub(super) fn strength(test: Test, law: &AnyLaw, pressure: f64) -> Option<f64> {
    let (clay, over) = clay(law, pressure)?;
    let m = clay.critical_ratio;
    match test {
        Test::Triaxial => Some(m * clay.drained_pressure(m)),
        Test::Undrained => Some(m * clay.undrained_pressure(m, m * (over - 1.0).sqrt())),
        _ => None,
    }
}

/// q \[Pa\] after an axial strain at constant volume, of a clay whose shear modulus grows with the pressure.
#[must_use]
pub(super) fn deviator(test: Test, law: &AnyLaw, pressure: f64, strain: f64) -> Option<f64> {
    let (clay, over) = clay(law, pressure)?;
    let proportional = law.downcast::<CamClay>()?.is_proportional();
    if test != Test::Undrained || !proportional {
        return None;
    }
    let m = clay.critical_ratio;
    let first = m * (over - 1.0).sqrt();
    // Elastic to the ellipse: q = 3 G e.
    let shear =
        3.0 * (1.0 - 2.0 * clay.poisson) / (2.0 * (1.0 + clay.poisson)) * pressure / clay.swelling;
    let elastic = first * pressure / (3.0 * shear);
    if strain <= elastic {
        return Some(3.0 * shear * strain);
    }
    let (mut low, mut high) = (first, m);
    for _ in 0..HALVINGS {
        let eta = 0.5 * (low + high);
        if clay.undrained_strain(eta, first) < strain - elastic {
            low = eta;
        } else {
            high = eta;
        }
    }
    Some(low * clay.undrained_pressure(low, first))
}
