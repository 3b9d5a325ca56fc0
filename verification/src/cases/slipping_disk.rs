//! Does friction turn a disk as much as its impulse says?
//!
//! The disk of `rolling-disk` (R = 0.5 m, 300 kg/m³, nu = 0.3), twenty times as stiff (5 MPa), settles for 0.5 s on a rigid
//! line under the gravity normal to it and is then let go on slopes of 20, 30 and 45 degrees with mu = 0.1: it slides on all
//! of them, and turns by what friction gives it.
//!
//! Exact: d(angular momentum) = arm x d(impulse of friction), whatever the friction was; the arm is R less the approach of
//! the disk to the line (Johnson, eq. 5.57), 0.17 to 0.22 % here. The pressure on a disk that is elastic has no moment about its
//! centre. What is left is that of the method: forces that act elsewhere than at the vertices (by the weights of eq. 56 of
//! Liang et al. 2024 alone they act a tenth of a cell inside), inertia of mass on nodes, and a pressure that is not even about
//! the middle of the contact. `proctor verify slipping-disk`.

use super::prelude::*;
use crate::exact::hertz::{Hertz, contact_modulus};

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.5;
const YOUNG: f64 = 5e6;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 300.0;
const FRICTION: f64 = 0.1;
/// Distance below which the barrier pushes \[m\], and its stiffness \[Pa/m\].
const GAP: f64 = 0.04;
const KAPPA: f64 = 1e4;
const KAPPA_T: f64 = 1e6; // Stiffness of the tangential spring [Pa/m]
/// Local damping while the disk settles, and for how long \[s\].
const SETTLING: f64 = 0.3;
const STAGE: f64 = 0.5;
/// Time from the release to the end \[s\], and its parts after each of which is looked.
const TIME: f64 = 0.5;
const LOOKS: u32 = 20;

const SPIN: &str = "spin per impulse of friction";

const WRONG_ARM: Wrong = Wrong::factor("arm", 1.04);

/// The disk on three slopes.
pub static SLIPPING_DISK: Case = Case::new(
    "slipping-disk",
    "Does friction turn a disk as much as its impulse says?",
)
.ladder(Ladder::sizes(
    &[("30 deg", &[0.2, 0.1])],
    &[
        ("20 deg", &[0.2, 0.1, 0.05]),
        ("30 deg", &[0.2, 0.1, 0.05]),
        ("45 deg", &[0.2, 0.1, 0.05]),
    ],
))
.method(|_| settings(APIC, 5))
.scene(scene)
.run(compare)
.gates_of_variants(&[
    error(SPIN)
        .at_most_of(
            [0.04, 0.01],
            ["one percent at a tenth of the radius, four times as much at a fifth"; 2],
        )
        .by_rung(),
    order(SPIN).at_least(1.8, "inertia of mass on nodes is h² off"),
])
.tables(&[TableRule::new("{variant}", &[SPIN])])
.wrong_references(&[WRONG_ARM])
.studies(&[Plan::new(
    Ladder::sizes(&[("30 deg", &[0.2, 0.1])], &[("30 deg", &[0.2, 0.1, 0.05])]),
    &[Measure::new("spin", SPIN)],
    2,
)])
.no_guest(NO_GUEST);

/// Angle of the slope of a rung \[rad\].
fn slope(rung: &Rung) -> f64 {
    let degrees: f64 = match rung.variant {
        "20 deg" => 20.0,
        "30 deg" => 30.0,
        _ => 45.0,
    };
    degrees.to_radians()
}

/// Arm of the friction \[m\]: the radius less the approach of a disk to a rigid plane under its load.
fn arm(slope: f64) -> f64 {
    let hertz = Hertz {
        radius: RADIUS,
        load: DENSITY * PI * RADIUS * RADIUS * GRAVITY * libm::cos(slope),
        modulus: contact_modulus([YOUNG, f64::INFINITY], [POISSON, 0.0]),
    };
    RADIUS - hertz.approach()
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let slope = slope(rung);
    let (sin, cos) = libm::sincos(slope);
    let way = 0.5 * GRAVITY * (sin - FRICTION * cos) * TIME * TIME;
    let (from, to) = (-1.2, (way + 1.2).ceil());
    let mesh = open_plane(rung.cell, [from, -0.4], [to, 1.4]);
    let count = ((to - from - 0.4) / 0.1).round();
    let at = |k: usize| {
        let share = k as f64 / count;
        Point::new(to - 0.2 - (to - from - 0.4) * share, 0.0)
    };
    let line = open_line("plane", 2, (0..=count as usize).map(at), None);
    let disk = ball([0.0, RADIUS + 0.5 * GAP, 0.0], RADIUS);
    let mut scene = Scene {
        time_step: settings.multiplier(),
        gravity: [0.0, -GRAVITY * cos, 0.0],
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("disk", 1, disk)],
        damping: Damping::Local { alpha: SETTLING },
        mortar: Mortar {
            boundaries: vec![boundary(1, Vertices::Spacing(TAU * RADIUS / 64.0))],
            lines: vec![line],
            contacts: vec![rubbing(
                [FRICTION, KAPPA_T],
                barrier("disk on plane", [2, 1], GAP, KAPPA),
            )],
            ..Mortar::default()
        },
        ..plane_scene(&rung.label, mesh, STAGE + TIME)
    };
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (simulation, observer) = (run.simulation, run.observer);
    let slope = slope(run.rung);
    let arm = run.reference.of(&WRONG_ARM) * arm(slope);
    run_until(simulation, STAGE, &mut *observer, |_| ())?;
    let (sin, cos) = libm::sincos(slope);
    simulation.set_local_damping(None)?;
    simulation.set_gravity([GRAVITY * sin, -GRAVITY * cos, 0.0])?;
    let start = angular_momentum(simulation, 0);
    let (mut impulse, mut points) = (0.0, vec![]);
    for k in 1..=LOOKS {
        let time = f64::from(k) / f64::from(LOOKS) * TIME;
        let mut before = simulation.velocity_time();
        run_until(simulation, STAGE + time, &mut *observer, |simulation| {
            // A force kicks over the time between the velocities before and after it.
            let after = simulation.velocity_time();
            let force = simulation.mortar_force(1).map_or(f64::NAN, |f| f[0]);
            impulse -= force * (after - before);
            before = after;
        })?;
        let gained = start - angular_momentum(simulation, 0);
        points.push(CurvePoint::new(time, gained, arm * impulse));
    }
    let gained = points.last().map_or(f64::NAN, |p| p.computed);
    let spin = Quantity::compared(SPIN, gained / impulse, arm, "m");
    let title = format!("{}: angular momentum", run.rung.label);
    let curve = Curve::new(title, ["t in s", "L in kg m²/s per m"], points);
    Ok(Measurements::of([spin]).drawn(curve))
}
