//! The outcome of a text: a scene that steps, or a message. Nothing else.

use super::bases::FOLDER;
use proctor_files::json::from_json;
use proctor_files::run::{Run, RunControl};
use proctor_kernel::memory::Memory;
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::Options;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

/// Stage that a text reached.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// It is no scene, says the message.
    Refused(String),
    /// It is a scene that cannot be set up, says the message.
    NotSetUp(String),
    /// A step failed, says the message.
    Failed(String),
    /// It was stepped.
    Stepped,
    /// It is a scene, too large for a test to step it.
    Large,
}

/// Memory of a scene in these tests \[bytes\]: what needs more is refused.
const MEMORY: u64 = 64 << 20;
/// Steps of a scene that can be stepped.
const STEPS: u64 = 3;
/// Particles and nodes beyond which a scene is not stepped.
const MOST: [usize; 2] = [4000, 200_000];
/// Far longer than any of it takes, on a machine that does much else: what is not done by then hangs.
const PATIENCE: Duration = Duration::from_secs(60);

/// Outcome of reading a text.
///
/// # Errors
/// If a panic, an empty message or an endless run happens.
pub(crate) fn outcome(text: &str) -> Result<Outcome, String> {
    outcome_in(text, Path::new(FOLDER), STEPS)
}

/// Outcome of a text whose files are in `folder`, which is stepped so many times.
///
/// # Errors
/// As [`outcome`].
pub(crate) fn outcome_in(text: &str, folder: &Path, steps: u64) -> Result<Outcome, String> {
    let (sender, receiver) = channel();
    let (own, folder) = (text.to_owned(), folder.to_owned());
    let thread = thread::Builder::new()
        // That of a main thread, which is where the command does its work.
        .stack_size(8 << 20)
        .spawn(move || {
            let found = catch_unwind(AssertUnwindSafe(|| of(&own, &folder, steps)));
            let _ = sender.send(found.map_err(|panic| {
                panic
                    .downcast_ref::<String>()
                    .cloned()
                    .or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()))
                    .unwrap_or_default()
            }));
        })
        .map_err(|error| error.to_string())?;
    let found = receiver
        .recv_timeout(PATIENCE)
        .map_err(|_| format!("no end within {PATIENCE:?}"))?
        .map_err(|panic| format!("panic: {panic}"))?;
    let _ = thread.join();
    match &found {
        Outcome::Refused(message) | Outcome::NotSetUp(message) | Outcome::Failed(message)
            if message.trim().is_empty() =>
        {
            Err(format!("no message: {found:?}"))
        }
        _ => Ok(found),
    }
}

fn of(text: &str, folder: &Path, most: u64) -> Outcome {
    let scene = match from_json(text, "any.json", folder) {
        Ok(scene) => scene,
        Err(error) => return Outcome::Refused(error.to_string()),
    };
    let plan = proctor_scene::simulation::plan(&scene, PlanOptions::default());
    let _ = plan.to_string();
    let options = Options {
        threads: scene.threads.is_none().then_some(1),
        memory: Some(Memory::of(MEMORY)),
        ..Options::default()
    };
    let mut run = match Run::start(&scene, &options, None, None) {
        Ok(run) => run,
        Err(error) => return Outcome::NotSetUp(error.to_string()),
    };
    let simulation = run.simulation();
    if simulation.particles() > MOST[0] || simulation.nodes_active() > MOST[1] {
        return Outcome::Large;
    }
    let mut steps = 0;
    if most == 0 {
        return Outcome::Stepped;
    }
    while let Some(stop) = run.next_stop() {
        let advanced = run.advance(stop, |_| {
            steps += 1;
            if steps < most {
                RunControl::On
            } else {
                RunControl::Stop
            }
        });
        if let Err(error) = advanced {
            return Outcome::Failed(error.to_string());
        }
    }
    let _ = run.summary();
    Outcome::Stepped
}
