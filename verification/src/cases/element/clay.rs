//! Clay at a point, and its exact answers.

use super::PRESSURE;
use crate::exact::cam_clay::CamClayExact;
use proctor_laws::CamClay;

/// Stress of the clay at rest under that pressure, along z its axis, by the roots of exact/cam_clay.rs \[Pa\].
pub(super) const STRESS_AT_REST: [f64; 6] = {
    let [across, along] = [-0.843_755_808_474_384_5, -1.312_488_383_051_231];
    [across, across, along, 0.0, 0.0, 0.0]
};

/// The clay that is sheared and pressed, stiffer by a factor in swelling, under the pressure at the start.
fn exact(stiffer: f64) -> CamClayExact {
    CamClayExact {
        critical_ratio: 1.2,
        compression: 0.1,
        swelling: 0.02 / stiffer,
        poisson: 0.25,
        pressure: PRESSURE,
    }
}

pub(super) fn law() -> CamClay {
    let of = exact(1.0);
    CamClay::new(of.critical_ratio, of.compression, of.swelling, of.poisson)
}

/// Stress on the undrained path of the clay at a strain along the axis; halvings find the stress ratio.
pub(super) fn undrained(stiffer: f64, strain: f64) -> [f64; 6] {
    let clay = exact(stiffer);
    let (mut low, mut high) = (0.0, clay.critical_ratio);
    for _ in 0..100 {
        let eta = 0.5 * (low + high);
        if clay.undrained_strain(eta, 0.0) < strain {
            low = eta;
        } else {
            high = eta;
        }
    }
    triaxial(clay.undrained_pressure(low, 0.0), low)
}

/// Stress of a pressure and a stress ratio, compressed along z.
fn triaxial(p: f64, eta: f64) -> [f64; 6] {
    let across = -p * (1.0 - eta / 3.0);
    [across, across, -p * (1.0 + 2.0 * eta / 3.0), 0.0, 0.0, 0.0]
}

/// Stress in first compression of the clay at rest, after a strain along the axis: the stress ratio stays, and ln v is
/// straight in ln p.
pub(super) fn at_rest(stiffer: f64, strain: f64) -> [f64; 6] {
    let clay = exact(stiffer);
    let p = PRESSURE * libm::exp(strain / clay.compression);
    triaxial(p, clay.ratio_at_rest())
}
