//! Do two disks that graze each other spin as much as the impulse of their friction says?
//!
//! Two disks (R = 0.5 m, 20 MPa, nu = 0.3, 300 kg/m³), each with 0.1 m/s towards the other and 0.6 m/s past it, mu = 0.8: they
//! slide on each other for as long as they touch. Mortar contact through a barrier, one of them as slave.
//!
//! Exact: each disk has the angular momentum J_t x arm about its centre, with J_t the impulse of the force along the
//! tangent at that moment, and the arm R less half of the approach of the disks. J_t itself is mu J_n but for the loading of
//! the tangential spring and is not judged. By symmetry the pressure has no moment, but surfaces are not seen alike: forces
//! follow the normals of the slave, and their resultant lies 0.1 % of R beside the line of the centres, which gives to one
//! disk what it takes from the other. The order is therefore that of both together. `proctor verify spinning-collision`.

use super::prelude::*;
use crate::exact::hertz::{Hertz, contact_modulus};

const RADIUS: f64 = 0.5;
const YOUNG: f64 = 2e7;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 300.0;
const FRICTION: f64 = 0.8;
/// Distance below which the barrier pushes \[m\], and its stiffness \[Pa/m\].
const GAP: f64 = 0.01;
const KAPPA: f64 = 1.6e5;
const KAPPA_T: f64 = 1e6; // Stiffness of the tangential spring [Pa/m]
/// Velocity of the first disk \[m/s\]; that of the other is its opposite.
const VELOCITY: Vector = [0.1, 0.6, 0.0];
/// They part before \[s\].
const TIME: f64 = 0.4;
const LOOKS: u32 = 30;
const SPACING: f64 = TAU * RADIUS / 128.0; // Spacing of the vertices [m]

const SPIN: [&str; 2] = [
    "spin per impulse of friction, master",
    "spin per impulse of friction, slave",
];
const BOTH: &str = "spin per impulse of friction, both";

const PERCENT: &str = "one percent at a tenth of the radius, four times as much at a fifth";
const WRONG_ARM: Wrong = Wrong::factor("arm", 1.04);

/// The two disks.
pub static SPINNING_COLLISION: Case = Case::new(
    "spinning-collision",
    "Do two disks that graze each other spin as much as the impulse of their friction says?",
)
.ladder(Ladder::sizes(
    &[("disks", &[0.2, 0.1])],
    &[("disks", &[0.2, 0.1, 0.05])],
))
.method(|_| settings(APIC, 5))
.scene(scene)
.run(compare)
.gates(&[
    error(SPIN[0])
        .at_most_of([0.04, 0.01], [PERCENT; 2])
        .by_rung(),
    error(SPIN[1])
        .at_most_of([0.04, 0.01], [PERCENT; 2])
        .by_rung(),
    order(BOTH).at_least_of([1.7, 1.8], "inertia of mass on nodes is h² off"),
])
.tables(&[TableRule::new("disks", &[SPIN[0], SPIN[1], BOTH])])
.wrong_references(&[WRONG_ARM])
.studies(&[Plan::new(
    Ladder::sizes(&[("disks", &[0.2, 0.1])], &[("disks", &[0.2, 0.1, 0.05])]),
    &[
        Measure::new("spin of the master", SPIN[0]),
        Measure::new("spin of the slave", SPIN[1]),
    ],
    2,
)])
.no_guest(NO_GUEST);

/// Arm of the friction \[m\] under a normal force \[N/m\].
fn arm(load: f64) -> f64 {
    if load <= 0.0 {
        return RADIUS;
    }
    let hertz = Hertz {
        radius: RADIUS,
        load,
        modulus: contact_modulus([YOUNG, f64::INFINITY], [POISSON, 0.0]),
    };
    RADIUS - hertz.approach()
}

/// Force on a disk \[N/m\]: away from the other one, and along the tangent that turns it anticlockwise.
fn force_on(simulation: &Simulation, id: i64) -> [f64; 2] {
    let other = 3 - id;
    let [own, far] = [id, other].map(|id| simulation.center(id as usize - 1).position);
    let apart = [own[0] - far[0], own[1] - far[1]];
    let length = libm::hypot(apart[0], apart[1]);
    let n = apart.map(|a| a / length);
    let f = simulation.mortar_force(id).unwrap_or([f64::NAN; 3]);
    // From its centre the contact lies along -n, so that a force along (n_y, -n_x) turns it anticlockwise.
    [f[0] * n[0] + f[1] * n[1], f[0] * n[1] - f[1] * n[0]]
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let mesh = open_plane(rung.cell, [-1.2, -1.2], [1.2, 1.2]);
    let half = RADIUS + 0.6 * GAP;
    // Half of the way past each other lies before the contact, half behind it.
    let before = 0.5 * VELOCITY[1] * TIME;
    let disk = |name: &str, id, side: f64| {
        let shape = ball([side * half, side * before, 0.0], RADIUS);
        Body {
            velocity: VELOCITY.map(|v| -side * v),
            ..body(name, id, shape)
        }
    };
    let around = |id| boundary(id, Vertices::Spacing(SPACING));
    let mut scene = Scene {
        time_step: settings.multiplier(),
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![disk("master", 1, -1.0), disk("slave", 2, 1.0)],
        mortar: Mortar {
            boundaries: [1, 2].map(around).to_vec(),
            contacts: vec![rubbing(
                [FRICTION, KAPPA_T],
                barrier("disk on disk", [1, 2], GAP, KAPPA),
            )],
            ..Mortar::default()
        },
        ..plane_scene(&rung.label, mesh, TIME)
    };
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let factor = run.reference.of(&WRONG_ARM);
    let (mut impulse, mut expected, mut pressed) = ([0.0; 2], [0.0; 2], 0.0);
    let mut points = vec![];
    for k in 1..=LOOKS {
        let time = f64::from(k) / f64::from(LOOKS) * TIME;
        let mut before = simulation.velocity_time();
        run_until(simulation, time, &mut *observer, |simulation| {
            // A force kicks over the time between the velocities before and after it.
            let after = simulation.velocity_time();
            for (body, id) in (1..=2).enumerate() {
                let [normal, tangential] = force_on(simulation, id);
                impulse[body] += tangential * (after - before);
                expected[body] += factor * arm(normal) * tangential * (after - before);
                pressed += 0.5 * normal * (after - before);
            }
            before = after;
        })?;
        let gained = angular_momentum(simulation, 1);
        points.push(CurvePoint::new(time, gained, expected[1]));
    }
    let gained = [0, 1].map(|body| angular_momentum(simulation, body));
    let mut quantities = vec![];
    for (body, spin) in SPIN.into_iter().enumerate() {
        let [gained, expected] = [gained[body], expected[body]].map(|l| l / impulse[body]);
        quantities.push(Quantity::compared(spin, gained, expected, "m"));
    }
    let [gained, expected, impulses] = [gained, expected, impulse].map(|of| of[0] + of[1]);
    let (gained, expected) = (gained / impulses, expected / impulses);
    let over = "impulse of friction over that of pressure";
    quantities.push(Quantity::compared(BOTH, gained, expected, "m"));
    quantities.push(Quantity::figure(over, impulse[1] / pressed, "1"));
    let title = format!("{}: angular momentum of the slave", rung.label);
    let curve = Curve::new(title, ["t in s", "L in kg m²/s per m"], points);
    Ok(Measurements::of(quantities).drawn(curve))
}
