//! Cases: scenes with an exact answer, ladders of resolutions, and gates that their errors must keep.
//!
//! The same case serves `cargo test` (quick), `proctor verify` (full ladder) and `proctor precision`. Cases know
//! no clocks: who wants the run time of a rung times [`Case::solve`].

mod curve;
pub mod gates;
pub mod ladder;
mod run;
mod rung;
mod runs;
mod value;
pub mod wrong;

use proctor_scene::simulation::{SetupError, Simulation};

pub use self::curve::{Curve, CurvePoint, Drawing};
pub use self::run::Run;
pub use self::rung::Rung;
pub use self::value::{Case, Plan};
use crate::convergence::ConvergenceTable;
use crate::study::Failure;
use thiserror::Error;

/// The part of the ladder that is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Seconds: for tests and for the command without a verb.
    Quick,
    /// The whole ladder of `proctor verify`: minutes.
    Full,
}

impl Size {
    /// The value of the short ladder, or that of the full one.
    #[must_use]
    pub fn pick<T>(self, short: T, full: T) -> T {
        match self {
            Self::Quick => short,
            Self::Full => full,
        }
    }
}

/// A number that a run gave, with what it should have been: an error where it has a relative one, a balance where it
/// should be zero and nothing scales it, a figure where nothing exact is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Its name, by which [`Case::judge`] finds it.
    pub name: &'static str,
    /// Value as computed, in `unit`.
    pub value: f64,
    /// Exact value, in `unit`, where one number says it.
    pub exact: Option<f64>,
    /// Relative error, dimensionless.
    pub error: Option<f64>,
    /// SI unit; `1` for a ratio.
    pub unit: &'static str,
}

impl Quantity {
    /// A number with its exact value, which is not zero.
    #[must_use]
    pub fn compared(name: &'static str, value: f64, exact: f64, unit: &'static str) -> Self {
        Self {
            name,
            value,
            exact: Some(exact),
            error: Some((value / exact - 1.0).abs()),
            unit,
        }
    }

    /// A ratio that should be zero and so is its own error.
    #[must_use]
    pub fn of_zero(name: &'static str, value: f64) -> Self {
        Self {
            name,
            value,
            exact: Some(0.0),
            error: Some(value.abs()),
            unit: "1",
        }
    }

    /// A number that should be zero and has no scale to be relative to.
    #[must_use]
    pub fn balance(name: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            exact: Some(0.0),
            ..Self::figure(name, value, unit)
        }
    }

    /// A number of which nothing exact is known.
    #[must_use]
    pub fn figure(name: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            name,
            value,
            exact: None,
            error: None,
            unit,
        }
    }

    /// True where it should be zero and has no scale to be relative to.
    #[must_use]
    pub fn is_balance(&self) -> bool {
        self.exact == Some(0.0) && self.error.is_none()
    }
}

/// Numbers and pictures of a comparison with the exact solution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurements {
    /// Numbers, each named once.
    pub quantities: Vec<Quantity>,
    /// Pictures of the bodies, where the case has them.
    pub drawings: Vec<Drawing>,
    /// Picture, where the case has one.
    pub curve: Option<Curve>,
}

impl Measurements {
    /// Numbers without a picture.
    #[must_use]
    pub fn of(quantities: impl Into<Vec<Quantity>>) -> Self {
        Self::new(quantities.into(), None)
    }

    /// Adds a picture of them, where there is one.
    #[must_use]
    pub fn drawn(self, curve: impl Into<Option<Curve>>) -> Self {
        Self {
            curve: curve.into(),
            ..self
        }
    }

    /// Numbers, and the picture of them where there is one.
    #[must_use]
    pub fn new(quantities: Vec<Quantity>, curve: Option<Curve>) -> Self {
        Self {
            quantities,
            drawings: vec![],
            curve,
        }
    }
}

/// Result of the run of one rung.
#[derive(Clone, Debug, PartialEq)]
pub struct RungResult {
    /// Number of particles.
    pub particles: usize,
    /// Number of time steps.
    pub steps: u64,
    /// Time that the run reached \[s\].
    pub time: f64,
    /// Numbers, each named once.
    pub quantities: Vec<Quantity>,
    /// Pictures of the bodies, where the case has them.
    pub drawings: Vec<Drawing>,
    /// Picture, where the case has one.
    pub curve: Option<Curve>,
}

impl RungResult {
    /// The result of a simulation that has run.
    #[must_use]
    pub fn new(found: Measurements, simulation: &Simulation) -> Self {
        Self {
            particles: simulation.particles(),
            steps: simulation.steps(),
            time: simulation.time(),
            quantities: found.quantities,
            drawings: found.drawings,
            curve: found.curve,
        }
    }

    /// The quantity of that name.
    #[must_use]
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        self.quantities.iter().find(|q| q.name == name)
    }

    /// Relative error of the quantity of that name; NaN where there is none, so that a gate on it fails.
    #[must_use]
    pub fn error(&self, name: &str) -> f64 {
        self.quantity(name)
            .and_then(|q| q.error)
            .unwrap_or(f64::NAN)
    }

    /// Value of the quantity of that name; NaN where there is none.
    #[must_use]
    pub fn value(&self, name: &str) -> f64 {
        self.quantity(name).map_or(f64::NAN, |q| q.value)
    }
}

/// Side of its bound on which a gate's value must lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `value <= bound`.
    AtMost,
    /// `value >= bound`.
    AtLeast,
}

impl Relation {
    /// The side in words: `at most`, `at least`.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::AtMost => "at most",
            Self::AtLeast => "at least",
        }
    }
}

/// A bound that a result must keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// The number that is bounded, with its variant and resolution.
    pub name: String,
    /// The value that was found; NaN where it could not be computed.
    pub value: f64,
    /// The side that is right.
    pub relation: Relation,
    /// The bound, in the unit of the value.
    pub bound: f64,
    /// Reason of the bound.
    pub reason: &'static str,
}

impl Gate {
    /// An upper bound.
    #[must_use]
    pub fn at_most(name: String, value: f64, bound: f64, reason: &'static str) -> Self {
        Self {
            name,
            value,
            relation: Relation::AtMost,
            bound,
            reason,
        }
    }

    /// A lower bound.
    #[must_use]
    pub fn at_least(name: String, value: f64, bound: f64, reason: &'static str) -> Self {
        Self {
            relation: Relation::AtLeast,
            ..Self::at_most(name, value, bound, reason)
        }
    }

    /// True where the value keeps the bound; NaN does not.
    #[must_use]
    pub fn passed(&self) -> bool {
        match self.relation {
            Relation::AtMost => self.value <= self.bound,
            Relation::AtLeast => self.value >= self.bound,
        }
    }
}

/// Verdict of a case on a ladder that was run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Errors and observed orders, each table with its title.
    pub tables: Vec<(String, ConvergenceTable)>,
    /// Gates; the case passes if all of them do.
    pub gates: Vec<Gate>,
    /// Lines that are shown and judge nothing.
    pub for_the_record: Vec<String>,
    /// Pictures of several runs together.
    pub curves: Vec<Curve>,
}

impl Verdict {
    /// True where there are gates and all of them pass: a verdict that compared nothing is not green.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.gates.is_empty() && self.gates.iter().all(Gate::passed)
    }
}

/// A rung that could not be solved.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{case}, {rung}: {reason}")]
pub struct CaseError {
    /// Name of the case.
    pub case: &'static str,
    /// Label of the rung.
    pub rung: String,
    /// The reason, with place and time.
    pub reason: String,
    /// True where ranks that were to share the scene cannot.
    pub unshared: bool,
}

impl CaseError {
    /// Sentence for a rung of the case of that name that could not be solved.
    #[must_use]
    pub fn new(case: &'static str, rung: &Rung, reason: &Failure) -> Self {
        let setup = reason.downcast_ref();
        Self {
            case,
            rung: rung.label.clone(),
            reason: reason.to_string(),
            unshared: matches!(setup, Some(SetupError::Ranks(_))),
        }
    }
}

/// All cases, in the order in which they are shown.
#[must_use]
pub fn all() -> &'static [&'static Case] {
    crate::cases::ALL
}

/// The case of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Case> {
    all().iter().copied().find(|case| case.name() == name)
}
