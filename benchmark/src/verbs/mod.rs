//! The verbs of the command, one file each.

mod accept;
mod amount;
mod arena;
mod bench;
mod compare;
mod element;
mod export;
mod folder;
mod history;
mod judge;
mod keys;
mod main_job;
mod names;
mod new;
mod noise;
mod picture;
mod plan;
mod precision;
mod refine;
mod report;
mod run;
mod schema;
mod settings;
mod stability;
mod verify;

use crate::exit::{Failure, Outcome};
use crate::say::say;
use crate::suite::Against;
pub use amount::Amount;
use clap::Subcommand;
use proctor_files::json::{SceneSource, SourceMap, Stage};
use proctor_kernel::ranks::Ranks;
use proctor_scene::{Scene, SceneError};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;

/// Verbs of the command.
#[derive(Subcommand)]
pub enum Verb {
    /// Write a small scene to start from; without a kind, list the kinds.
    New(new::New),
    /// Explain the keys of scene files: all as a table, or one in full.
    Keys(keys::Keys),
    /// Run a scene; write frames, history and a summary.
    Run(run::Run),
    /// Show what a scene needs, what is left out, and why.
    Plan(plan::Plan),
    /// Draw the particles of a run, coloured by a field, and its histories.
    Picture(picture::Picture),
    /// Run verification cases: errors, observed orders, gates.
    Verify(verify::Verify),
    /// Show the error against the run time, for every case with an exact solution.
    Precision(precision::Precision),
    /// Give the results of a scene error bars, from runs on three meshes.
    Refine(refine::Refine),
    /// Find the largest stable time step of each method, predicted and measured.
    Stability(stability::Stability),
    /// Run laboratory tests on the materials of a scene, without a grid.
    Element(element::Element),
    /// Measure speed: scenes x particles x threads x methods, stages, other executables.
    Bench(bench::Bench),
    /// Run other solvers on all open cases, in one table and one picture.
    Arena(arena::Arena),
    /// Write a record, or runs of one scene, as a self-contained HTML page.
    Report(report::Report),
    /// Compare two records, judged; or two runs of one scene.
    Compare(compare::Compare),
    /// Judge frames that a solver left on a case, without running it.
    Judge(judge::Judge),
    /// Add the changes between two records to the ledger of accepted changes.
    Accept(accept::Accept),
    /// Measure the noise of each case: the same program against itself.
    Noise(noise::Noise),
    /// Write a record in the format of another tool.
    Export(export::Export),
    /// Show how the numbers of records went over commits, and where they changed.
    History(history::History),
    /// Print the JSON Schema of scene files, for editors.
    Schema(schema::Schema),
}

/// Runs a verb; without one, the main job, against those references, which prints that much.
pub fn run(
    verb: Option<&Verb>,
    amount: Amount,
    against: Against,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    match verb {
        None => main_job::run(amount, against, out),
        Some(Verb::New(new)) => new.run(out),
        Some(Verb::Keys(keys)) => keys.run(out),
        Some(Verb::Run(run)) => run.run(out),
        Some(Verb::Plan(plan)) => plan.run(out),
        Some(Verb::Picture(picture)) => picture.run(out),
        Some(Verb::Verify(verify)) => verify.run(out),
        Some(Verb::Precision(precision)) => precision.run(out),
        Some(Verb::Refine(refine)) => refine.run(out),
        Some(Verb::Stability(stability)) => stability.run(out),
        Some(Verb::Element(element)) => element.run(out),
        Some(Verb::Bench(bench)) => bench.run(out),
        Some(Verb::Arena(arena)) => arena.run(out),
        Some(Verb::Report(report)) => report.run(out),
        Some(Verb::Compare(compare)) => compare.run(out),
        Some(Verb::Judge(judge)) => judge.run(out),
        Some(Verb::Accept(accept)) => accept.run(out),
        Some(Verb::Noise(noise)) => noise.run(out),
        Some(Verb::Export(export)) => export.run(out),
        Some(Verb::History(history)) => history.run(out),
        Some(Verb::Schema(schema)) => schema.run(out),
    }
}

/// Runs a verb on ranks that share it: a run of a scene, with the same program on all of them.
pub fn run_on_ranks(
    verb: Result<Option<Verb>, clap::Error>,
    ranks: &Arc<dyn Ranks>,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    let verb = verb.map_err(|error| Failure::BadInput(error.to_string()))?;
    run::same_program(&**ranks)?;
    match verb {
        Some(Verb::Run(run)) => run.run_on(Some(ranks), out),
        _ => Err(Failure::BadInput(
            "ranks share the run of a scene; accepted: `mpirun -n N proctor-mpi run SCENE`, and `proctor` for all other verbs"
                .into(),
        )),
    }
}

/// The name that stands for standard input where a scene is read.
const STANDARD_INPUT: &str = "-";

/// A scene from a file, or with `-` from standard input, and the places of its values; or all that is wrong with it.
fn scene(path: &Path) -> Result<(Scene, SourceMap), Failure> {
    source(path)
        .and_then(SceneSource::scene)
        .map_err(Failure::bad_input)
}

/// Reads a scene and its stages; one without a name where it has none.
fn stages(path: &Path) -> Result<Vec<Stage>, Failure> {
    source(path)
        .and_then(SceneSource::stages)
        .map_err(Failure::bad_input)
}

/// The text of a scene.
fn source(path: &Path) -> Result<SceneSource, SceneError> {
    if path.as_os_str() != STANDARD_INPUT {
        return SceneSource::file(path);
    }
    let input = std::io::stdin();
    if input.is_terminal() {
        say!("reading a scene from standard input, to its end");
    }
    SceneSource::stream("stdin", Path::new(""), input.lock())
}
