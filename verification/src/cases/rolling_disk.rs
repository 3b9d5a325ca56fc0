//! Does a soft disk on an inclined plane slide and roll as a rigid one does?
//!
//! Source: Liang et al. 2024, section 4.3: R = 0.5 m on a plane of 30 degrees, E = 250 kPa, nu = 0.3, 300 kg/m³,
//! h = 0.1 m with 5 x 5 particles per cell, 64 vertices, g_c = 0.04 m, kappa = 1e4 Pa/m, kappa_t = 1e6 Pa/m; friction 0.1
//! (it slides) and 0.3 (it rolls). The plane is a rigid line. The disk first settles for 2 s under the gravity normal to
//! the plane, with local damping of 0.1 (without any, as printed, it would bounce), and is then let go without.
//!
//! Expected: the way after 2 s within 1 % (slip) and 2 % (stick) at h = 0.1, stick within 0.5 % at h = 0.05. What is left
//! of the slip's error is a velocity picked up while the tangential spring loads. The area must not grow with the
//! number of steps; 1.3 % of growth is the centrifugal force on so soft a disk, and the pressure of the plane takes some of
//! it. `stiff` has a hundred times the modulus and so hardly any contact width: it shows what of the error the softness
//! is. `proctor verify rolling-disk`.
//!
//! The turn of the disk that slips is that of a rigid one but for the shorter arm of the friction, by the flattening of the
//! disk, for a pressure that lies beside the middle of the contact, and for the inertia of mass on nodes ([`turn`]). The disk that sticks creeps: it
//! rolls on the tangential spring and on a layer as wide as the barrier reaches, with
//! [`crate::exact::rolling_creep`], and that is its reference.

mod turn;

use super::prelude::*;
use crate::exact::rolling_disk::RollingDisk as Exact;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.5;
const YOUNG: f64 = 2.5e5;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 300.0;
const GAP: f64 = 0.04;
const KAPPA: f64 = 1e4;
const KAPPA_T: f64 = 1e6;
const INCLINATION_DEGREES: f64 = 30.0;
const STAGE: f64 = 2.0; // Each of the two stages [s]
const PIC: f64 = 0.001; // Share of PIC, with any transfer
const SETTLING: f64 = 0.1; // Local damping while the disk settles

pub(super) const WAY: &str = "distance along the plane after 2 s";
pub(super) const RATIO: &str = "rotation times R over distance after 2 s";
pub(super) const AREA: &str = "growth of the area";
/// Area that neither spin nor load changes.
const AREA_OFF: &str = "growth of the area minus that of spin and load";

const WRONG_GRAVITY: Wrong =
    Wrong::factor("gravity", 1.04).breaks_only(|gate| gate.contains("error of the distance"));

/// Errors that are studied, of a slab too.
pub(super) const MEASURES: &[Measure] = &[
    Measure::new("displacement", WAY),
    Measure::new("turn", RATIO),
];

/// The disk on the inclined plane.
pub static ROLLING_DISK: Case = Case::new(
    "rolling-disk",
    "Does a soft disk on an inclined plane slide and roll as a rigid one does?",
)
.ladder(Ladder::sizes(
    &[("slip", &[0.2, 0.1]), ("stick", &[0.1])],
    &[
        ("slip", &[0.2, 0.1, 0.05]),
        ("stick", &[0.2, 0.1, 0.05]),
        ("stiff", &[0.1]),
    ],
))
.method(method)
.scene(scene)
.prepare(|rung, reference| {
    let _ = turn::expected(&exact(reference, rung), rung.variant);
})
.run(compare)
.tables(&[TableRule::new("{variant}", &[WAY, RATIO])])
.judge_by(judge)
.line_of_each(line)
.wrong_references(&[WRONG_GRAVITY])
.studies(&[
    Plan::new(
        Ladder::sizes(&[("slip", &[0.2, 0.1])], &[("slip", &[0.2, 0.1, 0.05, 0.025])]),
        MEASURES,
        2,
    )
    .named("rolling-disk-slip"),
    // What sticks comes below 1 % on the third mesh, what slips on the second.
    Plan::new(
        Ladder::sizes(&[("stick", &[0.2, 0.1, 0.05])], &[("stick", &[0.2, 0.1, 0.05, 0.025])]),
        MEASURES,
        2,
    )
    .trying(few),
])
.no_guest(
    "its disk is followed by the vertices of its boundary in mortar contact, which the manuals do not know",
);

fn friction(variant: &str) -> f64 {
    if variant == "slip" { 0.1 } else { 0.3 }
}

fn exact(reference: Reference, rung: &Rung) -> Exact {
    Exact {
        gravity: GRAVITY * reference.of(&WRONG_GRAVITY),
        inclination: INCLINATION_DEGREES.to_radians(),
        friction: friction(rung.variant),
        radius: RADIUS,
    }
}

/// Young's modulus of a variant \[Pa\].
fn young(variant: &str) -> f64 {
    YOUNG * if variant == "stiff" { 100.0 } else { 1.0 }
}

/// The rigid plane, with vertices every h/2, outward up.
fn plane(h: f64, from: f64, to: f64) -> RigidLine {
    let count = ((to - from) / (0.5 * h)).round() as usize;
    let at = |k: usize| Point::new(to - (to - from) * k as f64 / count as f64, 0.0);
    open_line("plane", 2, (0..=count).map(at), None)
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let error_at_most = |label: &str, name, bound, reason| {
        let title = format!("{label}: error of the {name}");
        Gate::at_most(title, runs.error(label, name), bound, reason)
    };
    let squares = "strains are known to first order: the square of rho omega² R²/E";
    let area = |label| runs.value_at_most(label, AREA_OFF, turn::SECOND_ORDER, squares);
    let [slip, stick] = ["slip h=0.1", "stick h=0.1"];
    let mut gates = vec![
        error_at_most(slip, WAY, 0.01, "the method's reference figures: 0.46 %"),
        error_at_most(stick, WAY, 0.02, "the method's reference figures: 1.3 %"),
        area(slip),
        area(stick),
    ];
    gates.extend(runs.rungs.iter().map(|rung| {
        let (bound, reason) = turn::bound(rung);
        error_at_most(&rung.label, RATIO, bound, reason)
    }));
    if runs.size == Size::Full {
        let figure = "the method's reference figures: 0.18 %";
        let nearer = "a stiffer disk is nearer to a rigid one";
        gates.push(error_at_most("stick h=0.05", WAY, 0.005, figure));
        gates.push(error_at_most(
            "stiff h=0.1",
            WAY,
            runs.error(stick, WAY),
            nearer,
        ));
    }
    gates.push(turn::order(runs));
    Verdict {
        gates,
        ..Verdict::default()
    }
}

/// Turn and area of a run, for the record.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    let expected = run.quantity(RATIO).and_then(|q| q.exact);
    Some(format!(
        "{}: {RATIO} is {:.4}, expected {:.4}; area growth {:.2} %, less that of spin and load {:.2} %",
        rung.label,
        run.value(RATIO),
        expected.unwrap_or(f64::NAN),
        100.0 * run.value(AREA),
        100.0 * run.value(AREA_OFF),
    ))
}

pub(super) fn method(_: &Rung) -> Settings {
    settings(APIC, 5)
}

pub(super) fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let (from, to) = (-1.2, 9.6);
    let mesh = open_plane(h, [from, -0.4], [to, 1.4]);
    let normal = GRAVITY * libm::cos(INCLINATION_DEGREES.to_radians());
    let disk = ball([0.0, RADIUS + 0.5 * GAP, 0.0], RADIUS);
    let mut scene = Scene {
        name: rung.label.clone(),
        time_step: settings.multiplier(),
        gravity: [0.0, -normal, 0.0],
        materials: elastic(DENSITY, young(rung.variant), POISSON),
        bodies: vec![body("disk", 1, disk)],
        damping: Damping::Local { alpha: SETTLING },
        mortar: Mortar {
            boundaries: vec![boundary(1, Vertices::Spacing(TAU * RADIUS / 64.0))],
            lines: vec![plane(0.1, from + 0.2, to - 0.2)],
            contacts: vec![rubbing(
                [friction(rung.variant), KAPPA_T],
                barrier("disk on plane", [2, 1], GAP, KAPPA),
            )],
            ..Mortar::default()
        },
        results: Results {
            print: 0,
            ..Results::default()
        },
        ..Scene::new(Dimension::Two, mesh, 2.0 * STAGE)
    };
    settings.apply(&mut scene);
    scene.transfer.pic_fraction = PIC;
    scene
}

pub(super) fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    // A slab is as thick as its one layer of cells, the plane 1 m.
    let thickness = simulation.scene().mesh.cell[2];
    let mut follow = |simulation: &mut Simulation, stop: f64, turn: &mut f64| {
        run_until(simulation, stop, &mut *observer, |simulation| {
            let dt = 2.0 * (simulation.time() - simulation.velocity_time());
            *turn += angular_velocity(simulation) * dt;
        })
    };
    follow(simulation, STAGE, &mut 0.0)?;
    let (sin, cos) = libm::sincos(INCLINATION_DEGREES.to_radians());
    simulation.set_local_damping(None)?;
    simulation.set_gravity([GRAVITY * sin, -GRAVITY * cos, 0.0])?;
    let start = simulation.center(0).position[0];
    let exact = exact(run.reference, rung);
    let (mut points, mut turn) = (vec![], 0.0);
    for k in 1..=20 {
        let time = f64::from(k) / 20.0 * STAGE;
        // The disk swings on its tangential spring, so the turn is integrated rather than read off once.
        follow(simulation, STAGE + time, &mut turn)?;
        let way = simulation.center(0).position[0] - start;
        points.push(CurvePoint::new(time, way, exact.way_and_turn(time).0));
    }
    let way = points.last().map_or(f64::NAN, |p| p.computed);
    let growth = area(simulation) / thickness / (0.5 * TAU * RADIUS * RADIUS) - 1.0;
    let expected = turn::expected(&exact, rung.variant)?;
    let of_spin = turn::growth(angular_velocity(simulation), young(rung.variant));
    let quantities = vec![
        Quantity::compared(WAY, way, exact.way_and_turn(STAGE).0, "m"),
        Quantity::compared(RATIO, turn * RADIUS / way, expected, "1"),
        Quantity::figure(AREA, growth, "1"),
        Quantity::balance(AREA_OFF, (growth - of_spin).abs(), "1"),
    ];
    let title = format!("{}: way along the plane", rung.label);
    let curve = Curve::new(title, ["t in s", "u_x in m"], points);
    Ok(Measurements::of(quantities).drawn(curve))
}

/// Sum of the particles' volumes \[m²\].
fn area(simulation: &Simulation) -> f64 {
    let volume = |p| simulation.particle_volume(0, p);
    (0..simulation.particles()).map(volume).sum()
}

/// Angular velocity down the plane (clockwise), as angular momentum over moment of inertia \[1/s\].
fn angular_velocity(simulation: &Simulation) -> f64 {
    let x_c = simulation.center(0).position;
    let mut inertia = 0.0;
    for p in 0..simulation.particles() {
        let (m, x) = (simulation.particle_mass(0, p), simulation.position(0, p));
        let (rx, ry) = (x[0] - x_c[0], x[1] - x_c[1]);
        inertia += m * (rx * rx + ry * ry);
    }
    -angular_momentum(simulation, 0) / inertia
}
