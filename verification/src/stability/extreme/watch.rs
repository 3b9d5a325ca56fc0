//! Runs that do go wrong: the watch of the kernel fires on them, and not on the same scenes at a step or with a method that is
//! sound.

use super::prelude::*;
use proctor_scene::simulation::{Invariant, Violation};

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("watch-steps", too_long)
        .with("a disc with noise at twice a stable step, and blocks that squeeze a cell by more than half in a step")
        .must("the watch stops the run and says which balance is off; at half the step, and a tenth, it does not"),
    Extreme::of("watch-crossing", crossing)
        .with("a bar that swings by half a cell with linear functions and USF, whose cell crossing makes energy")
        .must("the watch stops the run for its energy; with GIMP it does not"),
];

/// Most steps of a run.
const MOST: u64 = 2000;

/// A scene and its start.
type Run = (Scene, Options);

/// Runs until the watch stops it; `None` where it does not within so many steps.
fn watched((scene, initial): &Run, most: u64) -> Result<Option<Violation>> {
    let mut scene = scene.clone();
    scene.on_imbalance = OnImbalance::Stop;
    let mut simulation = start(&scene, initial)?;
    let Some(error) = (0..most).find_map(|_| simulation.step(f64::INFINITY).err()) else {
        return Ok(None);
    };
    match error.kind {
        StepErrorKind::NotTrusted(violation) => Ok(Some(violation)),
        _ => Err(unexpected(method(&scene), error)),
    }
}

/// Messages of the watch about a run that goes wrong.
fn noticed(run: &Run, reasons: &[Invariant], most: u64) -> Result<String> {
    let name = method(&run.0);
    match watched(run, most)? {
        Some(violation) if reasons.contains(&violation.reason) => {
            Ok(format!("{name}: {violation}"))
        }
        Some(violation) => Err(unexpected(name + ": for another reason", violation)),
        None => Err(unexpected(name, format!("nobody noticed in {most} steps"))),
    }
}

/// Sound runs are let go.
fn no_alarm(name: &str, runs: impl IntoIterator<Item = Run>, most: u64) -> Result<Gate> {
    let mut alarms = gate(format!("{name}: sound runs that the watch stopped"))
        .none("a watch that stops sound runs is switched off");
    for run in runs {
        alarms.count(watched(&run, most)?.is_some());
    }
    Ok(alarms)
}

/// A disc in the air with noise, and steps of a multiple of h/(c + |v|).
fn noisy_disc(scheme: StressScheme, multiplier: f64) -> Run {
    let scene = alone([12, 12], Shape::disc([5.6, 6.3], 3.4), elastic(1.0, 0.3))
        .with_scheme(scheme)
        .with_time_step(unstable(multiple(multiplier)));
    (scene, flying(|x| shaken(x, 1e-6)))
}

/// Two blocks that run into each other as one field, each a little slower than its waves.
fn squeezed(scheme: StressScheme, dt: f64) -> Run {
    let mut scene = open([16, 8])
        .with_scheme(scheme)
        .with_time_step(unstable(fixed(dt)));
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    for (left, velocity) in [(4.0, 1.0), (8.0, -1.0)] {
        let shape = rectangle([left, 2.0], [left + 4.0, 5.0]);
        scene.add_body(shape, material).velocity = [velocity, 0.0, 0.0];
    }
    (scene, options())
}

fn too_long() -> RowVerdict {
    const EITHER: &[Invariant] = &[Invariant::Energy, Invariant::Increment];
    // Twice of what is below the bound of 0.44 of USL, and of 1.3 of the others.
    let too_long = |scheme| match scheme {
        StressScheme::Usl => 0.8,
        StressScheme::Usf | StressScheme::Musl => 2.4,
    };
    let mut refusals = vec![];
    for scheme in SCHEMES {
        let noisy = noisy_disc(scheme, too_long(scheme));
        refusals.push(noticed(&noisy, EITHER, MOST)?);
        refusals.push(noticed(&squeezed(scheme, 0.6), &[Invariant::Increment], 1)?);
    }
    let stable = SCHEMES.map(|scheme| noisy_disc(scheme, 0.5 * too_long(scheme)));
    let gentle = SCHEMES.map(|scheme| squeezed(scheme, 0.06));
    Ok(Finding::of([
        no_alarm("half the step", stable, MOST)?,
        no_alarm("a tenth of the step", gentle, 10)?,
    ])
    .refusing(refusals))
}

/// A bar between fixed ends that swings by half a cell.
fn swinging(weighting: Weighting, scheme: StressScheme) -> Run {
    let scene = bar(12).with_weighting(weighting).with_scheme(scheme);
    let wave = PI / 12.0;
    // The amplitude is the speed over the frequency.
    let swings = flying(move |x| [0.8 * wave * libm::sin(wave * x[0]), 0.0, 0.0]);
    (scene, swings)
}

fn crossing() -> RowVerdict {
    let (scene, swings) = swinging(Weighting::Linear, StressScheme::Usf);
    // 2.6 times the step that the kernel would take.
    let crossing = (scene.with_time_step(unstable(multiple(0.56))), swings);
    let refusal = noticed(&crossing, &[Invariant::Energy], 20 * MOST)?;
    let sound = SCHEMES.map(|scheme| swinging(Weighting::UniformGimp, scheme));
    Ok(Finding::of([no_alarm("GIMP", sound, MOST)?]).refusing(vec![refusal]))
}
