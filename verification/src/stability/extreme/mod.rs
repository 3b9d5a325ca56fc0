//! Stiff and extreme scenes: each holds by a physical check, is refused with a reason, or is said to fail. None is silently
//! wrong.
//!
//! A row is a function that runs what it needs and returns bounds on what physics says of it ([`Gate`]: an exact value, a
//! balance of momentum or energy, a symmetry, equal bits) and the messages of what was refused.

mod alone;
mod bits;
mod contrast;
mod fast;
mod gates;
mod incompressible;
mod input;
mod mesh;
mod motion;
mod nothing;
mod particles;
mod places;
mod prelude;
mod ringing;
mod starts;
mod steps;
mod stiff_contact;
mod touching;
mod turning;
mod vocabulary;
mod watch;

use crate::case::Gate;
use thiserror::Error;

/// The lists of rows, in the order in which they are shown.
static LISTS: &[&[Extreme]] = &[
    places::ROWS,
    motion::ROWS,
    bits::ROWS,
    mesh::ROWS,
    steps::ROWS,
    input::ROWS,
    nothing::ROWS,
    contrast::ROWS,
    incompressible::ROWS,
    alone::ROWS,
    fast::ROWS,
    ringing::ROWS,
    turning::ROWS,
    touching::ROWS,
    stiff_contact::ROWS,
    watch::ROWS,
];

/// All rows, in the order in which they are shown.
#[must_use]
pub fn all() -> Vec<&'static Extreme> {
    LISTS.iter().copied().flatten().collect()
}

/// A row of the table.
pub struct Extreme {
    /// Name on the command line: lower case, words joined by `-`.
    pub name: &'static str,
    /// Its extreme feature.
    pub what: &'static str,
    /// The behaviour of a good code.
    pub required: &'static str,
    /// Cause of the failure, for a row that fails today: shown beside the row.
    pub cause: Option<&'static str>,
    /// Runs it.
    pub judge: fn() -> RowVerdict,
}

impl Extreme {
    /// A row by its name and its run, of which no cause of a failure is known.
    const fn of(name: &'static str, judge: fn() -> RowVerdict) -> Self {
        Self {
            name,
            what: "",
            required: "",
            cause: None,
            judge,
        }
    }

    /// Its extreme feature.
    const fn with(self, what: &'static str) -> Self {
        Self { what, ..self }
    }

    /// The behaviour of a good code.
    const fn must(self, required: &'static str) -> Self {
        Self { required, ..self }
    }

    /// Adds the cause of today's failure.
    const fn because(self, cause: &'static str) -> Self {
        Self {
            cause: Some(cause),
            ..self
        }
    }
}

/// A value of a run, or what should not have come.
type Result<T, E = RowFault> = std::result::Result<T, E>;

/// Result of a row, or what should not have come.
type RowVerdict = Result<Finding>;

/// Result of a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finding {
    /// Gates of the row; if one fails, the row has failed.
    pub gates: Vec<Gate>,
    /// Messages of what was refused, or stopped with a typed error, as it should be.
    pub refusals: Vec<String>,
}

/// Ending of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// It ran, and physics holds.
    Held,
    /// Nothing of it runs: it is refused with a reason.
    Refused,
    /// A check does not hold, or an error came that should not.
    Failed,
}

impl Ending {
    /// Its word in tables and records.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::Refused => "refused",
            Self::Failed => "FAILED",
        }
    }
}

/// An error that a row should not have met, or a refusal that did not come.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct RowFault(pub String);

impl Finding {
    /// The condition that must hold.
    fn of(gates: impl IntoIterator<Item = Gate>) -> Self {
        Self::default().and(gates)
    }

    /// Adds gates that must hold.
    fn and(mut self, gates: impl IntoIterator<Item = Gate>) -> Self {
        self.gates.extend(gates);
        self
    }

    /// Adds messages of refusals.
    fn refusing(mut self, refusals: Vec<String>) -> Self {
        self.refusals.extend(refusals);
        self
    }

    /// Ending of the row.
    #[must_use]
    pub fn ending(&self) -> Ending {
        if !self.gates.iter().all(Gate::passed) || self.gates.is_empty() && self.refusals.is_empty()
        {
            Ending::Failed
        } else if self.gates.is_empty() {
            Ending::Refused
        } else {
            Ending::Held
        }
    }
}
