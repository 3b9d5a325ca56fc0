//! The stages before the one that is judged, on one mesh: run in memory, each from the end of the one before.

use proctor_files::run::{Run, RunControl, RunError};
use proctor_scene::Scene;
use proctor_scene::simulation::{Options, SetupError, StartState};
use std::sync::Arc;

/// The end of the stages.
pub enum StagesEnd {
    /// The state from which the judged scene begins; `None` where there are no stages before it.
    At(Option<Arc<StartState>>),
    /// The reason why one of them failed.
    Failed(String),
    /// The caller ended them.
    Interrupted,
}

/// Runs stages, of which each begins where the one before ends, up to the start of `judged`. `go` hears in every step how many
/// stages are done and answers whether to go on.
///
/// # Errors
/// A stage that cannot be set up.
pub fn run(
    earlier: &[Scene],
    judged: &Scene,
    options: &Options,
    go: &(dyn Fn(f64) -> bool + Sync),
) -> Result<StagesEnd, Box<SetupError>> {
    let mut options = options.clone();
    for (number, scene) in earlier.iter().enumerate() {
        let next = earlier.get(number + 1).unwrap_or(judged);
        let keeps = next.initial_state.as_ref();
        let keeps = keeps.is_some_and(|state| state.keeps_velocity);
        let mut run = match Run::start(scene, &options, None, None) {
            Ok(run) => run,
            Err(RunError::Setup(error)) => return Err(Box::new(error)),
            Err(error) => return Ok(failed(scene, &error)),
        };
        while let Some(stop) = run.next_stop() {
            let mut goes_on = true;
            let stepped = run.advance(stop, |info| {
                goes_on = go(number as f64 + info.time / scene.time);
                if goes_on {
                    RunControl::On
                } else {
                    RunControl::Stop
                }
            });
            if let Err(error) = stepped {
                return Ok(failed(scene, &error));
            }
            if !goes_on {
                return Ok(StagesEnd::Interrupted);
            }
        }
        options.start = match run.state(keeps) {
            Ok(state) => Some(Arc::new(state)),
            Err(error) => return Ok(failed(scene, &error)),
        };
    }
    Ok(StagesEnd::At(options.start))
}

fn failed(scene: &Scene, error: &RunError) -> StagesEnd {
    StagesEnd::Failed(format!("{}: {error}", scene.name))
}
