//! Do two elastic disks that collide bounce off each other as finite elements say?
//!
//! Source: the two disks of figure 1 of the introduction, which has no numbers. Here R = 0.2 m, E = 1 kPa, nu = 0.3, 1000
//! kg/m³, neo-Hookean, each with 0.1 m/s towards the other, a tenth of the wave speed; contact on the grid without friction.
//!
//! Reference: finite elements of our own, one disk against its mirror image (`exact::disk_impact`). They give the speed after
//! the impact, of which vibrations keep a part, and the strain energy over time. Momentum and energy need no reference.
//!
//! Expected: order 1. Bodies meet on the grid before they touch, by a share of a cell, and part so. `proctor verify
//! colliding-disks`.

use super::prelude::*;
use crate::exact::disk_impact::DiskImpact;

const RADIUS: f64 = 0.2;
const APART: f64 = 0.08; // Initial gap [m]
const SPEED: f64 = 0.1; // Speed of each disk [m/s]
const ELASTICITY: [f64; 2] = [1e3, 0.3]; // Young's modulus [Pa] and Poisson's ratio
const DENSITY: f64 = 1000.0;
const INTERVAL: f64 = 0.02; // Interval of the energies [s]
const LOOKS: usize = 10; // Samples of the reference in an interval: its impulse is their sum
const END: f64 = 2.4; // They have parted [s]
const ELEMENTS: usize = 12; // Elements of the reference along the radius

const RESTITUTION: &str = "coefficient of restitution";
const PEAK: &str = "largest strain energy, over the initial energy";
const HISTORY: &str = "L2(strain energy) over time";
const MOMENTUM: &str = "sum of momenta over that of one disk";
const GAIN: &str = "largest energy gained over that at the start";

const EARLY: &str = "bodies meet on the grid a share of a cell before they touch: a tenth at eight cells, and half of it at sixteen";

const WRONG_SPEED: Wrong = Wrong::factor("speed", 1.2)
    .breaks(|gate| gate.starts_with("error of") && gate.contains("strain energy"));

/// The colliding disks.
pub static COLLIDING_DISKS: Case = Case::new(
    "colliding-disks",
    "Do two elastic disks that collide bounce off each other as finite elements say?",
)
.ladder(Ladder::cells("disks", "R/h", RADIUS, &[4, 8], &[4, 8, 16]))
.method(|_| Settings::new(Method::DEFAULT.with_scheme(StressScheme::Musl)).courant(0.3))
.scene(scene)
.run(compare)
.gates(&[
    value(MOMENTUM).at_most(
        1e-12,
        "action is reaction, to round-off of some hundred steps",
    ),
    value(GAIN).at_most(
        0.01,
        "contact adds no energy; a percent for the samples of a leapfrog",
    ),
    error(HISTORY).at_most_of([0.1, 0.05], [EARLY; 2]),
    error(PEAK).at_most_of([0.08, 0.05], [EARLY; 2]),
    error(RESTITUTION).at_most_of([0.15, 0.1], [EARLY; 2]),
    order(HISTORY).at_least(0.8, "1 of a gap that is a share of a cell, less 0.2"),
])
.tables(&[TableRule::new("disks", &[RESTITUTION, PEAK, HISTORY])])
.wrong_references(&[WRONG_SPEED])
.studies(&[Plan::new(
    Ladder::cells("disks", "R/h", RADIUS, &[4, 8], &[4, 8, 16]),
    &[Measure::new("strain energy", HISTORY)],
    2,
)])
.no_guest("it is judged by the strain energy over time, and frames hold none");

/// The reference: restitution, and the strain energy over the initial energy of the scene at each interval.
fn known(reference: Reference) -> Result<&'static (f64, Vec<f64>), String> {
    static GIVEN: OnceLock<Result<(f64, Vec<f64>), String>> = OnceLock::new();
    let compute = || {
        let factor = reference.of(&WRONG_SPEED);
        let disk = DiskImpact {
            radius: RADIUS,
            distance: 0.5 * APART,
            speed: factor * SPEED,
            elasticity: ELASTICITY,
            density: DENSITY,
        };
        let count = LOOKS * (END / INTERVAL).round() as usize;
        let samples = disk.history(ELEMENTS, INTERVAL / LOOKS as f64, count);
        let samples = samples.map_err(|e| format!("the reference: {e}"))?;
        let shares = disk.strain_shares(&samples).into_iter().step_by(LOOKS);
        let shares = shares.map(|share| factor * factor * share).collect();
        Ok((disk.restitution(&samples), shares))
    };
    known_reference(&GIVEN, reference.is_correct(), compute)
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let mesh = open_plane(rung.cell, [-0.6, -0.4], [0.6, 0.4]);
    let [young, poisson] = ELASTICITY;
    let law = NeoHookean::new(young, poisson);
    let around = |side: f64| ball([side * (0.5 * APART + RADIUS), 0.0, 0.0], RADIUS);
    let disk = |id: i64, side: f64| Body {
        velocity: [-side * SPEED, 0.0, 0.0],
        ..body(format!("disk {id}"), id, around(side))
    };
    settings.applied(Scene {
        time_step: settings.multiplier(),
        materials: material("rubber", DENSITY, law),
        bodies: vec![disk(1, -1.0), disk(2, 1.0)],
        contacts: contact("disk on disk", [1, 2], 0.0, ContactNormal::Collinear),
        ..plane_scene("colliding_disks", mesh, END)
    })
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let (restitution, exact) = known(run.reference)?;
    let energies = |s: &Simulation| [s.kinetic_energy(), s.strain_energy()];
    let initial: f64 = energies(simulation).iter().sum();
    let (mut strains, mut largest) = (vec![energies(simulation)[1] / initial], 1.0_f64);
    at_intervals(
        simulation,
        INTERVAL,
        observer,
        |_| (),
        |simulation, _| {
            let [kinetic, strain] = energies(simulation).map(|energy| energy / initial);
            strains.push(strain);
            largest = largest.max(kinetic + strain);
            Ok(())
        },
    )?;
    let masses = [0, 1].map(|body| simulation.center(body).mass);
    let after = [0, 1].map(|body| simulation.center(body).velocity[0]);
    let [x, y, _] = simulation.momentum();
    let peak = |shares: &[f64]| shares.iter().copied().fold(0.0, f64::max);
    let pairs = strains.iter().zip(exact);
    let history = relative_l2(pairs.clone().map(|(s, e)| (1.0, [*s], [*e])));
    let quantities = vec![
        Quantity::compared(
            RESTITUTION,
            (after[1] - after[0]) / (2.0 * SPEED),
            *restitution,
            "1",
        ),
        Quantity::compared(PEAK, peak(&strains), peak(exact), "1"),
        ratio(HISTORY, history),
        Quantity::balance(MOMENTUM, libm::hypot(x, y) / (masses[0] * SPEED), "1"),
        Quantity::balance(GAIN, largest - 1.0, "1"),
    ];
    let points = pairs.enumerate();
    let points = points.map(|(k, (s, e))| CurvePoint::new(k as f64 * INTERVAL, *s, *e));
    let curve = Curve::new(
        format!("{}: strain energy over the initial energy", rung.label),
        ["t in s", "1"],
        points,
    );
    Ok(Measurements::of(quantities).drawn(curve))
}
