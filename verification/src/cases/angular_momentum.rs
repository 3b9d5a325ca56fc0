//! How much of its angular momentum does a free body lose that spins?
//!
//! Source: Jiang et al. 2015. An elastic square spins about its centre for a turn, free of everything,
//! with corners at 2 % of the wave speed. With quadratic B-splines the moment of inertia of an affine velocity is that
//! of a square of side h·sqrt(3), `m h²/4`, so that its angular momentum can be counted with that of the particles.
//!
//! Stress is symmetric and weights reproduce linear fields: nodes exert no torque on each other. APIC takes from the nodes
//! what they have, affine part and all, and moves particles with the velocity that they carry, so that the sum stays to
//! round-off. FLIP brings all that particles have to the nodes, but moves them with another velocity than they carry,
//! and gets of increments only their mean over the particle: it loses like h². TPIC takes velocity gradients for the
//! affine velocity, which are not the moments that nodes have. What FLIP and TPIC lose is stated, and judged is what theory
//! says, APIC. The energy that each gains at most is stated, too.
//! `proctor verify angular-momentum`.

use std::f64::consts::SQRT_2;

use super::prelude::*;

const SIDE: f64 = 0.5; // Side of the block [m]
const HALF_MESH: f64 = 0.5; // Half the side of the mesh, about the centre of the block [m]
/// Young's modulus \[Pa\], Poisson's ratio and density \[kg/m³\].
const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0;
const SPEED: f64 = 2e-2; // Speed of the corners over the wave speed
/// Name of what the angular momentum changes by.
const DRIFT: &str = "angular momentum lost in a turn over the initial";
/// The same, as a figure that nothing exact says.
const DRIFT_STATED: &str = "angular momentum lost in a turn";
/// Largest kinetic and strain energy over that of the start, less 1.
const GAIN: &str = "largest energy gained in a turn";
/// Largest change at any time, over it.
const LARGEST: &str = "largest change of the angular momentum";
const KEPT: &str = "the transfer to the particles and back keeps the angular momentum of the nodes, but for round-off";
const WRONG_MOMENTUM: Wrong = Wrong::factor("angular momentum", 1.0 + 1e-9);

/// A block that spins.
pub static ANGULAR_MOMENTUM: Case = Case::new(
    "angular-momentum",
    "How much of its angular momentum does a free body lose that spins?",
)
.ladder(Ladder::variants(
    &[
        "FLIP USL",
        "FLIP USF",
        "FLIP MUSL",
        "APIC USL",
        "APIC USF",
        "APIC MUSL",
        "TPIC USL",
        "TPIC USF",
        "TPIC MUSL",
    ],
    " ",
    "side/h",
    SIDE,
    [&[4], &[4, 8, 16]],
))
.method(|rung| Settings::new(method(rung)))
.scene(scene)
.options(start)
.run(compare)
.gates_of_rungs(&[
    error(DRIFT).at_most(1e-11, KEPT).on(is_apic),
    error(LARGEST).at_most(1e-11, KEPT).on(is_apic),
])
.judge_by(lines)
.wrong_references(&[WRONG_MOMENTUM])
.no_study(
    "the moment of inertia of an affine velocity is the same everywhere with B-splines alone",
)
.no_guest(
    "an affine transfer keeps a share of its angular momentum beside the velocities, a fifth with four cells, and frames do not \
     hold it; *rotation* is the same block",
);

/// The transfer and the scheme that the variant names.
fn method(rung: &Rung) -> Method {
    let word = |words: &str| rung.variant.contains(words);
    Method {
        weighting: Weighting::QuadraticBSpline,
        scheme: match rung.variant {
            variant if variant.ends_with("USF") => StressScheme::Usf,
            variant if variant.ends_with("MUSL") => StressScheme::Musl,
            _ => StressScheme::Usl,
        },
        transfer: match () {
            () if word("APIC") => TransferKind::Apic,
            () if word("TPIC") => TransferKind::Tpic,
            () => TransferKind::Flip,
        },
    }
}

fn is_apic(rung: &Rung) -> bool {
    method(rung).transfer == TransferKind::Apic
}

/// Angular velocity \[rad/s\].
fn spin() -> f64 {
    SPEED * p_wave_speed(YOUNG, POISSON, DENSITY) / (0.5 * SIDE * SQRT_2)
}

/// Angular momentum about the origin, affine velocities with it \[kg m²/s\].
fn momentum(simulation: &Simulation) -> f64 {
    let set = &simulation.sets()[0];
    let h = simulation.scene().mesh.cell[0];
    let terms = (0..set.len()).map(|p| {
        let m = simulation.particle_mass(0, p);
        let (x, v) = (simulation.position(0, p), set.velocity(p));
        let affine = set.layout.affine.map_or(0.0, |first| {
            // Row by row: dv_x/dy and dv_y/dx.
            set.columns[first + 2][p] - set.columns[first + 1][p]
        });
        m * (x[0] * v[1] - x[1] * v[0] + 0.25 * h * h * affine)
    });
    terms.sum()
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let mesh = open_plane(rung.cell, [-HALF_MESH; 2], [HALF_MESH; 2]);
    let end = TAU / spin();
    let fastest = (1.0 + SPEED) * p_wave_speed(YOUNG, POISSON, DENSITY);
    settings.applied(Scene {
        time_step: settings.equal_steps(end, rung.cell, fastest).0,
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body(
            "block",
            1,
            rectangle([-0.5 * SIDE; 2], [0.5 * SIDE; 2]),
        )],
        ..plane_scene("angular_momentum", mesh, end)
    })
}

fn start(_: &Rung, _: Reference, options: Options) -> Options {
    let spin = spin();
    starting(options, move |x| {
        let gradient = [[0.0, -spin, 0.0], [spin, 0.0, 0.0], [0.0; 3]];
        moving([-spin * x[1], spin * x[0], 0.0], gradient)
    })
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (steps, reference) = (run.equal_steps(), run.reference.of(&WRONG_MOMENTUM));
    let rung = run.rung;
    let (simulation, observer) = (run.simulation, run.observer);
    let energy = |simulation: &Simulation| simulation.kinetic_energy() + simulation.strain_energy();
    let (start, first, mut gain) = (momentum(simulation), energy(simulation), 0.0_f64);
    let (mut points, mut largest) = (vec![], 0.0_f64);
    while simulation.steps() < steps {
        let next = (simulation.steps() + (steps / 100).max(1)).min(steps);
        advance(simulation, next, &mut |_| ())?;
        let change = momentum(simulation) / start - reference;
        largest = largest.max(change.abs());
        gain = gain.max(energy(simulation) / first - 1.0);
        points.push(CurvePoint::new(
            spin() * simulation.time() / TAU,
            change,
            0.0,
        ));
        observer.progress(simulation.steps() as f64 / steps as f64);
    }
    let drift = reference - momentum(simulation) / start;
    let mut quantities = if is_apic(rung) {
        vec![
            Quantity::of_zero(DRIFT, drift),
            Quantity::of_zero(LARGEST, largest),
        ]
    } else {
        vec![Quantity::figure(DRIFT_STATED, drift, "1")]
    };
    quantities.push(Quantity::figure(GAIN, gain, "1"));
    let title = format!("change of the angular momentum, {}", rung.label);
    let curve = Curve::new(title, ["turns", "change / initial"], points);
    Ok(Measurements::of(quantities).drawn(curve))
}

/// Losses and gains, for the record.
fn lines(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for rung in runs.rungs {
        let percent = |name| 100.0 * runs.value(&rung.label, name);
        let mut line = |text| {
            verdict
                .for_the_record
                .push(format!("{}: {text}", rung.label));
        };
        if !is_apic(rung) {
            line(format!(
                "{:.2} % of the angular momentum is lost in a turn",
                percent(DRIFT_STATED)
            ));
        }
        line(format!("{:.2} % of energy gained at most", percent(GAIN)));
    }
    verdict
}
