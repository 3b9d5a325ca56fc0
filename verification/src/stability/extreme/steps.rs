//! Runs that must stop: a particle leaves the mesh, a step is far too long.

use proctor_scene::simulation::{
    EventKind, SetupError, Simulation, StartError, StepError, StepErrorKind,
};
use proctor_scene::{Dimension, OnImbalance, Outside, Scene, TimeStep};

use super::runs::{
    NEVER, block, first_error, from, is_blow_up, methods, options, rough, soft, start, to_time,
    with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "domain-exit",
        what: "a block flies out of the mesh through each of its sides",
        required: "an error with particle, place and step; or removal with a ledger of the mass",
        cause: None,
        judge: domain_exit,
    },
    Extreme {
        name: "step-too-long",
        what: "time steps of ten times h/(c + |v|)",
        required: "refused; on request the blow-up is told within 100 steps",
        cause: None,
        judge: step_too_long,
    },
];

/// Velocities through each side of a mesh of ten cells per axis \[m/s\].
const WAYS: [[f64; 3]; 5] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.7, -0.7, 0.0],
];
/// Edge of the mesh \[m\].
const EDGE: f64 = 10.0;

/// A block in the middle of its mesh that flies.
fn leaving(velocity: [f64; 3]) -> Scene {
    let mut scene = block([10, 10], [4.2, 4.2], [5.7, 5.7], soft());
    scene.bodies[0].velocity = velocity;
    scene.bodies[0].id = 7;
    scene
}

fn domain_exit() -> Result<Finding, Unexpected> {
    let mut refusals = vec![];
    let (mut misplaced, mut off, mut left) = (0, 0.0_f64, 0);
    for method in methods() {
        for way in WAYS {
            let what = format!("{method}, at {way:?} m/s");
            let mut scene = with(&leaving(way), method);
            let mut simulation = start(&what, &scene, &options())?;
            let Some(error) = first_error(&mut simulation, 10_000) else {
                return Err(Unexpected(format!("{what}: it never left")));
            };
            let StepErrorKind::Outside(at) = error.kind else {
                return Err(Unexpected(format!("{what}: an exit is called {error}")));
            };
            let beyond = |x: f64| !(0.0..=EDGE).contains(&x);
            let just = at
                .position
                .iter()
                .all(|&x| (-0.5..=EDGE + 0.5).contains(&x));
            let named = at.body == 7 && at.position.iter().any(|&x| beyond(x)) && just;
            misplaced += usize::from(!named || error.step != simulation.steps() + 1);
            refusals.push(format!("{what}: {error}"));

            scene.outside = Outside::Remove;
            let mut simulation = start(&what, &scene, &options())?;
            let mass = simulation.mass();
            to_time(&what, &mut simulation, 9.0)?;
            let mut booked = 0.0;
            for event in simulation.events() {
                let EventKind::Removed(at) = &event.kind else {
                    continue;
                };
                misplaced += usize::from(!at.position.iter().any(|&x| beyond(x)));
                booked += at.mass;
            }
            left += usize::from(simulation.particles() > 0);
            off = off.max((booked + simulation.mass() - mass).abs() / mass);
        }
    }
    let none = |name: &str, count: usize, reason| {
        Gate::at_most(name.to_owned(), count as f64, 0.0, reason)
    };
    Ok(Finding {
        gates: vec![
            none(
                "exits told of a wrong body, place or step",
                misplaced,
                "a particle may be beyond a plane, by no more than the half cell that a step may cross",
            ),
            none(
                "runs with particles after all must have left",
                left,
                "the last of them has 5.8 m to go, and 9 s at 0.7 m/s or more are run",
            ),
            Gate::at_most(
                "mass that is neither left nor booked, over all".to_owned(),
                off,
                2e-15,
                "a sum of nine equal masses is rounded eight times",
            ),
        ],
        refusals,
    })
}

/// Steps of ten times h/(c + |v|), and within how many of them the kernel must say that it went wrong.
const TOO_LONG: f64 = 10.0;
const MOST: u64 = 100;

/// Steps over the critical one that are too long by a little.
const OVER: [f64; 3] = [1.2, 1.5, 2.0];

fn step_too_long() -> Result<Finding, Unexpected> {
    let mut finding = Finding::default();
    let (mut latest, mut told) = (0, [0_u32; 3]);
    for method in methods() {
        let mut scene = with(&block([20, 20], [7.2, 7.3], [12.2, 12.3], soft()), method);
        // Longer than any of the steps, which would else be refused for that.
        scene.time = 2.0 * MOST as f64 * TOO_LONG;
        let initial = |noise| from(rough(Dimension::Two, [0.0; 3], noise, noise));
        let lengths = |allow_unstable| {
            [
                TimeStep::Multiplier {
                    multiplier: TOO_LONG,
                    allow_unstable,
                },
                TimeStep::Fixed {
                    dt: TOO_LONG,
                    allow_unstable,
                },
            ]
        };
        for time_step in lengths(false) {
            scene.time_step = time_step;
            match scene.simulate(&initial(NOISES[0])) {
                Err(StartError::Setup(SetupError::UnstableTimeStep(unstable))) => {
                    finding.refusals.push(format!("{method}: {unstable}"));
                }
                Err(error) => {
                    return Err(Unexpected(format!("{method}: C = 10 is called {error}")));
                }
                Ok(_) => return Err(Unexpected(format!("{method}: C = 10 was taken"))),
            }
        }
        for time_step in lengths(true) {
            scene.time_step = time_step;
            for noise in NOISES {
                // Who stops at once, and who only tells.
                for on_imbalance in [OnImbalance::Stop, OnImbalance::Tell] {
                    scene.on_imbalance = on_imbalance;
                    let what = method.to_string();
                    let mut simulation = start(&what, &scene, &initial(noise))?;
                    let (step, error) = until_told(&mut simulation);
                    latest = latest.max(step);
                    let reason = match (
                        error.map(|error| error.kind),
                        simulation.invariants().violation,
                    ) {
                        (Some(StepErrorKind::NotTrusted(violation)), _)
                        | (None, Some(violation)) => violation.reason,
                        (Some(kind), _) if is_blow_up(&kind) => continue,
                        (found, _) => {
                            return Err(Unexpected(format!(
                                "{what}: a blow-up is called {found:?}"
                            )));
                        }
                    };
                    told[reason as usize] += 1;
                }
            }
        }
    }
    for method in methods() {
        // A step that is too long by a little, so that noise grows slowly.
        for over in OVER {
            let mut scene = with(&block([20, 20], [7.2, 7.3], [12.2, 12.3], soft()), method);
            scene.time_step = TimeStep::Multiplier {
                multiplier: over * method.stability_number(2),
                allow_unstable: true,
            };
            let what = format!("{method}, {over} times the critical step");
            let initial = rough(Dimension::Two, [0.0; 3], NOISES[1], NOISES[1]);
            let mut simulation = start(&what, &scene, &from(initial))?;
            let (_, error) = until_told(&mut simulation);
            match (
                error.map(|error| error.kind),
                simulation.invariants().violation,
            ) {
                (Some(kind), _) if !is_blow_up(&kind) => {
                    return Err(Unexpected(format!("{what}: a blow-up is called {kind:?}")));
                }
                (None, Some(violation)) => told[violation.reason as usize] += 1,
                _ => {}
            }
        }
    }
    let [energy, increment, _] = told;
    finding.gates = vec![
        Gate::at_most(
            "steps until the blow-up is told".to_owned(),
            latest as f64,
            MOST as f64,
            "5d: within 100 steps",
        ),
        Gate::at_least(
            "runs stopped or doubted for energy from nowhere".to_owned(),
            f64::from(energy),
            1.0,
            "noise of 1e-9 and a step a little too long: energy doubles many times before a particle is strained by a half",
        ),
        Gate::at_least(
            "runs stopped or doubted for a strain increment".to_owned(),
            f64::from(increment),
            1.0,
            "noise of a thousandth strains particles before energy is looked at",
        ),
    ];
    Ok(finding)
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
