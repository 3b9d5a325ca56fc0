//! Stiff and extreme scenes: each holds by a physical check, is refused with a reason, or is said to fail. None is silently
//! wrong.
//!
//! A row is a function that runs what it needs and returns bounds on what physics says of it ([`Gate`]: an exact value, a
//! balance of momentum or energy, a symmetry, equal bits) and the messages of what was refused.

pub mod alone;
pub mod apart;
pub mod contrast;
pub mod corner;
pub mod fast;
pub mod friction;
pub mod incompressible;
pub mod ringing;
pub mod stiff_contact;
pub mod touching;
mod trial;
pub mod turning;
pub mod watch;

use std::fmt;

use crate::case::Gate;

/// A row of the table.
pub struct Extreme {
    /// Name on the command line: lower case, words joined by `-`.
    pub name: &'static str,
    /// What is extreme in it.
    pub what: &'static str,
    /// What a good code must do.
    pub required: &'static str,
    /// Why it fails today, where it does: shown beside the row.
    pub cause: Option<&'static str>,
    /// Runs it.
    pub judge: fn() -> Result<Finding, Unexpected>,
}

/// What a row gave.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finding {
    /// What must hold; all of it, or the row has failed.
    pub gates: Vec<Gate>,
    /// Messages of what was refused, or stopped with a typed error, as it should be.
    pub refusals: Vec<String>,
}

/// How a row ended.
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unexpected(pub String);

impl fmt::Display for Unexpected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unexpected {}

impl Finding {
    /// How the row ended.
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
