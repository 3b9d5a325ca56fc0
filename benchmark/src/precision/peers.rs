//! Other solvers on the problem of a case, beside the methods of this program.

use super::choices::Effort;
use super::cost::{At, Cost, cost};
use super::findings::LEVELS;
use super::problems::keep_fields;
use super::run::{LONG, USELESS};
use crate::bench::children::{Calibration, GuestScene, OWN, calibrate, is_endless, is_skip, own};
use crate::bench::config::Executable;
use crate::measure::Spent;
use crate::record::{Row, key};
use proctor_verification::case::Rung;
use proctor_verification::convergence::{self, ConvergenceTable};
use proctor_verification::study::Study;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Dimensions of all problems that other solvers get.
pub(crate) const AXES: usize = 3;

/// An executable, and what its calibration said.
pub struct Peer {
    /// The executable.
    pub executable: Executable,
    /// Calibration of its frames, or the reason for which it is not to be trusted.
    pub calibration: Result<Calibration, String>,
}

/// The runs of one executable on the path of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct PeerLine {
    /// Name of the executable.
    pub name: String,
    /// Its method, where its configuration says it.
    pub method: Option<String>,
    /// Its runs, coarse to fine.
    pub runs: Vec<PeerRun>,
}

/// A run of an executable.
#[derive(Clone, Debug, PartialEq)]
pub struct PeerRun {
    /// Resolution.
    pub rung: Rung,
    /// Time of the whole process, one per repetition.
    pub samples: Vec<Spent>,
    /// Number of particles in its last frame.
    pub particles: Option<usize>,
    /// Relative error of the first measure of the study, or why there is none.
    pub error: Result<f64, String>,
}

impl PeerRun {
    /// Time of the fastest repetition \[s\]: on the processors with one thread, by the clock with several, as that of
    /// methods.
    #[must_use]
    pub fn seconds(&self, threads: usize) -> Option<f64> {
        let time = |spent: &Spent| if threads == 1 { spent.cpu } else { spent.wall };
        let fastest = self.samples.iter().map(time).min();
        fastest.map(|time| time.as_secs_f64())
    }

    /// Error and time, where there are both.
    #[must_use]
    pub fn at(&self, threads: usize) -> Option<At> {
        Some(At {
            error: *self.error.as_ref().ok()?,
            time: self.seconds(threads)?,
        })
    }
}

impl PeerLine {
    /// True where a finer run would take too long, or end as the last one did.
    fn is_done(&self, longest: Option<Duration>) -> bool {
        self.runs.last().is_some_and(|run| {
            let hopeless = |reason: &String| is_skip(reason) || is_endless(reason);
            let took = run.samples.iter().map(|spent| spent.wall).max();
            run.error.as_ref().err().is_some_and(hopeless)
                || longest.is_some_and(|longest| took > Some(longest))
        })
    }

    /// Cost of each of [`LEVELS`] along the line.
    #[must_use]
    pub fn costs(&self, threads: usize) -> [Cost; 2] {
        let line: Vec<Option<At>> = self.runs.iter().map(|run| run.at(threads)).collect();
        LEVELS.map(|level| cost(&line, level))
    }

    /// Errors along the path; NaN where a run failed.
    #[must_use]
    pub fn convergence(&self) -> ConvergenceTable {
        let mut table = ConvergenceTable::new(["error"]);
        for run in &self.runs {
            // One error in a table of one quantity, by construction.
            let _ = table.push(convergence::Row {
                h: run.rung.cell,
                errors: vec![run.error.as_ref().map_or(f64::NAN, |error| *error)],
                particles: run.particles.unwrap_or(0),
                steps: 0,
            });
        }
        table
    }

    /// Order of the error between the two finest runs.
    #[must_use]
    pub fn order(&self) -> Option<f64> {
        let [.., coarse, fine] = self.runs.as_slice() else {
            return None;
        };
        let error = |run: &PeerRun| run.error.as_ref().ok().copied();
        let (coarse_error, fine_error) = (error(coarse)?, error(fine)?);
        let order = (coarse_error / fine_error).ln() / (coarse.rung.cell / fine.rung.cell).ln();
        order.is_finite().then_some(order)
    }
}

/// Least order of an error that falls, and the error below which a solver is near its answer whatever its order.
const FALLS: f64 = 0.3;
const NEAR: f64 = 0.05;

/// A hint for a solver whose error on its finest mesh is large and does not fall with the cells.
#[must_use]
pub fn stays(order: Option<f64>, error: f64) -> Option<&'static str> {
    (error > NEAR && order.is_some_and(|order| order < FALLS)).then_some(
        "its error does not fall with the cells: it solves another problem, or a word of the scene does not act",
    )
}

/// Calibrates this program and each executable by the free fall, and adds a row for each to `rows`.
pub fn calibrated(
    executables: Vec<Executable>,
    threads: usize,
    folder: &Path,
    stop: &AtomicBool,
    rows: &mut Vec<Row>,
) -> Vec<Peer> {
    own()
        .into_iter()
        .chain(executables)
        .map_while(|executable| {
            let (row, calibration) = calibrate(&executable, AXES, threads, folder, stop);
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            rows.push(row);
            Some(Peer {
                executable,
                calibration: calibration.map_err(|fault| fault.to_string()),
            })
        })
        .collect()
}

/// Runs a study's problem with every executable on its path, this program first. A run that fails does not end it; an
/// interrupt does.
///
/// # Errors
/// If other solvers cannot run it.
pub fn run(
    study: Study,
    peers: &[Peer],
    effort: Effort,
    threads: usize,
    folder: &Path,
    stop: &AtomicBool,
) -> Result<Vec<PeerLine>, String> {
    let visit = Visit {
        effort,
        longest: None,
        threads,
        folder,
        stop,
    };
    run_as(study, peers, &visit)
}

/// Options of a run of executables.
#[derive(Clone, Copy)]
pub struct Visit<'a> {
    /// Path of refinement and repetitions.
    pub effort: Effort,
    /// Time by the clock after which an executable gets no finer run.
    pub longest: Option<Duration>,
    /// Threads of each run.
    pub threads: usize,
    /// Folder of scenes and results.
    pub folder: &'a Path,
    /// Raised where the user stops.
    pub stop: &'a AtomicBool,
}

/// Runs a study as [`run`], as a visit says.
///
/// # Errors
/// If other solvers cannot run it.
pub fn run_as(study: Study, peers: &[Peer], visit: &Visit<'_>) -> Result<Vec<PeerLine>, String> {
    let Visit {
        effort,
        longest,
        threads,
        folder,
        stop,
    } = *visit;
    let mut lines: Vec<PeerLine> = peers
        .iter()
        .map(|peer| PeerLine {
            name: peer.executable.name.clone(),
            method: peer.executable.method.clone(),
            runs: vec![],
        })
        .collect();
    for rung in study.path(effort.size) {
        let guest = match study.guest(&rung) {
            Ok(guest) => guest,
            // Meshes that no scene file holds end the path; where there is none at all the case is closed.
            Err(_) if lines.iter().any(|line| !line.runs.is_empty()) => break,
            Err(reason) => return Err(reason.to_owned()),
        };
        let handed = GuestScene::new(&guest)?;
        let folder = folder.join(study.name()).join(key(&rung.label));
        let mut due = None;
        for (peer, line) in peers.iter().zip(&mut lines) {
            if line.is_done(longest) {
                continue;
            }
            let mut run = PeerRun {
                rung: rung.clone(),
                samples: vec![],
                particles: None,
                error: Err(String::new()),
            };
            match &peer.calibration {
                Err(fault) => run.error = Err(fault.clone()),
                Ok(calibration) => {
                    run.error = timed(&handed, &peer.executable, effort, threads, &folder, stop)
                        .and_then(|samples| {
                            run.samples = samples;
                            handed.snapshots(&guest, &peer.executable, calibration, &folder)
                        })
                        .and_then(|frames| {
                            run.particles = frames.last().map(|frame| frame.starts.len());
                            let own = peer.executable.name == OWN;
                            due = due.or(run.particles.filter(|_| own));
                            as_many(run.particles, due)?;
                            if let Some(last) = frames.last() {
                                let name =
                                    format!("{}-against-exact.vtu", key(&peer.executable.name));
                                keep_fields(&guest, last, &folder.join(name))?;
                            }
                            guest.error(&frames)
                        })
                        .and_then(useful);
                }
            }
            if stop.load(Ordering::Relaxed) {
                return Ok(lines);
            }
            line.runs.push(run);
        }
    }
    Ok(lines)
}

/// The repetitions of a run.
fn timed(
    handed: &GuestScene,
    executable: &Executable,
    effort: Effort,
    threads: usize,
    folder: &Path,
    stop: &AtomicBool,
) -> Result<Vec<Spent>, String> {
    handed.warm_up(executable, threads, folder, stop)?;
    let mut samples: Vec<Spent> = vec![];
    while samples.len() < effort.repetitions.max(1) && !stop.load(Ordering::Relaxed) {
        let spent = handed.run(executable, threads, folder, stop)?;
        samples.push(spent);
        if spent.wall > LONG {
            break;
        }
    }
    Ok(samples)
}

/// Another number of particles is another problem.
fn as_many(found: Option<usize>, due: Option<usize>) -> Result<(), String> {
    match (found, due) {
        (Some(found), Some(due)) if found != due => Err(format!(
            "{found} particles where {OWN} has {due} in the same scene"
        )),
        _ => Ok(()),
    }
}

fn useful(error: f64) -> Result<f64, String> {
    if error <= USELESS {
        Ok(error)
    } else {
        Err(format!("relative error {error:.1e}"))
    }
}
