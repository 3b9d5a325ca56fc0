//! Scenes made of random choices, judged by what holds of every scene: answers that need no reference.
//!
//! A [`Question`] turns choices into a [`Trial`]: one or more scenes, and a property that their results must have, with a
//! bound and the reason for it. The scene of a number follows from a seed and that number alone. Each is small, so that
//! thousands are asked in minutes.
//!
//! Known limits of the method stay out of the scenes by construction; a comment at the choice has the reason.

mod cause;
mod change;
mod column;
mod compare;
mod crowd;
mod dice;
mod flight;
mod frames;
mod ground;
mod law;
mod line;
mod momentum;
mod order;
mod pressed;
mod seen;
mod units;

pub use cause::cause;
pub(crate) use compare::apart;
pub use dice::Dice;
pub(crate) use seen::largest;
pub use seen::{FinalState, Particle};

use proctor_scene::Scene;
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::{Options, ResultWarning, plan};

/// All questions; scene `k` of a seed asks the one of number `k` modulo their count.
pub static QUESTIONS: &[&Question] = &[
    &flight::FLIGHT,
    &momentum::MOMENTUM,
    &momentum::SPIN,
    &units::POWERS,
    &units::ODD,
    &frames::MIRROR,
    &frames::TURN,
    &frames::SHIFT,
    &order::BODIES,
    &order::THREADS,
    &order::CUT,
    &pressed::JOINED,
    &pressed::CONTACT,
    &pressed::DRIVEN,
    &pressed::PLATE,
    &line::LINE,
    &ground::GROUND,
    &ground::WALLS,
];

/// Most steps of a scene: none that is meant to be small may take minutes.
const MOST_STEPS: u64 = 50_000;

/// A property that holds of every scene of some kind.
pub struct Question {
    /// Name in tables: lower case.
    pub name: &'static str,
    /// The property.
    pub holds: &'static str,
    /// The reason for the bound.
    pub because: &'static str,
    /// Words of the warnings with which a plan names scenes in which the property does not hold.
    pub foreseen: &'static [&'static str],
    /// A scene of the kind.
    pub make: fn(&mut Dice) -> Trial,
}

/// A scene, and what must hold of it.
pub struct Trial {
    /// Runs; the first is the scene that is shown, the others the same in other words.
    pub runs: Vec<Run>,
    /// Distances from what should be, of the runs in their order.
    pub judge: Judge,
}

/// Distances of results from what they should be.
pub type Judge = Box<dyn Fn(&[FinalState]) -> Vec<Deviation> + Send + Sync>;

/// A scene with the number of threads that run it, to its end.
pub struct Run {
    /// The scene.
    pub scene: Scene,
    /// Number of threads.
    pub threads: usize,
    /// True where the answer is a state of rest: the run goes on until nothing moves, for at most four times the time of the scene.
    pub to_rest: bool,
}

impl From<Scene> for Run {
    fn from(scene: Scene) -> Self {
        Self {
            scene,
            threads: 1,
            to_rest: false,
        }
    }
}

impl Run {
    /// A run until nothing moves.
    #[must_use]
    pub fn to_rest(scene: Scene) -> Self {
        Self {
            to_rest: true,
            ..scene.into()
        }
    }
}

/// Largest kinetic over strain energy of what rests: its stress swings by a thousandth.
const REST: f64 = 1e-6;
/// Most times of a scene that a run to rest takes.
const LONGEST: f64 = 4.0;

/// The distance of a result from the right one.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The quantity, and its scale.
    pub what: String,
    /// The distance.
    pub value: f64,
    /// The largest distance at which the property holds.
    pub bound: f64,
}

impl Deviation {
    /// A distance with its bound.
    #[must_use]
    pub fn new(what: impl Into<String>, value: f64, bound: f64) -> Self {
        Self {
            what: what.into(),
            value,
            bound,
        }
    }

    /// True beyond the bound, and for a distance that is not a number.
    #[must_use]
    pub fn violates(&self) -> bool {
        self.value.is_nan() || self.value > self.bound
    }

    /// Distance over bound; infinite where the distance is not a number, or where none is allowed and there is one.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.value.is_nan() {
            f64::INFINITY
        } else if self.value == 0.0 {
            0.0
        } else {
            self.value / self.bound
        }
    }
}

/// A scene with its answer.
pub struct Answer {
    /// The question.
    pub question: &'static Question,
    /// Number of the scene.
    pub number: u64,
    /// The scene.
    pub scene: Scene,
    /// Distances, at least one, or the reason why there are none: the scene was refused, or a step failed.
    pub found: Result<Vec<Deviation>, String>,
    /// The plan of the scene warns that the property may not hold.
    pub foreseen: bool,
    /// The run tells that it has not come to rest, where the answer is a state of rest.
    pub told: bool,
}

impl Answer {
    /// True where the property does not hold, and neither the plan nor the run warned of it.
    #[must_use]
    pub fn violates(&self) -> bool {
        match &self.found {
            Ok(all) => all.is_empty() || (self.deviates() && !self.foreseen && !self.told),
            Err(_) => true,
        }
    }

    /// True where a result is beyond its bound, with or without a warning.
    #[must_use]
    pub fn deviates(&self) -> bool {
        let all = self.found.as_ref();
        all.is_ok_and(|all| all.iter().any(Deviation::violates))
    }

    /// The distance nearest to its bound, or furthest beyond it.
    #[must_use]
    pub fn worst(&self) -> Option<&Deviation> {
        let all = self.found.as_ref().ok()?;
        all.iter().max_by(|a, b| a.share().total_cmp(&b.share()))
    }
}

/// The question of a scene, and the scene.
#[must_use]
pub fn trial(seed: u64, number: u64) -> (&'static Question, Trial) {
    let question = QUESTIONS[(number % QUESTIONS.len() as u64) as usize];
    let trial = (question.make)(&mut Dice::new(seed, number));
    (question, trial)
}

/// Makes the scene of that number, runs it and judges it.
#[must_use]
pub fn answer(seed: u64, number: u64) -> Answer {
    let (question, mut trial) = trial(seed, number);
    for run in &mut trial.runs {
        run.scene.name = format!("{}-{seed}-{number}", question.name);
    }
    let seen = results(&trial.runs);
    let told = seen
        .iter()
        .flatten()
        .any(|seen| seen.cautions.contains(&"motion"));
    let found = seen.map(|seen| (trial.judge)(&seen));
    let scene = trial.runs.swap_remove(0).scene;
    let foreseen = !question.foreseen.is_empty() && {
        let plan = plan(&scene, PlanOptions::default());
        let named = |warning: &String| {
            question
                .foreseen
                .iter()
                .any(|words| warning.contains(words))
        };
        plan.warnings.iter().any(named)
    };
    Answer {
        question,
        number,
        scene,
        found,
        foreseen,
        told,
    }
}

/// Results of the runs, in their order.
///
/// # Errors
/// The reason for which a scene is refused, or a step of it fails.
pub fn results(runs: &[Run]) -> Result<Vec<FinalState>, String> {
    runs.iter().map(result).collect()
}

fn result(run: &Run) -> Result<FinalState, String> {
    let options = Options {
        threads: Some(run.threads),
        // Small as scenes are here, all threads take part.
        least_share: Some(1),
        ..Options::default()
    };
    let mut simulation = run.scene.simulate(&options).map_err(|e| e.to_string())?;
    let start = FinalState::start(&simulation);
    let mut end = run.scene.time;
    loop {
        if simulation.time() >= end {
            let longest = LONGEST * run.scene.time;
            if !run.to_rest {
                return Ok(start.end(&simulation));
            }
            let energy = simulation.energy();
            if end >= longest || energy.kinetic < REST * energy.strain {
                let cautions = simulation.cautions(&energy);
                let mut seen = start.end(&simulation);
                seen.cautions = cautions.iter().map(ResultWarning::word).collect();
                return Ok(seen);
            }
            end = (end + run.scene.time).min(longest);
        }
        if simulation.steps() >= MOST_STEPS {
            return Err(format!(
                "{MOST_STEPS} steps end at {:e} s of {end:e} s",
                simulation.time()
            ));
        }
        simulation.step(end).map_err(|e| e.to_string())?;
    }
}
