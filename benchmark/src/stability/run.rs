//! The runs of the stability map, as many side by side as there are processors.

use crate::measure::{Spent, Stopwatch};
use crate::side_by_side::side_by_side;
use proctor_scene::{Dimension, StressScheme};
use proctor_verification::case::{Gate, Size};
use proctor_verification::settings::Method;
use proctor_verification::stability::block::Choice;
use proctor_verification::stability::map::{self, Entry};
use proctor_verification::stability::nonlinear::{self, Limit, Nonlinear};
use proctor_verification::stability::round::{self, RoundChoice, RoundEntry};
use proctor_verification::stability::{StabilityError, table};
use std::convert::Infallible;

/// Amount of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapRequest {
    /// The plane with two particles per cell and axis, and the default method where nothing is linear: for the main job.
    Short,
    /// The plane; short runs where nothing is linear.
    Quick,
    /// Plane and space.
    Full,
    /// Parts of the kernel's table.
    Table,
}

/// One entry of the map, or a scene that is not linear with a method.
#[derive(Clone, Copy)]
pub enum Job {
    /// An entry of the map.
    Entry(Choice),
    /// A scene that is not linear.
    Nonlinear(&'static Nonlinear, Method, Size),
    /// Bodies about the axis of revolution.
    Round(RoundChoice),
}

/// Result of a job.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// An entry of the map.
    Entry(Box<Entry>),
    /// A limit.
    Nonlinear(Limit),
    /// Bodies about the axis of revolution.
    Round(RoundEntry),
}

/// A job that was done.
pub struct JobResult {
    /// Job that was run.
    pub job: Job,
    /// Result of the job.
    pub outcome: Result<Outcome, StabilityError>,
    /// Its time.
    pub spent: Spent,
}

impl Job {
    /// Its method.
    #[must_use]
    pub fn method(&self) -> Method {
        match self {
            Self::Entry(choice) => choice.method,
            Self::Nonlinear(_, method, _) => *method,
            Self::Round(choice) => choice.method,
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Entry(choice) => choice.name(),
            Self::Nonlinear(scene, method, _) => format!("{} {method}", scene.name),
            Self::Round(choice) => choice.name(),
        }
    }

    fn solve(self) -> Result<Outcome, StabilityError> {
        match self {
            Self::Entry(choice) => Ok(Outcome::Entry(Box::new(choice.solve()?))),
            Self::Nonlinear(scene, method, size) => {
                Ok(Outcome::Nonlinear(scene.solve(method, size)?))
            }
            Self::Round(choice) => Ok(Outcome::Round(choice.solve()?)),
        }
    }
}

impl JobResult {
    /// Gates of the result; none where it failed.
    #[must_use]
    pub fn gates(&self) -> Vec<Gate> {
        match (&self.job, &self.outcome) {
            (_, Ok(Outcome::Entry(entry))) => entry.gates(),
            (_, Ok(Outcome::Round(entry))) => entry.gates(),
            (Job::Nonlinear(scene, method, _), Ok(Outcome::Nonlinear(limit))) => {
                vec![scene.gate(*method, limit)]
            }
            _ => vec![],
        }
    }

    /// True if it could be done and all of it holds.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.outcome.is_ok() && self.gates().iter().all(Gate::passed)
    }
}

/// The jobs of what is asked: the map if `map` says so, and these scenes; of these schemes alone.
#[must_use]
pub fn jobs(
    asked: MapRequest,
    map: bool,
    scenes: &[&'static Nonlinear],
    schemes: &[StressScheme],
) -> Vec<Job> {
    let size = match asked {
        MapRequest::Short | MapRequest::Quick => Size::Quick,
        MapRequest::Full | MapRequest::Table => Size::Full,
    };
    let wanted = |choice: &Choice| match asked {
        MapRequest::Short => choice.particles_per_cell == 2,
        MapRequest::Quick | MapRequest::Full => true,
        MapRequest::Table => table::needs(choice),
    };
    let mut all: Vec<Job> = vec![];
    if map {
        let choices = map::choices(size).into_iter();
        all.extend(choices.filter(wanted).map(Job::Entry));
    }
    let methods: &[Method] = match asked {
        MapRequest::Short => &nonlinear::METHODS[..1],
        _ => &nonlinear::METHODS,
    };
    for scene in scenes {
        let can = scene.methods(size).into_iter();
        let tried = can.filter(|method| methods.contains(method));
        all.extend(tried.map(|method| Job::Nonlinear(scene, method, size)));
    }
    all.retain(|job| schemes.contains(&job.method().scheme));
    all
}

/// The jobs of bodies about the axis of revolution, with the methods that scenes that are not linear are tried with; of these schemes
/// alone.
#[must_use]
pub fn round_jobs(schemes: &[StressScheme]) -> Vec<Job> {
    let choices = round::choices(&nonlinear::METHODS).into_iter();
    let wanted = choices.filter(|choice| schemes.contains(&choice.method.scheme));
    wanted.map(Job::Round).collect()
}

/// Runs jobs, `workers` at a time and each on one thread, as long as `go` says so before each, and hands them to `each` in
/// their order.
pub fn run(
    jobs: &[Job],
    workers: usize,
    go: &(dyn Fn() -> bool + Sync),
    mut each: impl FnMut(JobResult),
) {
    // The longest begin first: those in space with the most particles.
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|&k| match jobs[k] {
        Job::Entry(choice) if choice.dimension == Dimension::Three => {
            usize::MAX - choice.particles_per_cell
        }
        _ => usize::MAX,
    });
    let work = |_, job: &Job| {
        let mut stopwatch = Stopwatch::default();
        let outcome = stopwatch.time_thread(|| job.solve());
        JobResult {
            job: *job,
            outcome,
            spent: stopwatch.spent,
        }
    };
    let Ok(()) = side_by_side(jobs, &order, workers, go, work, |done| {
        each(done);
        Ok::<(), Infallible>(())
    });
}
