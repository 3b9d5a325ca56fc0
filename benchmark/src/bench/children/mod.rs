//! Executables that run scenes: this program, others of other commits, and any other solver.
//!
//! A solver gets the scene as a JSON file and leaves `.vtu` frames in a folder. Its time is that of its whole process,
//! by the clock and on the processors, set-up and output included; that holds for this program too, which is run as
//! one of them. Its error is measured on its last frame, at the time that its particles have by what the configuration
//! says of its labels; a free fall finds out before whether that is so (`calibrate`).

mod calibration;
mod compare;
mod finding;
mod process;
pub mod said;
mod visit;
mod watch;
mod words;
pub mod written;

pub use calibration::{Calibration, Fault, judge, scene as free_fall};
pub use compare::{difference, error, same_time};
pub use finding::Finding;
pub use process::{SCRATCH, is_endless, is_skip};
pub(crate) use visit::GuestScene;
pub use words::{Word, is_word_fault};

use super::config::{Config, Executable, Space, TimeLabel, proctor_command};
use super::plan::words as words_of;
use super::scenes::{Exact, Made};
use crate::frames::{self, Frame};
use crate::record::Row;
use proctor_scene::{SceneError, TimeStep};
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use written::written;

/// Name of this program among the executables.
pub const OWN: &str = "proctor";

/// A scene that executables run.
pub struct Job {
    /// Name of scene, number of particles and method, as a path.
    pub key: String,
    /// The scene's name.
    pub scene: String,
    /// Weighting function, stress scheme and transfer.
    pub method: [String; 3],
    /// Number of axes.
    pub axes: usize,
    json: Value,
    cell: f64,
    end: f64,
    step: f64,
    exact: Option<(&'static str, Exact)>,
}

/// One executable on one scene with a number of threads.
pub struct Child {
    /// The executable.
    pub executable: Executable,
    /// Job that it runs.
    pub job: Arc<Job>,
    /// Threads.
    pub threads: usize,
}

/// This program as one of the executables.
#[must_use]
pub fn own() -> Option<Executable> {
    let program = std::env::current_exe().ok()?;
    Some(Executable {
        name: OWN.into(),
        command: proctor_command(program.display().to_string()),
        folder: None,
        timeout: Executable::TIMEOUT,
        time_label: TimeLabel::Frame,
        warm_up: false,
        method: None,
        scene: Map::new(),
        space: Space::Slab(1),
    })
}

/// All runs of executables that a configuration asks for; those of one scene together, this program first.
///
/// # Errors
/// If a scene does not go with a method.
pub fn runs(config: &Config) -> Result<Vec<Child>, SceneError> {
    if config.executables.is_empty() {
        return Ok(vec![]);
    }
    let mut executables: Vec<Executable> = own().into_iter().collect();
    executables.extend(config.executables.iter().cloned());
    let mut children = vec![];
    for choice in &config.scenes {
        let counts = if choice.scales() {
            config.particles.as_slice()
        } else {
            &[0]
        };
        for &particles in counts {
            for method in &config.methods {
                let values = choice.scene(particles, method)?;
                let Made { scene, exact } = choice.make(particles, method);
                let json = written(scene, &values);
                let values = choice.checked(&json)?;
                let method = words_of(&values);
                let size = if choice.scales() {
                    format!("/{particles}")
                } else {
                    String::new()
                };
                let axes = values.dimension.axes();
                let job = Arc::new(Job {
                    key: format!("{}{size}/{}", choice.name(), method.join("/")),
                    scene: choice.name(),
                    method,
                    cell: values.mesh.cell[..axes]
                        .iter()
                        .copied()
                        .fold(f64::INFINITY, f64::min),
                    end: values.time,
                    step: match values.time_step {
                        TimeStep::Fixed { dt, .. } => dt,
                        // A scene that cannot be set up; its runs say why.
                        TimeStep::Automatic | TimeStep::Multiplier { .. } => values.time,
                    },
                    axes,
                    json,
                    exact,
                });
                for &threads in &config.threads {
                    for executable in &executables {
                        children.push(Child {
                            executable: executable.clone(),
                            job: Arc::clone(&job),
                            threads,
                        });
                    }
                }
            }
        }
    }
    Ok(children)
}

/// Runs the free fall with an executable: the row of the calibration, and its findings or the reason for which it is not to be
/// trusted.
pub(crate) fn calibrate(
    executable: &Executable,
    axes: usize,
    threads: usize,
    folder: &Path,
    stop: &AtomicBool,
) -> (Row, Result<Calibration, Fault>) {
    let name = format!("{}/calibration-{axes}d/threads:{threads}", executable.name);
    let mut row = Row::sample(name, 0, threads);
    row.label("executable", executable.name.clone());
    row.label("scene", format!("calibration-{axes}d"));
    row.label("stage", "calibration");
    row.label("time_label", executable.time_label.word());
    if let Some(method) = &executable.method {
        row.label("method", method.clone());
    }
    match calibration::calibrate(executable, axes, threads, folder, stop) {
        Ok((finished, calibration)) => {
            let mut row = row.timed(finished.spent);
            if let Some(ahead) = calibration.velocity_ahead {
                row.count("velocity_ahead_steps", ahead);
            }
            (row, Ok(calibration))
        }
        Err(fault) => {
            row.fail(fault.to_string());
            (row, Err(fault))
        }
    }
}

impl Job {
    /// Source of its exact solution, if it has one.
    #[must_use]
    pub fn exact_source(&self) -> Option<&'static str> {
        self.exact.as_ref().map(|(source, _)| *source)
    }
}

impl Child {
    /// Name in a record.
    #[must_use]
    pub fn name(&self) -> String {
        let Self {
            executable,
            job,
            threads,
        } = self;
        format!("{}/{}/threads:{threads}", executable.name, job.key)
    }

    /// Folder for its results.
    fn out(&self, folder: &Path, executable: &str) -> PathBuf {
        let leaf = format!(
            "{}-threads-{}",
            crate::record::key(executable),
            self.threads
        );
        folder.join(&self.job.key).join(leaf)
    }

    /// A row without results.
    fn blank(&self, repetition: u64) -> Row {
        let mut row = Row::sample(self.name(), repetition, self.threads);
        row.label("executable", self.executable.name.clone());
        row.label("scene", self.job.scene.clone());
        row.label("stage", "process");
        for (key, word) in ["shape_function", "stress_scheme_update", "transfer"]
            .into_iter()
            .zip(&self.job.method)
        {
            row.label(key, word.clone());
        }
        row
    }

    /// Runs it once; a run that fails is a row with the reason and the last that the program said.
    #[must_use]
    pub fn run(&self, repetition: u64, folder: &Path, stop: &AtomicBool) -> Row {
        let mut row = self.blank(repetition);
        let out = self.out(folder, &self.executable.name);
        match self.try_run(row.clone(), &out, folder, stop) {
            Ok(row) => row,
            Err(reason) => {
                row.fail(said::with_words(&reason, &out));
                row
            }
        }
    }

    /// The row of a run that is not made, as its executable is not to be trusted.
    #[must_use]
    pub fn not_run(&self, repetition: u64, reason: &str) -> Row {
        let mut row = self.blank(repetition);
        row.fail(reason);
        row
    }

    fn try_run(
        &self,
        row: Row,
        out: &Path,
        folder: &Path,
        stop: &AtomicBool,
    ) -> Result<Row, String> {
        let job = &self.job;
        let scene = folder.join(&job.key).join(self.executable.scene_file());
        process::prepare(out, &scene, &self.executable.given(&job.json))?;
        let finished = process::run(&self.executable, &scene, self.threads, out, stop)?;
        let mut row = row.timed(finished.spent);
        if let Some(peak) = finished.peak_rss {
            row.count("peak_rss_bytes", peak as f64);
        }
        let frame = self.last_frame(out)?;
        let time = frame.time.unwrap_or(job.end);
        row.count("particles", frame.points.len() as f64);
        row.count("time", time);
        process::take_summary(out, frame.points.len(), &mut row);
        let own = self.executable.name == OWN;
        if let Some((source, exact)) = &job.exact {
            row.label("error_against", *source);
            row.count("error_l2_displacement", error(&frame, exact, time)?);
        } else if !own {
            row.label("error_against", OWN);
        }
        let reference = self.out(folder, OWN);
        if !own && frames::last(&reference).is_some() {
            let reference = last_frame(&reference, TimeLabel::Frame, job.step, job.end)?;
            let comparable = same_time(&frame, &reference, job.step);
            match (comparable, &job.exact) {
                // There is an error without it.
                (Err(reason), Some(_)) => row.label(REFUSED, reason),
                _ => row.count(
                    "difference_l2_displacement",
                    difference(&frame, &reference, job.cell, job.step)?,
                ),
            }
        }
        Ok(row)
    }

    fn last_frame(&self, out: &Path) -> Result<Frame, String> {
        last_frame(out, self.executable.time_label, self.job.step, self.job.end)
    }
}

/// Label of a row that says why its frame was not compared with that of this program.
pub(super) const REFUSED: &str = "difference_refused";

/// The last frame of a folder, with the time of its particles: its label, or the end of the scene (s) where it has none, and
/// what the label means for steps of `step` (s).
fn last_frame(out: &Path, label: TimeLabel, step: f64, end: f64) -> Result<Frame, String> {
    let (file, said) = frames::last(out).ok_or_else(|| calibration::no_frame(out))?;
    let mut frame = frames::read(&file)?;
    let time = said.or(frame.time).unwrap_or(end);
    frame.time = Some(time + label.ahead() * step);
    Ok(frame)
}
