//! Numbers that go wrong at the start or on the way.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme::of("not-finite-state", not_finite_state)
    .with("a velocity, a stress, a deformation or a force becomes NaN or infinite")
    .must("the run stops in the same step, and goes on from the state before")];

/// Faults at the start of one particle.
const FAULTS: [fn(&mut InitialState, f64); 3] = [
    |state, x| state.velocity[1] = x,
    |state, x| state.stress[0] = x,
    |state, x| state.deformation[0][0] = x,
];

/// A place of a particle of the block below \[m\].
const FAULTY: [f64; 2] = [3.75, 3.25];

fn not_finite_state() -> RowVerdict {
    let mut late = gate("values that are not finite and did not stop the run in their step")
        .none()
        .because("a value that is not finite reaches all neighbours in one step, so that the step must be the last");
    let mut refusals = vec![];
    for method in methods() {
        let scene = with(&block([8, 8], [2.5, 2.5], [5.5, 5.5], soft()), method);
        for put in FAULTS {
            for value in [f64::NAN, f64::INFINITY] {
                let sick = from(move |x| {
                    let mut state = AT_REST;
                    if x[..2] == FAULTY {
                        put(&mut state, value);
                    }
                    state
                });
                let Some(error) = first_error(&mut start(&scene, &sick)?, 1) else {
                    late.count(true);
                    continue;
                };
                match error.kind {
                    // An infinite speed allows no step at all.
                    StepErrorKind::NotFinite(_) | StepErrorKind::TimeStands { .. } => {
                        refusals.push(format!("{method}: {error}"));
                    }
                    _ => return Err(unexpected(format!("{method}: a value {value}"), error)),
                }
            }
        }
        refusals.push(goes_on_from_before(&scene, &mut late)?);
    }
    Ok(Finding::of([late]).refusing(refusals))
}

/// The message of a force that becomes NaN, which stops the run in that step; the state saved before goes on without it to
/// the same bits.
fn goes_on_from_before(scene: &Scene, late: &mut Gate) -> Result<String, RowFault> {
    let what = method(scene);
    let run = |sick: bool| {
        let mut options = options();
        options.body_force = Some(Arc::new(move |_, x, t| {
            let broken = sick && t > 0.5 && x[0] > 4.0;
            [if broken { f64::NAN } else { 0.01 }, 0.0, 0.0]
        }));
        start(scene, &options)
    };
    let mut sick = run(true)?;
    let mut good = sick.save();
    let error = loop {
        if sick.steps() > 1000 {
            return Err(unexpected(what, "a force that is not a number went unseen"));
        }
        match sick.step(NEVER) {
            Ok(_) => good = sick.save(),
            Err(error) => break error,
        }
    };
    // The force is evaluated at the beginning of a step.
    late.count(good.state.clock.time <= 0.5 || error.time != good.state.clock.time);
    if !matches!(error.kind, StepErrorKind::NotFinite(_)) {
        return Err(unexpected(what + ": a force that is not a number", error));
    }
    let mut healed = run(false)?;
    healed.restore(good).map_err(|e| unexpected(&what, e))?;
    steps(&mut healed, 10)?;
    let mut whole = run(false)?;
    steps(&mut whole, healed.steps())?;
    if whole.state_hash() != healed.state_hash() {
        let fault = "the state before the fault does not go on as if there had been none";
        return Err(unexpected(what, fault));
    }
    Ok(format!("{what}: {error}"))
}
