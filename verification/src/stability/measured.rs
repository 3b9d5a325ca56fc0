//! The measured limit: runs with noise, at steps that close in on it from both sides.

use std::sync::Arc;

use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Scene, TimeStep, Vector};

use super::arnoldi::uniform;
use super::frozen::fastest_wave;
use super::{StabilityError, frozen};
use crate::cases::AT_REST;

/// Velocity of the noise over that of waves: nothing moves by a hair's breadth, so that a body stays where it was put.
const NOISE: f64 = 1e-9;
/// Highest energy of the second half of a run over that of the first from which it is unstable. The start is no measure:
/// near the limit the energies of a leapfrog, half a step apart, swing by many times what they were.
const GROWN: f64 = 4.0;
/// Energy over that of the start from which nothing is waited for.
const BLOWN: f64 = 1e8;
/// Time of a run in cells over wave speed, and the fewest and most steps it may be.
const TIME: f64 = 400.0;
const STEPS: [f64; 2] = [400.0, 2000.0];
/// Steps from one look at the energy to the next.
const LOOK_EVERY: u64 = 8;
/// Courant numbers between which a limit is sought.
pub const RANGE: [f64; 2] = [2e-4, 4.0];
/// Ratio of the unstable to the stable side at which a limit is known.
const NARROW: f64 = 1.02;
/// First tries, as shares of the prediction.
const FIRST: [f64; 2] = [0.99, 1.009];

/// Start of a climb, and its step.
const FOOT: f64 = 0.1;
const PACE: f64 = 1.1;

/// A limit that was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredLimit {
    /// Largest Courant number that was seen to be stable below all that were not; `None` where there is none in the range.
    pub stable: Option<f64>,
    /// Smallest that was seen to be unstable; `None` where there is none in the range.
    pub unstable: Option<f64>,
    /// Class of the failure of the run at [`MeasuredLimit::unstable`].
    pub class: Option<Class>,
    /// Runs that were made.
    pub runs: usize,
}

impl MeasuredLimit {
    /// Nothing was measured.
    pub const NONE: Self = Self {
        stable: None,
        unstable: None,
        class: None,
        runs: 0,
    };
}

/// Source of the growth of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// The time step: at half of it all is well.
    TimeStep,
    /// Something else, such as particles that cross cells: half the step does not help.
    OtherCause,
}

impl Class {
    /// Its words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::TimeStep => "time step",
            Self::OtherCause => "other cause: half the step fails too",
        }
    }
}

/// Closes in on the Courant number at which `stable` begins to say no, from a first guess.
///
/// # Errors
/// Those of `stable`.
pub fn bisect<E>(
    guess: f64,
    range: [f64; 2],
    mut stable: impl FnMut(f64) -> Result<bool, E>,
) -> Result<MeasuredLimit, E> {
    let mut runs = 0;
    let mut holds = |courant: f64| {
        runs += 1;
        stable(courant)
    };
    let guess = if guess.is_finite() {
        guess
    } else {
        range[1] / 2.0
    };
    let (mut low, mut high) = (None, None);
    let mut at = (FIRST[0] * guess).clamp(range[0], range[1]);
    // Upwards from what holds, downwards from what does not, in steps that become wider.
    let mut wider = FIRST[1] / FIRST[0];
    loop {
        let held = holds(at)?;
        if held {
            low = Some(at);
        } else {
            high = Some(at);
        }
        if low.is_some() && high.is_some() {
            break;
        }
        let next = if held { at * wider } else { at / wider };
        let next = next.clamp(range[0], range[1]);
        if next == at {
            break;
        }
        at = next;
        wider *= wider.max(1.05);
    }
    if let (Some(mut a), Some(mut b)) = (low, high) {
        while b / a > NARROW {
            let middle = (a * b).sqrt();
            if holds(middle)? {
                a = middle;
            } else {
                b = middle;
            }
        }
        (low, high) = (Some(a), Some(b));
    }
    let class = match high {
        Some(high) if holds(0.5 * high)? => Some(Class::TimeStep),
        Some(_) => Some(Class::OtherCause),
        None => None,
    };
    Ok(MeasuredLimit {
        stable: low,
        unstable: high,
        class,
        runs,
    })
}

/// The measured limit of a scene without loads, from a first guess.
///
/// # Errors
/// A scene that is refused.
pub fn measure(scene: &Scene, guess: f64) -> Result<MeasuredLimit, StabilityError> {
    bisect(guess, RANGE, |courant| holds(scene, courant))
}

/// The measured limit of a scene without loads of which nothing is predicted: the first of Courant numbers that rise by a tenth
/// each that does not hold, closed in on. Where a step is not linear, larger ones may hold again.
///
/// # Errors
/// A scene that is refused.
pub fn climb(scene: &Scene) -> Result<MeasuredLimit, StabilityError> {
    let mut guess = FOOT;
    let mut runs = 0;
    while guess < RANGE[1] && holds(scene, guess)? {
        guess = (guess * PACE).min(RANGE[1]);
        runs += 1;
    }
    // No step that held is tried again from above.
    let range = [(guess / PACE).max(RANGE[0]), guess];
    let found = bisect(guess / FIRST[0], range, |courant| holds(scene, courant))?;
    Ok(MeasuredLimit {
        runs: runs + found.runs,
        ..found
    })
}

/// True if a scene without loads holds at a Courant number: neither an error, nor four times the energy in the second half.
///
/// # Errors
/// A scene that is refused.
pub fn holds(scene: &Scene, courant: f64) -> Result<bool, StabilityError> {
    let mut scene = scene.clone();
    scene.time_step = TimeStep::Multiplier {
        multiplier: courant,
        allow_unstable: true,
    };
    let speed = NOISE * fastest_wave(&scene);
    let options = Options {
        threads: Some(1),
        initial: Some(Arc::new(move |x| noisy(x, speed))),
        ..Options::default()
    };
    let mut simulation = scene.simulate(&options)?;
    let steps = (TIME / courant).clamp(STEPS[0], STEPS[1]) as u64;
    let begin = energy(&simulation);
    let mut highest = [0.0_f64; 2];
    while simulation.steps() < steps {
        if simulation.step(scene.time).is_err() {
            return Ok(false);
        }
        let done = simulation.steps();
        if done.is_multiple_of(LOOK_EVERY) {
            let now = energy(&simulation);
            // Not a number is no energy either.
            if now.is_nan() || now > BLOWN * begin {
                return Ok(false);
            }
            let half = usize::from(2 * done > steps);
            highest[half] = highest[half].max(now);
        }
    }
    Ok(highest[1] <= GROWN * highest[0])
}

fn energy(simulation: &Simulation) -> f64 {
    simulation.kinetic_energy() + simulation.strain_energy()
}

/// A velocity that belongs to a place, each component from -`speed` to `speed`.
fn noisy(x: &Vector, speed: f64) -> InitialState {
    let seed = x.iter().fold(0_u64, |seed, x| {
        (seed ^ x.to_bits()).wrapping_mul(0x0000_0100_0000_01b3)
    });
    InitialState {
        velocity: std::array::from_fn(|axis| speed * uniform(seed.wrapping_add(axis as u64))),
        ..AT_REST
    }
}

/// Smallest cell over the fastest wave at rest \[s\]: a Courant number of one.
#[must_use]
pub fn courant_one(scene: &Scene) -> f64 {
    frozen::smallest_cell(scene) / fastest_wave(scene)
}
