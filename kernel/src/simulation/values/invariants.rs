//! Invariants of a run: the monitor, its bounds, and the first violation.

use std::fmt;

/// Largest energy from nowhere, over what the start and the work done have given so far. Cell crossing alone gave 0.67
/// (linear functions, USF, ten periods of a bar); an unstable step doubles it again and again.
pub(crate) const MOST_GAIN: f64 = 1.0;

/// Largest norm of a strain increment, |dt grad v|, of a particle in one step.
pub(crate) const MOST_INCREMENT: f64 = 0.5;

/// Largest change of momentum that no force accounts for, over the momentum that there is in all directions.
pub(crate) const MOST_LOST_MOMENTUM: f64 = 1e-9;

/// Smallest V/V_0 of a particle that raises no event.
pub(crate) const LEAST_VOLUME_RATIO: f64 = 0.1;

/// Largest V/V_0 of a particle that raises no event.
pub(crate) const MOST_VOLUME_RATIO: f64 = 10.0;

/// Energy that is no more than round-off, over that of the mass at the speed of its waves.
pub(in crate::simulation) const ROUND_OFF: f64 = 1e-20;

/// The invariant monitor of a run: the largest violations so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InvariantMonitor {
    /// Largest energy that the start and the work done have given \[J\].
    pub given: f64,
    /// Largest energy from nowhere, over that.
    pub gain: f64,
    /// Largest strain increment of a particle in one step.
    pub increment: f64,
    /// Largest change of momentum that no force accounts for, over the momentum in all directions.
    pub lost_momentum: f64,
    /// Factor by which volumes may still change before one of them can be outside 0.1 to 10 times that of the start, as a
    /// logarithm: then they are checked. Infinite once one was seen.
    pub volume_left: f64,
    /// Since when the run is not to be trusted, and why.
    pub violation: Option<Violation>,
}

/// The first violation of an invariant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// Number of the step after which it was seen.
    pub step: u64,
    /// Time \[s\].
    pub time: f64,
    /// The invariant that is out of balance.
    pub reason: Invariant,
    /// Its distance from balance.
    pub value: f64,
}

/// An invariant of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invariant {
    /// Energy from nowhere, more than there was.
    Energy,
    /// A particle is strained too far within a step, by more than 0.5.
    Increment,
    /// Momentum that no force accounts for, more than 1e-9 of that in all directions.
    Momentum,
}

impl Invariant {
    /// All of them, in an order that stays.
    pub const ALL: [Self; 3] = [Self::Energy, Self::Increment, Self::Momentum];
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "not to be trusted since step {}, {:e} s: ",
            self.step, self.time
        )?;
        let value = self.value;
        match self.reason {
            Invariant::Energy => write!(
                f,
                "there is more energy than was given, by {value:.3} of that; accepted: {MOST_GAIN}"
            ),
            Invariant::Increment => write!(
                f,
                "a particle was strained by {value:.3} in one step; accepted: {MOST_INCREMENT}"
            ),
            Invariant::Momentum => write!(
                f,
                "{value:.3e} of the momentum changed without a force; accepted: {MOST_LOST_MOMENTUM:e}"
            ),
        }
    }
}
