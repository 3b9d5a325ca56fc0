//! Executables that run scenes: this program, others of other commits, and any other solver.
//!
//! A solver gets the scene as a JSON file and leaves `.vtu` frames in a folder. Its time is that of its whole process,
//! by the clock and on the processors, set-up and output included; that holds for this program too, which is run as
//! one of them. Its error is measured on its last frame.

mod compare;
mod process;
mod watch;

pub use compare::{difference, error};

use super::config::{Config, Executable};
use super::plan::words;
use super::scenes::{Exact, Made};
use crate::frames;
use crate::record::Row;
use proctor_files::json::from_json;
use proctor_kernel::scene::SceneError;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

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
    json: Value,
    cell: f64,
    end: f64,
    exact: Option<(&'static str, Exact)>,
}

/// One executable on one scene with a number of threads.
pub struct Child {
    /// The executable.
    pub executable: Executable,
    /// What it runs.
    pub job: Arc<Job>,
    /// Threads.
    pub threads: usize,
}

/// All runs of executables that a configuration asks for; those of one scene together, this program first.
///
/// # Errors
/// If a scene does not go with a method.
pub fn runs(config: &Config) -> Result<Vec<Child>, SceneError> {
    if config.executables.is_empty() {
        return Ok(vec![]);
    }
    let mut executables: Vec<Executable> = vec![];
    if let Ok(program) = std::env::current_exe() {
        let arguments = ["run", "{scene}", "--out", "{out}", "--threads", "{threads}"];
        let mut command = vec![program.display().to_string()];
        command.extend(arguments.map(str::to_owned));
        executables.push(Executable {
            name: OWN.into(),
            command,
            folder: None,
            timeout: Executable::TIMEOUT,
        });
    }
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
                let Made { mut scene, exact } = choice.make(particles, method);
                if values.results.print == 0 {
                    scene["results"]["print"] = 1.into();
                }
                let method = words(&values);
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
                    json: scene,
                    exact,
                });
                from_json(&job.json.to_string(), &job.scene, Path::new(""))?;
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

impl Job {
    /// Where its exact solution comes from, if it has one.
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

    /// Runs it once; a run that fails is a row with the reason.
    #[must_use]
    pub fn run(&self, repetition: u64, folder: &Path, stop: &AtomicBool) -> Row {
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
        match self.try_run(row.clone(), folder, stop) {
            Ok(row) => row,
            Err(reason) => {
                row.fail(reason);
                row
            }
        }
    }

    fn try_run(&self, row: Row, folder: &Path, stop: &AtomicBool) -> Result<Row, String> {
        let out = self.out(folder, &self.executable.name);
        let scene = folder.join(&self.job.key).join("scene.json");
        process::prepare(&out, &scene, &self.job.json)?;
        let finished = process::run(&self.executable, &scene, self.threads, &out, stop)?;
        let mut row = row.timed(finished.spent);
        if let Some(peak) = finished.peak_rss {
            row.count("peak_rss_bytes", peak as f64);
        }
        let (file, said) =
            frames::last(&out).ok_or_else(|| format!("no .vtu frame below {}", out.display()))?;
        let frame = frames::read(&file)?;
        let time = said.or(frame.time).unwrap_or(self.job.end);
        row.count("particles", frame.points.len() as f64);
        row.count("time", time);
        process::take_summary(&out, frame.points.len(), &mut row);
        let own = self.executable.name == OWN;
        if let Some((source, exact)) = &self.job.exact {
            row.label("error_against", *source);
            row.count("error_l2_displacement", error(&frame, exact, time)?);
        } else if !own {
            row.label("error_against", OWN);
        }
        if !own && let Some((reference, _)) = frames::last(&self.out(folder, OWN)) {
            let reference = frames::read(&reference)?;
            let difference = difference(&frame, &reference, self.job.cell)?;
            row.count("difference_l2_displacement", difference);
        }
        Ok(row)
    }
}
