//! The runs of a study, timed phase by phase.

use super::choices::{Choice, Effort, Plan};
use super::peers::PeerLine;
use crate::measure::{ProcessorClock, Spent};
use crate::show::percent;
use proctor_scene::simulation::Options;
use proctor_verification::case::Size;
use proctor_verification::study::{Observer, Phase, Study};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Run time above which a point is run once: its noise is small beside it.
pub(super) const LONG: Duration = Duration::from_secs(2);
/// Relative error above which a result says less than no answer at all would, so that the run counts as failed.
pub const USELESS: f64 = 1.0;

/// Word of the error of the stress among those of a study.
pub(super) const STRESS: &str = "stress";

/// Word for a run that did not take place.
const NOT_RUN: &str = "not run";

/// A case that was studied.
pub struct CaseStudy {
    /// The case.
    pub study: Study,
    /// Plan of the run.
    pub plan: Plan,
    /// One run per choice of the plan; fewer where the user stopped it.
    pub runs: Vec<Run>,
    /// Threads of every run.
    pub threads: usize,
    /// Other solvers on the problem of the case; none where none was asked for.
    pub peers: Vec<PeerLine>,
    /// Reason for which other solvers cannot run it, where they were asked for.
    pub no_peers: Option<String>,
}

impl CaseStudy {
    /// Lines of other solvers for an error of the study: all for the first, for that of the stress those whose frames
    /// hold stresses.
    #[must_use]
    pub fn peers_of(&self, measure: usize) -> Vec<PeerLine> {
        match self.study.measures().get(measure).map(|m| m.word) {
            _ if measure == 0 => self.peers.clone(),
            Some(STRESS) => self.peers.iter().filter_map(PeerLine::of_stress).collect(),
            _ => vec![],
        }
    }

    /// Run time of a run by its number \[s\]: the stepping loop of the fastest repetition. On one thread it is the time
    /// on the processor, which other work on the machine does not lengthen; on several, by the clock.
    #[must_use]
    pub fn seconds(&self, run: usize) -> Option<f64> {
        let on_processor = self.threads == 1;
        let time = |s: &Sample| {
            if on_processor {
                s.stepping.cpu
            } else {
                s.stepping.wall
            }
        };
        Some(self.runs.get(run)?.minimum_and_median(time)?[0])
    }

    /// The measure of [`CaseStudy::seconds`], in words.
    #[must_use]
    pub fn seconds_words(&self) -> &'static str {
        if self.threads == 1 {
            "processor time of the stepping loop, fastest run"
        } else {
            "wall time of the stepping loop, fastest run"
        }
    }
}

/// A choice that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// One sample per repetition.
    pub samples: Vec<Sample>,
    /// Numbers of the run, the same in every repetition; or its failure.
    pub found: Result<RunNumbers, String>,
}

/// Times of one repetition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sample {
    /// The stepping loop.
    pub stepping: Spent,
    /// Time before the run.
    pub set_up: Spent,
    /// Comparison with the exact solution.
    pub comparing: Spent,
}

/// Counts and errors of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunNumbers {
    /// Number of particles.
    pub particles: usize,
    /// Number of steps.
    pub steps: u64,
    /// Largest time step \[s\].
    pub dt: f64,
    /// The same over the kernel's critical one.
    pub dt_over_critical: f64,
    /// Relative errors, one per measure of the study.
    pub errors: Vec<f64>,
}

impl Run {
    /// The error of a measure, or why there is none worth the name.
    ///
    /// # Errors
    /// The reason: of the run, or that the error is not finite or above [`USELESS`].
    pub fn error(&self, measure: usize) -> Result<f64, String> {
        let found = self.found.as_ref().map_err(Clone::clone)?;
        let error = found.errors.get(measure).copied().unwrap_or(f64::NAN);
        if error <= USELESS {
            Ok(error)
        } else {
            let size = if error.is_finite() {
                percent(error)
            } else {
                error.to_string()
            };
            Err(format!("unstable or not converging: an error of {size}"))
        }
    }

    /// Smallest and median of the repetitions of a time \[s\], with the mean of the middle two where they are even.
    #[must_use]
    pub fn minimum_and_median(&self, time: impl Fn(&Sample) -> Duration) -> Option<[f64; 2]> {
        minimum_and_median(self.samples.iter().map(time))
    }
}

/// Smallest and median of times \[s\], with the mean of the middle two where they are even.
pub(super) fn minimum_and_median(times: impl Iterator<Item = Duration>) -> Option<[f64; 2]> {
    let mut times: Vec<f64> = times.map(|time| time.as_secs_f64()).collect();
    times.sort_by(f64::total_cmp);
    let count = times.len();
    let median = 0.5 * (times.get(count / 2)? + times.get((count - 1) / 2)?);
    Some([*times.first()?, median])
}

/// Both clocks, begun for work of so many threads.
fn now(threads: usize) -> (Instant, ProcessorClock) {
    (Instant::now(), ProcessorClock::of_threads(threads))
}

/// Adds the times of the phases up, shows progress, and passes an interrupt on.
struct Watch<'a> {
    sample: Sample,
    phase: Phase,
    since: (Instant, ProcessorClock),
    threads: usize,
    progress: &'a mut dyn FnMut(f64),
    /// Share of the study that was done before this run, and the share that it is.
    share: [f64; 2],
    interrupt: &'a AtomicBool,
}

impl Watch<'_> {
    /// Books the time since the last phase began.
    fn close(&mut self) {
        let spent = match self.phase {
            Phase::SetUp => &mut self.sample.set_up,
            Phase::Stepping => &mut self.sample.stepping,
            Phase::Comparing => &mut self.sample.comparing,
        };
        spent.wall += self.since.0.elapsed();
        spent.cpu += self.since.1.elapsed();
    }
}

impl Observer for Watch<'_> {
    fn phase(&mut self, phase: Phase) {
        self.close();
        self.phase = phase;
        self.since = now(self.threads);
    }

    fn progress(&mut self, share: f64) {
        (self.progress)(self.share[0] + share * self.share[1]);
    }

    fn stop(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }
}

/// Runs a study. A run that fails does not end it, but in a short one a method that failed is not run on finer cells; an
/// interrupt does, and the run in progress is left out. `progress` hears
/// the share that is done.
pub fn run(
    study: Study,
    effort: Effort,
    options: &Options,
    interrupt: &AtomicBool,
    progress: &mut dyn FnMut(f64),
) -> CaseStudy {
    let plan = Plan::new(study, effort);
    let count = plan.choices.len().max(1) as f64;
    let mut runs = vec![];
    for (i, choice) in plan.choices.iter().enumerate() {
        let share = [i as f64 / count, 1.0 / count];
        let short = effort.size == Size::Quick;
        if let Some(reason) = failed_before(&plan, &runs, i).filter(|_| short) {
            runs.push(Run {
                samples: vec![],
                found: Err(reason),
            });
            continue;
        }
        match point(study, choice, effort, options, interrupt, progress, share) {
            Some(run) => runs.push(run),
            None => break,
        }
    }
    CaseStudy {
        study,
        plan,
        runs,
        threads: options.threads.unwrap_or(1),
        peers: vec![],
        no_peers: None,
    }
}

/// Failure of the run before on the path of refinement, if it failed: on finer cells it would take longer to fail.
fn failed_before(plan: &Plan, runs: &[Run], choice: usize) -> Option<String> {
    let before = plan.lines.iter().find_map(|line| {
        let at = line.path.iter().position(|&i| i == choice)?;
        line.path.get(at.checked_sub(1)?)
    })?;
    let reason = runs.get(*before)?.found.as_ref().err()?;
    if reason.starts_with(NOT_RUN) {
        return Some(reason.clone());
    }
    let cell = plan.choices[*before].rung.cell;
    Some(format!("{NOT_RUN}: with h = {cell} {reason}"))
}

/// The repetitions of one choice; `None` if they were interrupted.
fn point(
    study: Study,
    choice: &Choice,
    effort: Effort,
    options: &Options,
    interrupt: &AtomicBool,
    progress: &mut dyn FnMut(f64),
    share: [f64; 2],
) -> Option<Run> {
    let mut run = Run {
        samples: vec![],
        found: Err(NOT_RUN.to_owned()),
    };
    let threads = options.threads.unwrap_or(1);
    while run.samples.len() < effort.repetitions.max(1) {
        let mut watch = Watch {
            sample: Sample::default(),
            phase: Phase::SetUp,
            since: now(threads),
            threads,
            progress,
            share,
            interrupt,
        };
        let solved = study.solve_with(&choice.rung, &choice.settings, options, &mut watch);
        watch.close();
        let sample = watch.sample;
        if interrupt.load(Ordering::Relaxed) {
            return None;
        }
        run.samples.push(sample);
        run.found = solved
            .map_err(|error| error.reason)
            .map(|studied| RunNumbers {
                particles: studied.solved.particles,
                steps: studied.solved.steps,
                dt: studied.dt,
                dt_over_critical: studied.dt / studied.dt_critical,
                errors: study
                    .measures()
                    .iter()
                    .map(|m| studied.solved.error(m.quantity))
                    .collect(),
            });
        if run.found.is_err() || sample.stepping.wall > LONG {
            break;
        }
    }
    Some(run)
}
