//! Runs that must stop: a particle leaves the mesh, a step is far too long.

use super::prelude::*;
use proctor_scene::simulation::{ParticleAt, Violation};

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("domain-exit", domain_exit)
        .with("a block flies out of the mesh through each of its sides")
        .must("an error with particle, place and step; or removal with a ledger of the mass"),
    Extreme::of("step-too-long", step_too_long)
        .with("time steps of ten times h/(c + |v|)")
        .must("refused; on request the blow-up is reported within 100 steps"),
];

/// Velocities through each side of a mesh of ten cells per axis \[m/s\].
const WAYS: [[f64; 2]; 5] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, 1.0],
    [0.0, -1.0],
    [0.7, -0.7],
];
/// Edge of the mesh \[m\].
const EDGE: f64 = 10.0;

fn domain_exit() -> RowVerdict {
    let mut misplaced = gate("exits told of a wrong body, place or step").none(
        "a particle may be beyond a plane, by no more than the half cell that a step may cross",
    );
    let mut left = gate("runs with particles after all must have left")
        .none("the last of them has 5.8 m to go, and 9 s at 0.7 m/s or more are run");
    let mut off = gate("mass that is neither left nor booked, over all")
        .at_most(2e-15, "a sum of nine equal masses is rounded eight times");
    let mut refusals = vec![];
    let out = |at: &ParticleAt| at.position.iter().any(|x| !(0.0..=EDGE).contains(x));
    let just = |at: &ParticleAt| at.position.iter().all(|x| (-0.5..=EDGE + 0.5).contains(x));
    for method in methods() {
        for way in WAYS.map(|[x, y]| [x, y, 0.0]) {
            let what = format!("{method}, at {way:?} m/s");
            let mut scene = with(&block([10, 10], [4.2, 4.2], [5.7, 5.7], soft()), method);
            (scene.bodies[0].id, scene.bodies[0].velocity) = (7, way);
            let mut simulation = start(&scene, &options())?;
            let error = stopped(&what, &mut simulation, 10_000, "it never left")?;
            let StepErrorKind::Outside(at) = &error.kind else {
                return Err(unexpected(what + ": an exit", error));
            };
            let named = at.body == 7 && out(at) && just(at);
            misplaced.count(!named || error.step != simulation.steps() + 1);
            refusals.push(format!("{what}: {error}"));

            scene.outside = Outside::Remove;
            let mut simulation = start(&scene, &options())?;
            let mass = simulation.mass();
            to_time(&mut simulation, 9.0)?;
            removed(&simulation).for_each(|at| misplaced.count(!out(at)));
            left.count(simulation.particles() > 0);
            off.see(unbooked(&simulation, mass));
        }
    }
    Ok(Finding::of([misplaced, left, off]).refusing(refusals))
}

/// Steps of ten times h/(c + |v|), and within how many of them the kernel must say that it went wrong.
const TOO_LONG: f64 = 10.0;
const MOST: u64 = 100;

/// Steps over the critical one that are too long by a little.
const OVER: [f64; 3] = [1.2, 1.5, 2.0];

/// A block that steps of ten times h/(c + |v|) blow up.
fn blown_up(method: Method, time_step: TimeStep) -> Scene {
    let scene = with(&block([20, 20], [7.2, 7.3], [12.2, 12.3], soft()), method);
    // Longer than any of the steps, which would else be refused for that.
    scene
        .with_end(2.0 * MOST as f64 * TOO_LONG)
        .with_time_step(time_step)
}

fn step_too_long() -> RowVerdict {
    let mut latest =
        gate("steps until the blow-up is reported").at_most(MOST as f64, "5d: within 100 steps");
    let mut told = [
        gate("runs stopped or doubted for energy from nowhere")
            .at_least(1.0, "noise of 1e-9 and a step a little too long: energy doubles many times before a particle is strained by a half")
            .found(0.0),
        gate("runs stopped or doubted for a strain increment")
            .at_least(1.0, "noise of a thousandth strains particles before energy is looked at")
            .found(0.0),
    ];
    let mut tell = |violation: &Violation| {
        if let Some(gate) = told.get_mut(violation.reason as usize) {
            gate.count(true);
        }
    };
    let initial = |noise| rough([0.0; 3], noise, noise);
    let mut refusals = vec![];
    for method in methods() {
        for time_step in [multiple(TOO_LONG), fixed(TOO_LONG)] {
            let scene = blown_up(method, time_step);
            let refusal = refused_step(method, &scene, &initial(NOISES[0]), |_| true)?;
            refusals.push(format!("{method}: {refusal}"));
        }
        for time_step in [multiple(TOO_LONG), fixed(TOO_LONG)].map(unstable) {
            for noise in NOISES {
                // Who stops at once, and who only tells.
                for on_imbalance in [OnImbalance::Stop, OnImbalance::Tell] {
                    let mut scene = blown_up(method, time_step);
                    scene.on_imbalance = on_imbalance;
                    let mut simulation = start(&scene, &initial(noise))?;
                    let (step, error) = until_told(&mut simulation);
                    latest.see(step as f64);
                    let error = error.map(|error| error.kind);
                    match (error, simulation.invariants().violation) {
                        (Some(StepErrorKind::NotTrusted(violation)), _)
                        | (None, Some(violation)) => tell(&violation),
                        (Some(kind), _) if is_blow_up(&kind) => {}
                        (found, _) => return Err(unexpected(method, format!("{found:?}"))),
                    }
                }
            }
        }
        // A step that is too long by a little, so that noise grows slowly.
        for over in OVER {
            let length = unstable(multiple(over * method.stability_number(2)));
            let mut simulation = start(&blown_up(method, length), &initial(NOISES[1]))?;
            let (_, error) = until_told(&mut simulation);
            match (error, simulation.invariants().violation) {
                (Some(error), _) if !is_blow_up(&error.kind) => {
                    let what = format!("{method}, {over} times the critical step");
                    return Err(unexpected(what, error));
                }
                (None, Some(violation)) => tell(&violation),
                _ => {}
            }
        }
    }
    Ok(Finding::of([latest]).and(told).refusing(refusals))
}

/// True for an error of a particle that went wrong: it left, turned inside out or is no number any more.
fn is_blow_up(kind: &StepErrorKind) -> bool {
    matches!(
        kind,
        StepErrorKind::NotFinite(_)
            | StepErrorKind::Law { .. }
            | StepErrorKind::Inverted(_)
            | StepErrorKind::Outside(_)
            | StepErrorKind::OffAbsorbingPlane { .. }
            | StepErrorKind::Porosity { .. }
            | StepErrorKind::DomainTooLarge { .. }
            | StepErrorKind::Memory(_)
            | StepErrorKind::OtherRank { .. }
            | StepErrorKind::RanksDisagree { .. }
    )
}

/// Noise at the start \[m/s, Pa\].
const NOISES: [f64; 2] = [1e-3, 1e-9];

/// Runs until there is an error or a doubt; the number of the step after which it was told, infinitely many where it never was.
fn until_told(simulation: &mut Simulation) -> (u64, Option<StepError>) {
    for _ in 0..2 * MOST {
        if let Err(error) = simulation.step(NEVER) {
            return (error.step, Some(error));
        }
        if let Some(violation) = simulation.invariants().violation {
            return (violation.step, None);
        }
    }
    (u64::MAX, None)
}
