//! Runs that do go wrong: the watch of the kernel fires on them, and not on the same scenes at a step or with a method that is
//! sound.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState, Invariant, StepErrorKind, Violation};
use proctor_scene::{OnImbalance, PlaneCondition, Scene, Shape, StressScheme, TimeStep, Weighting};

use super::trial::{elastic, method, noise, open, start};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "watch-steps",
        what: "a disc with noise at twice a stable step, and blocks that squeeze a cell by more than half in a step",
        required: "the watch stops the run and says which balance is off; at half the step, and a tenth, it does not",
        cause: None,
        judge: steps,
    },
    Extreme {
        name: "watch-crossing",
        what: "a bar that swings by half a cell with linear functions and USF, whose cell crossing makes energy",
        required: "the watch stops the run for its energy; with GIMP it does not",
        cause: None,
        judge: crossing,
    },
];

/// Most steps of a run.
const MOST: u64 = 2000;

/// Runs until the watch stops it; `None` where it does not within so many steps.
fn watched(
    scene: &Scene,
    initial: Option<InitialField>,
    most: u64,
) -> Result<Option<Violation>, Unexpected> {
    let mut scene = scene.clone();
    scene.on_imbalance = OnImbalance::Stop;
    let mut simulation = start(&scene, initial)?;
    for _ in 0..most {
        match simulation.step(f64::INFINITY) {
            Ok(_) => {}
            Err(error) => match error.kind {
                StepErrorKind::NotTrusted(violation) => return Ok(Some(violation)),
                _ => return Err(Unexpected(format!("{}: {error}", method(&scene)))),
            },
        }
    }
    Ok(None)
}

/// What the watch must say of a scene that goes wrong.
fn must_stop(
    finding: &mut Finding,
    scene: &Scene,
    initial: Option<InitialField>,
    reasons: &[Invariant],
    most: u64,
) -> Result<(), Unexpected> {
    let name = method(scene);
    match watched(scene, initial, most)? {
        Some(violation) if reasons.contains(&violation.reason) => {
            finding.refusals.push(format!("{name}: {violation}"));
            Ok(())
        }
        Some(violation) => Err(Unexpected(format!(
            "{name}: for another reason: {violation}"
        ))),
        None => Err(Unexpected(format!(
            "{name}: nobody noticed in {most} steps"
        ))),
    }
}

/// Number of sound runs that the watch stopped.
fn alarms(runs: &[(Scene, Option<InitialField>)], most: u64) -> Result<f64, Unexpected> {
    let mut count = 0;
    for (scene, initial) in runs {
        count += u32::from(watched(scene, initial.clone(), most)?.is_some());
    }
    Ok(f64::from(count))
}

/// Sound runs are let go.
fn no_alarm(name: &str, count: f64) -> Gate {
    Gate::at_most(
        format!("{name}: sound runs that the watch stopped"),
        count,
        0.0,
        "a watch that stops sound runs is switched off",
    )
}

/// A disc in the air with noise, and steps of a multiple of h/(c + |v|).
fn noisy_disc(scheme: StressScheme, multiplier: f64) -> (Scene, Option<InitialField>) {
    let mut scene = open([12, 12]);
    scene.scheme = scheme;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    scene.add_body(Shape::disc([5.6, 6.3], 3.4), material);
    scene.time_step = TimeStep::Multiplier {
        multiplier,
        allow_unstable: true,
    };
    let rough: InitialField = Arc::new(|x| InitialState {
        velocity: [1e-6 * noise(x, 1), 1e-6 * noise(x, 2), 0.0],
        ..AT_REST
    });
    (scene, Some(rough))
}

/// Two blocks that run into each other as one field, each a little slower than its waves.
fn squeezed(scheme: StressScheme, dt: f64) -> (Scene, Option<InitialField>) {
    let mut scene = open([16, 8]);
    scene.scheme = scheme;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    for (left, velocity) in [(4.0, 1.0), (8.0, -1.0)] {
        let shape = Shape::rectangle([left, 2.0], [left + 4.0, 5.0]);
        scene.add_body(shape, material).velocity = [velocity, 0.0, 0.0];
    }
    scene.time_step = TimeStep::Fixed {
        dt,
        allow_unstable: true,
    };
    (scene, None)
}

fn steps() -> Result<Finding, Unexpected> {
    let mut finding = Finding::default();
    let (mut stable, mut gentle) = (vec![], vec![]);
    for scheme in SCHEMES {
        // Twice of what is below the bound of 0.44 of USL, and of 1.3 of the others.
        let unstable = if scheme == StressScheme::Usl {
            0.8
        } else {
            2.4
        };
        let (scene, rough) = noisy_disc(scheme, unstable);
        let reasons = [Invariant::Energy, Invariant::Increment];
        must_stop(&mut finding, &scene, rough, &reasons, MOST)?;
        stable.push(noisy_disc(scheme, 0.5 * unstable));
        let (scene, initial) = squeezed(scheme, 0.6);
        must_stop(&mut finding, &scene, initial, &[Invariant::Increment], 1)?;
        gentle.push(squeezed(scheme, 0.06));
    }
    finding.gates = vec![
        no_alarm("half the step", alarms(&stable, MOST)?),
        no_alarm("a tenth of the step", alarms(&gentle, 10)?),
    ];
    Ok(finding)
}

/// A bar between fixed ends that swings by half a cell.
fn swinging(weighting: Weighting, scheme: StressScheme) -> (Scene, Option<InitialField>) {
    const CELLS: usize = 12;
    let mut scene = open([CELLS, 1]);
    (scene.weighting, scene.scheme) = (weighting, scheme);
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    let material = scene.add_material(elastic(1.0, 0.0), 1.0);
    scene.add_body(Shape::rectangle([0.0, 0.0], [CELLS as f64, 1.0]), material);
    let wave = std::f64::consts::PI / CELLS as f64;
    // The amplitude is the speed over the frequency.
    let swings: InitialField = Arc::new(move |x| InitialState {
        velocity: [0.8 * wave * libm::sin(wave * x[0]), 0.0, 0.0],
        ..AT_REST
    });
    (scene, Some(swings))
}

fn crossing() -> Result<Finding, Unexpected> {
    let mut finding = Finding::default();
    let (mut scene, swings) = swinging(Weighting::Linear, StressScheme::Usf);
    // 2.6 times the step that the kernel would take.
    scene.time_step = TimeStep::Multiplier {
        multiplier: 0.56,
        allow_unstable: true,
    };
    must_stop(
        &mut finding,
        &scene,
        swings,
        &[Invariant::Energy],
        20 * MOST,
    )?;
    let sound = SCHEMES.map(|scheme| swinging(Weighting::UniformGimp, scheme));
    finding.gates = vec![no_alarm("GIMP", alarms(&sound, MOST)?)];
    Ok(finding)
}
