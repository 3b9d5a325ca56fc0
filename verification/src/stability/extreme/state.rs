//! Numbers that go wrong at the start or on the way.

use std::sync::Arc;

use proctor_scene::Scene;
use proctor_scene::simulation::{BodyForce, InitialState, Options, StepErrorKind};

use super::runs::{
    NEVER, block, first_error, from, methods, options, soft, start, steps, unexpected, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::settings::Method;

pub const ROWS: &[Extreme] = &[Extreme {
    name: "not-finite-state",
    what: "a velocity, a stress, a deformation or a force becomes NaN or infinite",
    required: "the run stops in the same step, and goes on from the state before",
    cause: None,
    judge: not_finite_state,
}];

/// What goes wrong at the start of one particle.
const FAULTS: [fn(&mut InitialState, f64); 3] = [
    |state, x| state.velocity[1] = x,
    |state, x| state.stress[0] = x,
    |state, x| state.deformation[0][0] = x,
];

/// A place of a particle of the block below \[m\].
const FAULTY: [f64; 2] = [3.75, 3.25];

fn not_finite_state() -> Result<Finding, Unexpected> {
    let mut refusals = vec![];
    let mut late = 0;
    for method in methods() {
        let scene = with(&block([8, 8], [2.5, 2.5], [5.5, 5.5], soft()), method);
        for put in FAULTS {
            for value in [f64::NAN, f64::INFINITY] {
                let initial = move |x: &[f64; 3]| {
                    let mut state = AT_REST;
                    if x[..2] == FAULTY {
                        put(&mut state, value);
                    }
                    state
                };
                let what = method.to_string();
                let mut simulation = start(&what, &scene, &from(Arc::new(initial)))?;
                let Some(error) = first_error(&mut simulation, 1) else {
                    late += 1;
                    continue;
                };
                match error.kind {
                    // An infinite speed allows no step at all.
                    StepErrorKind::NotFinite(_) | StepErrorKind::TimeStands { .. } => {
                        refusals.push(format!("{method}: {error}"));
                    }
                    _ => {
                        return Err(Unexpected(format!(
                            "{method}: a value {value} is called {error}"
                        )));
                    }
                }
            }
        }
        goes_on_from_before(method, &scene, &mut late, &mut refusals)?;
    }
    let reason =
        "what is not finite spreads to all neighbours in a step, so that the step must be the last";
    Ok(Finding {
        gates: vec![Gate::at_most(
            "values that are not finite and did not stop the run in their step".to_owned(),
            f64::from(late),
            0.0,
            reason,
        )],
        refusals,
    })
}

/// A force that becomes NaN stops the run in that step, and the state saved before goes on without it to the same bits.
fn goes_on_from_before(
    method: Method,
    scene: &Scene,
    late: &mut u32,
    refusals: &mut Vec<String>,
) -> Result<(), Unexpected> {
    let what = method.to_string();
    let force = |sick: bool| -> BodyForce {
        Arc::new(move |_, x, t| {
            let broken = sick && t > 0.5 && x[0] > 4.0;
            [if broken { f64::NAN } else { 0.01 }, 0.0, 0.0]
        })
    };
    let with_force = |sick: bool| Options {
        body_force: Some(force(sick)),
        ..options()
    };
    let mut sick = start(&what, scene, &with_force(true))?;
    let mut good = sick.save();
    let error = loop {
        if sick.steps() > 1000 {
            return Err(Unexpected(format!(
                "{what}: a force that is not a number went unseen"
            )));
        }
        match sick.step(NEVER) {
            Ok(_) => good = sick.save(),
            Err(error) => break error,
        }
    };
    // The force is evaluated at the beginning of a step.
    *late += u32::from(good.state.clock.time <= 0.5 || error.time != good.state.clock.time);
    match error.kind {
        StepErrorKind::NotFinite(_) => refusals.push(format!("{what}: {error}")),
        _ => {
            return Err(Unexpected(format!(
                "{what}: a force that is not a number is called {error}"
            )));
        }
    }
    let mut healed = start(&what, scene, &with_force(false))?;
    healed.restore(good).map_err(|e| unexpected(&what, e))?;
    steps(&what, &mut healed, 10)?;
    let mut whole = start(&what, scene, &with_force(false))?;
    steps(&what, &mut whole, healed.steps())?;
    if whole.state_hash() != healed.state_hash() {
        return Err(Unexpected(format!(
            "{what}: the state before the fault does not go on as if there had been none"
        )));
    }
    Ok(())
}
