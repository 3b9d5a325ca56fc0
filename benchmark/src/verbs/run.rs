//! `proctor run`: a scene from its start, or from a checkpoint, to its end.

mod ranks;
mod report;

use super::picture::draw_last;
use super::plan::{OUT_OF_BALANCE, seeks_balance};
use super::settings::{Settings, bounded};
use super::stages;
use crate::bench::children::SCRATCH;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::measure::Stopwatch;
use crate::progress::Progress;
use crate::say::say;
use clap::Args;
use proctor_files::json::{SourceMap, Stage};
use proctor_files::output::summary::{SUMMARY, Status};
use proctor_files::output::{OutputFolder, Summary, atomic};
use proctor_files::run::{Run as KernelRun, RunControl, RunError};
use proctor_kernel::ranks::Ranks;
use proctor_scene::TimeStep;
use proctor_scene::simulation::{Bound, StepInfo};
pub use ranks::same_program;
use report::Report;
pub(super) use report::row;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Run a scene; write frames, history and a summary.
///
/// Into DIR go frames (particles.pvd lists them for viewers), history.csv, checkpoint.bin and
/// summary.json, each of them whole at any moment. Without --out nothing is written. DIR belongs to one run at a time; what
/// the lists of an earlier run name there is taken away, unless --restart goes on with it, and frames that no list names are
/// refused. A scene with stages has a folder in DIR for each. Ctrl-C and SIGTERM finish the step and write the summary; a second one ends at once.
#[derive(Args)]
#[command(
    after_help = "Example: proctor run fixtures/scenes/manual/boussinesq.json --out out\n\
    A scene from another program: make-scene | proctor run - --out out\n\
    Go on from a checkpoint: proctor run SCENE --out out --restart out/checkpoint.bin"
)]
pub struct Run {
    /// Scene file (JSON); - for standard input
    scene: PathBuf,
    /// Folder for the results; created if it does not exist
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw the last frame and the histories when the run is over, as `proctor picture` does
    #[arg(long, requires = "out")]
    picture: bool,
    /// Write each frame as a file of each rank, named by particles_*.pvtu, however few points it has; on ranks
    #[arg(long, requires = "out")]
    pieces: bool,
    /// Run even where the time step of the scene is above the bound of the scheme, as `"allow_unstable": true` in it does
    #[arg(long)]
    allow_unstable: bool,
    #[command(flatten)]
    settings: Settings,
    /// Checkpoint of the same scene to go on from; of a scene with stages, that in the folder of the stage that is to go on
    #[arg(long, value_name = "FILE")]
    restart: Option<PathBuf>,
}

/// Counts over the steps of this invocation.
#[derive(Default)]
struct Tally {
    stopwatch: Stopwatch,
    /// Time in messages while stepping, where there are ranks.
    messages: Option<Duration>,
    particle_steps: f64,
    bounds: BTreeMap<&'static str, u64>,
}

/// Takes a given time step as it is.
fn allow_unstable(step: &mut TimeStep) {
    match step {
        TimeStep::Automatic => {}
        TimeStep::Multiplier { allow_unstable, .. } | TimeStep::Fixed { allow_unstable, .. } => {
            *allow_unstable = true;
        }
    }
}

impl Run {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        ranks::refuse_copies()?;
        if self.pieces {
            return Err(Failure::BadInput(
                "--pieces: found one process; accepted: ranks, `mpirun -n N proctor-mpi run SCENE`"
                    .to_owned(),
            ));
        }
        self.run_on(None, out)
    }

    /// Runs the scene on ranks that share it, or on this process.
    pub fn run_on(
        &self,
        ranks: Option<&Arc<dyn Ranks>>,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        match &self.out {
            Some(folder) if std::env::var_os(SCRATCH).is_some() => {
                atomic::without_waiting(folder, || self.run_stages(ranks, out))
            }
            _ => self.run_stages(ranks, out),
        }
    }

    fn run_stages(
        &self,
        ranks: Option<&Arc<dyn Ranks>>,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        let mut stages = stages(&self.scene)?;
        if self.allow_unstable {
            for stage in &mut stages {
                allow_unstable(&mut stage.scene.time_step);
            }
        }
        let interrupt = Interrupt::listen()?;
        if let [Stage { name, .. }] = &stages[..]
            && name.is_empty()
        {
            let restart = self.restart.as_deref();
            let folder = self.out.as_deref();
            return self.run_stage(&stages[0], (folder, restart), ranks, &interrupt, out);
        }
        let Some(folder) = &self.out else {
            return Err(Failure::BadInput(format!(
                "{}: stages go on from each other's files: --out FOLDER is needed",
                self.scene.display()
            )));
        };
        let folders: Vec<String> = (stages.iter().enumerate())
            .map(|(number, stage)| format!("{}-{}", number + 1, stage.name))
            .collect();
        let first = match &self.restart {
            Some(checkpoint) => stage_of(checkpoint, &folders)?,
            None => 0,
        };
        let mut before = first
            .checked_sub(1)
            .map(|number| folder.join(&folders[number]));
        for (number, mut stage) in stages.into_iter().enumerate().skip(first) {
            if let (Some(state), Some(before)) = (&mut stage.scene.initial_state, before) {
                state.file = before;
            }
            let own = folder.join(&folders[number]);
            writeln!(out, "stage {}", stage.name)?;
            let restart = self.restart.as_deref().filter(|_| number == first);
            let places = (Some(own.as_path()), restart);
            let outcome = self.run_stage(&stage, places, ranks, &interrupt, out)?;
            if outcome != Outcome::Fine {
                return Ok(outcome);
            }
            before = Some(own);
        }
        Ok(Outcome::Fine)
    }

    /// Runs a scene, or one stage of it.
    fn run_stage(
        &self,
        Stage { scene, places, .. }: &Stage,
        (folder, restart): (Option<&Path>, Option<&Path>),
        ranks: Option<&Arc<dyn Ranks>>,
        interrupt: &Interrupt,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        let options = match ranks {
            None => self.settings.options()?,
            Some(ranks) => {
                let mut options = ranks::options(self.settings.options()?, scene, ranks)?;
                options.in_pieces = self.pieces;
                options
            }
        };
        if let (None, Some(threads)) = (options.threads, scene.threads) {
            let key = format!("{}: n_threads", self.scene.display());
            bounded(&key, threads)?;
        }
        let mut run = KernelRun::start(scene, &options, folder, restart)
            .map_err(|error| Failure::BadInput(told(places, &error)))?;
        if folder.is_none() {
            // Now, and not after a run of hours.
            say!(
                "nothing will be written; for frames, histories and a summary: proctor run {} --out FOLDER",
                self.scene.display()
            );
        }
        for change in run.changes() {
            say!("changed from here on: {change}");
        }
        // Bodies were filled anew before their state came from the checkpoint: their balance then is none of the run.
        let anew = restart.is_some() && scene.initial_state.is_some();
        let foreseen = anew || seeks_balance(scene);
        let warnings = run.simulation().plan().warnings.iter();
        for warning in warnings.filter(|warning| !(foreseen && warning.starts_with(OUT_OF_BALANCE)))
        {
            say!("warning: {warning}");
        }
        let first = run.simulation().steps();
        let mut tally = Tally::default();
        let fault = drive(&mut run, &mut tally, options.ranks.as_deref(), interrupt);
        let mut summary = run.summary();
        if let Some(fault) = fault {
            summary.status = Status::Failed;
            say!("{}", told(places, &fault));
            summary.error = Some(fault.to_string());
        }
        let spent = tally.stopwatch.spent;
        summary.wall_seconds = Some(spent.wall.as_secs_f64());
        summary.cpu_seconds = Some(spent.cpu.as_secs_f64());
        summary.message_seconds = tally.messages.map(|time| time.as_secs_f64());
        summary.ns_per_particle_step = spent.ns_per(tally.particle_steps);
        let written = save(&summary, run.folder());
        write!(
            out,
            "{}",
            Report {
                summary: &summary,
                bounds: &tally.bounds,
                first_step: first,
                folder: run.folder().map(OutputFolder::path),
            }
        )?;
        if let (true, Some(folder)) = (self.picture, run.folder()) {
            match draw_last(folder.path()) {
                Ok(files) => {
                    for path in files {
                        writeln!(out, "picture in {}", path.display())?;
                    }
                }
                Err(error) => say!("no picture: {error}"),
            }
        }
        Ok(match summary.status {
            Status::Interrupted => interrupt.outcome(),
            Status::Finished if written => Outcome::Fine,
            _ => Outcome::Failed,
        })
    }
}

/// The stage in whose folder a checkpoint lies.
fn stage_of(checkpoint: &Path, folders: &[String]) -> Result<usize, Failure> {
    let absolute = checkpoint.canonicalize().map_err(|error| {
        Failure::BadInput(format!("--restart: {}: {error}", checkpoint.display()))
    })?;
    let folder = absolute.parent().and_then(Path::file_name);
    let found = folders
        .iter()
        .position(|own| folder.is_some_and(|folder| folder == own.as_str()));
    found.ok_or_else(|| {
        Failure::BadInput(format!(
            "--restart: found {}; accepted: the checkpoint in the folder of a stage, {}",
            checkpoint.display(),
            folders.join(", ")
        ))
    })
}

/// Reason for which a run cannot start or go on, with the place in the scene where there is one.
fn told(places: &SourceMap, error: &RunError) -> String {
    match error {
        RunError::Setup(error) => places.of_setup(error),
        RunError::Step(error) => places.of_step(error),
        RunError::Refused(problem) => places.of_problem(problem),
        RunError::Checkpoint(_)
        | RunError::Output(_)
        | RunError::SharingRefusal(_)
        | RunError::OtherRank { .. } => format!("{}: {error}", places.name()),
    }
}

/// Runs from output time to output time; returns why it ended early, if it failed.
fn drive(
    run: &mut KernelRun,
    tally: &mut Tally,
    ranks: Option<&dyn Ranks>,
    interrupt: &Interrupt,
) -> Option<RunError> {
    let name = run.simulation().scene().name.clone();
    let end = run.simulation().scene().time;
    let mut progress = Progress::new(&name);
    while let Some(stop) = run.next_stop() {
        let (before, particles) = (run.simulation().steps(), run.simulation().particles());
        let messages_before = ranks.map(Ranks::message_time);
        let (stopwatch, bounds) = (&mut tally.stopwatch, &mut tally.bounds);
        let advanced = stopwatch.time(|| {
            run.advance(stop, |info: &StepInfo| {
                *bounds.entry(bound_words(info.bound)).or_default() += 1;
                progress.at(info.time / end);
                if interrupt.raised() {
                    RunControl::Stop
                } else {
                    RunControl::On
                }
            })
        });
        if let Some((ranks, before)) = ranks.zip(messages_before) {
            let spent = ranks.message_time().saturating_sub(before);
            *tally.messages.get_or_insert_default() += spent;
        }
        tally.particle_steps += particles as f64 * (run.simulation().steps() - before) as f64;
        if let Err(error) = advanced {
            return Some(error);
        }
        if run.is_interrupted() {
            return None;
        }
        if let Err(error) = run.write() {
            return Some(error);
        }
    }
    None
}

/// Writes the summary where there is a folder; says so and returns false if it cannot be written.
fn save(summary: &Summary, folder: Option<&OutputFolder>) -> bool {
    let Some(folder) = folder else { return true };
    match summary.write(&folder.file(SUMMARY)) {
        Ok(()) => true,
        Err(error) => {
            say!("{error}");
            false
        }
    }
}

pub(super) fn bound_words(bound: Bound) -> &'static str {
    match bound {
        Bound::Stability => "by the stability bound",
        Bound::Travel => "so that nothing crosses half a cell",
        Bound::Multiplier => "by the scene's multiplier",
        Bound::Contact => "by the stiffness of the contact",
        Bound::Closing => "so that no gap closes by more than half the critical gap",
        Bound::Viscosity => "by viscosity beside the stability bound",
        Bound::Damping => "by damping beside the stability bound",
        Bound::Fixed => "constant, by the scene",
        Bound::OutputTime => "shortened so that frames fall on their times",
    }
}
