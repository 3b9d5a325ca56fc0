//! The turn of the disk on its way, and how far from that a mesh may leave it.

use super::{
    DENSITY, GAP, GRAVITY, INCLINATION_DEGREES, KAPPA, KAPPA_T, POISSON, RADIUS, RATIO, YOUNG,
    friction, young,
};
use crate::cases::prelude::*;
use crate::exact::fe::Barrier;
use crate::exact::hertz::{Hertz, contact_modulus};
use crate::exact::hertz_layer::LayerContact;
use crate::exact::rolling_creep::RollingCreep;
use crate::exact::rolling_disk::RollingDisk as Rigid;

/// The square of the strain rho omega² R²/E of the disk that rolls, at the end of its way: 13.08/s.
pub(super) const SECOND_ORDER: f64 = 0.0026;
/// Largest distance of the resultant of the pressure from the middle of the contact, in cells. Friction is a tenth of it, so
/// that its moment counts ten times; `slipping-disk` judges a disk that is stiffer.
const BESIDE: f64 = 0.015;
const SPACING: f64 = TAU * RADIUS / 64.0; // Spacing of the disk's vertices [m]
const FLOOR: f64 = 0.05; // The kernel's share of the critical gap below which the barrier is linear

/// Mass per thickness \[kg/m\].
fn mass() -> f64 {
    DENSITY * PI * RADIUS * RADIUS
}

/// Force on the plane, per thickness \[N/m\].
fn load() -> f64 {
    mass() * GRAVITY * libm::cos(INCLINATION_DEGREES.to_radians())
}

fn hertz(young: f64) -> Hertz {
    Hertz {
        radius: RADIUS,
        load: load(),
        modulus: contact_modulus([young, f64::INFINITY], [POISSON, 0.0]),
    }
}

/// The rolling disk on its layer and spring, of the given and of the stiff one.
fn rolling(variant: &str) -> Result<&'static RollingCreep, String> {
    static KNOWN: [OnceLock<Result<RollingCreep, String>>; 2] = [const { OnceLock::new() }; 2];
    let compute = || {
        let law = Barrier {
            stiffness: KAPPA,
            critical_gap: GAP,
            floor: FLOOR,
        };
        // The layer reaches to where the rim is as far from the plane as the critical gap. Gaps are counted from
        // below the plane, since the solution is sought among those above zero.
        let extent = 1.1 * (2.0 * RADIUS * GAP).sqrt();
        let below = FLOOR * GAP;
        let layer = |gap| {
            let (_, pressure, stiffness) = law.at(gap - below);
            (pressure, -stiffness)
        };
        let contact =
            LayerContact::solve(&hertz(young(variant)), &layer, 220, extent, 0.1 * GAP)
                .map_err(|e| format!("the layer under the disk: residual {:e} m", e.residual))?;
        Ok(RollingCreep {
            contact,
            radius: RADIUS,
            stiffness: KAPPA_T,
            friction: friction(variant),
        })
    };
    let known = KNOWN[usize::from(variant == "stiff")].get_or_init(compute);
    known.as_ref().map_err(Clone::clone)
}

/// Creep of the disk that sticks, under the force that turns a rigid one.
fn creep(variant: &str) -> Result<f64, String> {
    let force = mass() * GRAVITY * libm::sin(INCLINATION_DEGREES.to_radians()) / 3.0;
    let rolling = rolling(variant)?;
    let creep = rolling.creep(force);
    creep.ok_or_else(|| "friction does not roll the disk".to_owned())
}

/// Circumferential over translational speed.
pub(super) fn expected(rigid: &Rigid, variant: &str) -> Result<f64, String> {
    if rigid.sticks() {
        Ok(1.0 - creep(variant)?)
    } else {
        Ok(rigid.rolling_ratio())
    }
}

/// Growth of the area of the elastic disk, to first order: the mean of the stresses is that of the moments of the
/// forces, int tr(sigma) dA = int rho omega² r² dA - N R, whatever their distribution.
pub(super) fn growth(spin: f64, young: f64) -> f64 {
    let mean = 0.5 * DENSITY * (spin * RADIUS).powi(2) - load() / (PI * RADIUS);
    (1.0 + POISSON) * (1.0 - 2.0 * POISSON) / young * mean
}

/// Approach of a disk of this modulus over its radius, by which the arm of the friction is shorter: of the half-plane
/// under the pressure of Hertz (Johnson, eq. 5.57 with a rigid plane).
fn flattening() -> f64 {
    hertz(YOUNG).approach() / RADIUS
}

/// Largest relative error of the ratio on a mesh, and why.
pub(super) fn bound(rung: &Rung) -> (f64, &'static str) {
    if rung.variant != "slip" {
        let reason = "the rim is shorter where it is pressed, by (1 + nu)(1 - 2 nu) p/E; the creep is summed over a few vertices";
        return shortened(rung.variant).map_or((f64::NAN, "no reference"), |bound| (bound, reason));
    }
    let cell = rung.cell / RADIUS;
    // Mass on nodes has h²/6 more than its particles of the second moment along each axis (linear weights).
    let inertia = 2.0 / 3.0 * cell * cell;
    (
        flattening() + BESIDE / friction(rung.variant) * cell + inertia,
        "the arm of the friction is shorter by the flattening, the pressure lies beside the middle by 0.015 h at most, inertia is larger by 2/3 (h/R)²",
    )
}

/// Largest error of the ratio of the disk that sticks: the strain of its rim, and a creep that is a sum over vertices.
fn shortened(variant: &str) -> Result<f64, String> {
    let (rolling, creep) = (rolling(variant)?, creep(variant)?);
    let strain = (1.0 + POISSON) * (1.0 - 2.0 * POISSON) * rolling.mean_pressure() / young(variant);
    Ok(strain + creep * (SPACING / rolling.half_width()).powi(2))
}

/// Gate on the order at which the turn of the disk that slips approaches that of the flattened disk.
pub(super) fn order(runs: &Runs<'_>) -> Gate {
    let slips: Vec<_> = runs
        .solved
        .iter()
        .filter(|(r, _)| r.variant == "slip")
        .collect();
    let order = match slips[..] {
        [.., (coarse, a), (fine, b)] => {
            let [a, b] = [a, b].map(|s| s.error(RATIO) - flattening());
            libm::log(a / b) / libm::log(coarse.cell / fine.cell)
        }
        _ => f64::NAN,
    };
    let reason =
        "the pressure lies beside the middle of the contact by a part of a cell: first order";
    let name = format!("slip: observed order of {RATIO}, beyond the flattening");
    Gate::at_least(name, order, 1.0, reason)
}
