//! Other solvers on the problem of a case, beside the methods of this program.

use super::choices::Effort;
use super::cost::{At, Cost, cost};
use super::findings::LEVELS;
use super::forms::ProblemForms;
use super::problems::keep_fields;
use super::run::{LONG, USELESS};
use crate::bench::children::{
    Calibration, GuestScene, OWN, Word, calibrate, is_endless, is_skip, is_word_fault, own,
};
use crate::bench::config::Executable;
use crate::measure::Spent;
use crate::record::{Row, key};
use proctor_scene::Scene;
use proctor_verification::case::{Rung, Size};
use proctor_verification::convergence::{self, ConvergenceTable};
use proctor_verification::guest::ReadValue;
use proctor_verification::study::Study;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// An executable, and what its calibration said.
#[derive(Clone)]
pub struct Peer {
    /// The executable.
    pub executable: Executable,
    /// Calibration of its frames, or the reason for which it is not to be trusted.
    pub calibration: Result<Calibration, String>,
    /// Words of scenes that do not act in it, each with the reason.
    pub faults: BTreeMap<Word, String>,
}

impl Peer {
    /// A peer whose calibration passed has the problems of some words run too; this program knows them.
    #[must_use]
    pub fn new(
        executable: Executable,
        calibration: Result<Calibration, String>,
        words: &[Word],
        visit: &Visit<'_>,
    ) -> Self {
        let tried = calibration.is_ok() && !executable.is_own();
        let mut faults = BTreeMap::new();
        for &word in words.iter().filter(|_| tried) {
            let fault = word.fault(&executable, visit.threads, visit.folder, visit.stop);
            faults.extend(fault.map(|fault| (word, fault)));
        }
        Self {
            executable,
            calibration,
            faults,
        }
    }

    /// Its calibration, or the reason for which it is not given a scene: a failed calibration, or that of a word of the scene.
    fn trusted(&self, scene: &Scene) -> Result<&Calibration, String> {
        let calibration = self.calibration.as_ref().map_err(Clone::clone)?;
        let fault = Word::of(scene)
            .into_iter()
            .find_map(|word| self.faults.get(&word));
        fault.map_or(Ok(calibration), |fault| Err(fault.clone()))
    }
}

/// Words that the first runs of studies use.
#[must_use]
pub fn words(studies: &[Study], size: Size) -> Vec<Word> {
    let firsts = studies
        .iter()
        .filter_map(|study| study.guest(study.path(size).first()?).ok());
    let mut all: Vec<Word> = firsts.flat_map(|guest| Word::of(&guest.scene)).collect();
    all.sort_unstable();
    all.dedup();
    all
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
    /// Reason for which it is not given the case.
    pub left_out: Option<&'static str>,
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
    /// Relative error of the stress, where the case has one and its frames hold stresses.
    pub stress: Option<f64>,
    /// Its report, where the case is open as one.
    pub reported: Option<ReadValue>,
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
    /// The line with the error of the stress in the place of the first one; none where no frame held stresses.
    #[must_use]
    pub fn of_stress(&self) -> Option<Self> {
        let missing = || "its frames hold no stresses".to_owned();
        let mut line = self.clone();
        for run in &mut line.runs {
            run.error = run.stress.ok_or_else(missing);
        }
        let held = self.runs.iter().any(|run| run.stress.is_some());
        held.then_some(line)
    }

    /// True where a finer run would take too long, or end as the last one did.
    fn is_done(&self, longest: Option<Duration>) -> bool {
        self.runs.last().is_some_and(|run| {
            let hopeless =
                |reason: &String| is_skip(reason) || is_endless(reason) || is_word_fault(reason);
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

/// Reason for which a solver of two dimensions does not get a case.
const NOT_IN_PLANE: &str = "a problem in three dimensions, and its `dimension` is 2";

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

/// Calibrates this program and each executable by the free fall and the problems of words, and adds a row of the fall for each
/// to `rows`.
pub fn calibrated(
    executables: Vec<Executable>,
    words: &[Word],
    visit: &Visit<'_>,
    rows: &mut Vec<Row>,
) -> Vec<Peer> {
    let Visit {
        threads,
        folder,
        stop,
        ..
    } = *visit;
    own()
        .into_iter()
        .chain(executables)
        .map_while(|executable| {
            let axes = executable.space.axes();
            let (row, calibration) = calibrate(&executable, axes, threads, folder, stop);
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            rows.push(row);
            let calibration = calibration.map_err(|fault| fault.to_string());
            Some(Peer::new(executable, calibration, words, visit))
        })
        .collect()
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

/// Runs a study's problem with every executable on its path, this program first. A run that fails does not end it; an
/// interrupt does.
///
/// # Errors
/// If other solvers cannot run it.
pub fn run(study: Study, peers: &[Peer], visit: &Visit<'_>) -> Result<Vec<PeerLine>, String> {
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
            left_out: None,
        })
        .collect();
    for rung in study.path(effort.size) {
        let guest = match study.guest(&rung) {
            Ok(guest) => guest,
            // Meshes that no scene file holds end the path; where there is none at all the case is closed.
            Err(_) if lines.iter().any(|line| !line.runs.is_empty()) => break,
            Err(reason) => return Err(reason.to_owned()),
        };
        let forms = ProblemForms::new(study, &rung, guest, peers)?;
        let folder = folder.join(study.name()).join(key(&rung.label));
        let mut due = None;
        for (peer, line) in peers.iter().zip(&mut lines) {
            if line.is_done(longest) {
                continue;
            }
            let Some(form) = forms.of(peer.executable.space) else {
                line.left_out = Some(NOT_IN_PLANE);
                continue;
            };
            let (guest, handed) = (&form.guest, &form.handed);
            let folder = form.folder(&folder);
            let mut run = PeerRun {
                rung: rung.clone(),
                samples: vec![],
                particles: None,
                error: Err(String::new()),
                stress: None,
                reported: None,
            };
            match peer.trusted(&guest.scene) {
                Err(fault) => run.error = Err(fault),
                Ok(calibration) => {
                    run.error = timed(handed, &peer.executable, effort, threads, &folder, stop)
                        .and_then(|samples| {
                            run.samples = samples;
                            handed.snapshots(guest, &peer.executable, calibration, &folder)
                        })
                        .and_then(|frames| {
                            run.particles = frames.last().map(|frame| frame.starts.len());
                            let own = peer.executable.name == OWN;
                            due = due.or(run.particles.filter(|_| own));
                            as_many(run.particles, due.map(|due| form.particles(due)))?;
                            if let Some(reading) = &guest.reading {
                                let reported = reading.of(&frames)?;
                                let off = reported.off();
                                run.reported = Some(reported);
                                return Ok(off);
                            }
                            if let Some(last) = frames.last() {
                                let name =
                                    format!("{}-against-exact.vtu", key(&peer.executable.name));
                                keep_fields(guest, last, &folder.join(name))?;
                            }
                            run.stress = guest.stress_error(&frames);
                            guest.error(&frames).and_then(useful)
                        });
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
