//! Runs that must stop: a particle leaves the mesh, a step is far too long.

use super::prelude::*;
use proctor_scene::simulation::{Invariant, ParticleAt};

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
            let error = stopped(&mut simulation, 10_000, |_| ())?;
            let StepErrorKind::Outside(at) = &error.kind else {
                return Err(unexpected(what + ": an exit", error));
            };
            let named = at.body == 7 && out(at) && just(at);
            misplaced.count(!named || error.step != simulation.steps() + 1);
            refusals.push(format!("{what}: {error}"));

            let (simulation, unbooked) = emptied(&scene, 9.0)?;
            removed(&simulation).for_each(|at| misplaced.count(!out(at)));
            left.count(simulation.particles() > 0);
            off.see(unbooked);
        }
    }
    Ok(Finding::of([misplaced, left, off]).refusing(refusals))
}

/// Steps of ten times h/(c + |v|), and within how many of them the kernel must say that it went wrong.
const TOO_LONG: f64 = 10.0;
const MOST: u64 = 100;
/// Noise at the start \[m/s, Pa\].
const NOISES: [f64; 2] = [1e-3, 1e-9];

/// A block that steps of ten times h/(c + |v|) blow up.
fn blown_up(method: Method, time_step: TimeStep) -> Scene {
    let scene = with(&block([20, 20], [7.2, 7.3], [12.2, 12.3], soft()), method);
    // Longer than any of the steps, which would else be refused for that.
    let end = 2.0 * MOST as f64 * TOO_LONG;
    scene.with_end(end).with_time_step(time_step)
}

fn step_too_long() -> RowVerdict {
    let mut latest =
        gate("steps until the blow-up is reported").at_most(MOST as f64, "5d: within 100 steps");
    let mut energetic = gate("runs stopped or doubted for energy from nowhere")
        .at_least(1.0, "noise of 1e-9 and a step a little too long: energy doubles many times before a particle is strained by a half")
        .found(0.0);
    let mut strained = gate("runs stopped or doubted for a strain increment")
        .at_least(
            1.0,
            "noise of a thousandth strains particles before energy is looked at",
        )
        .found(0.0);
    let mut tell = |reason: Option<Invariant>| {
        energetic.count(reason == Some(Invariant::Energy));
        strained.count(reason == Some(Invariant::Increment));
    };
    let initial = |noise| rough([0.0; 3], noise, noise);
    let mut refusals = vec![];
    for method in methods() {
        for time_step in [multiple(TOO_LONG), fixed(TOO_LONG)] {
            let mut scene = blown_up(method, time_step);
            let refusal = refused_step(method, &scene, &initial(NOISES[0]), |_| true)?;
            refusals.push(format!("{method}: {refusal}"));
            scene.time_step = unstable(time_step);
            for noise in NOISES {
                // Who stops at once, and who only tells.
                for on_imbalance in [OnImbalance::Stop, OnImbalance::Tell] {
                    scene.on_imbalance = on_imbalance;
                    let told = until_told(&scene, &initial(noise))?;
                    let (step, reason) = told.ok_or_else(|| unexpected(method, "never told"))?;
                    latest.see(step as f64);
                    tell(reason);
                }
            }
        }
        // A step that is too long by a little, so that noise grows slowly.
        for over in [1.2, 1.5, 2.0] {
            let length = unstable(multiple(over * method.stability_number(2)));
            let told = until_told(&blown_up(method, length), &initial(NOISES[1]))?;
            tell(told.and_then(|(_, reason)| reason));
        }
    }
    Ok(Finding::of([latest, energetic, strained]).refusing(refusals))
}

/// The step after which a run was stopped or doubted, and the balance that was off, if it was not a particle that left, turned
/// inside out or is no number any more; `None` where nothing was told.
fn until_told(scene: &Scene, initial: &Options) -> Result<Option<(u64, Option<Invariant>)>> {
    use StepErrorKind::{DomainTooLarge, Inverted, NotFinite, NotTrusted, Outside};
    let mut simulation = start(scene, initial)?;
    for _ in 0..2 * MOST {
        let told = match (simulation.step(NEVER), simulation.invariants().violation) {
            (Ok(_), None) => continue,
            (Ok(_), Some(violation)) => (violation.step, Some(violation.reason)),
            (Err(e), _) => match &e.kind {
                NotTrusted(violation) => (e.step, Some(violation.reason)),
                NotFinite(_) | Inverted(_) | Outside(_) | DomainTooLarge { .. } => (e.step, None),
                _ => return Err(unexpected(method(scene), e)),
            },
        };
        return Ok(Some(told));
    }
    Ok(None)
}
