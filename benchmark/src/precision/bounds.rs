//! Bounds that other solvers are held to, one per case.

use super::peers::PeerLine;
use super::run::CaseStudy;
use crate::bench::children::OWN;
use crate::record::Record;
use proctor_verification::case::{Gate, Relation};
use std::str::FromStr;

/// Least bound of a case of which none is given.
const LEAST: f64 = 0.01;
/// Default bound of another solver, in errors of this program's own process on the same meshes.
const TIMES_OWN: f64 = 2.0;

/// A bound that a user gives: `case=2%`, or `case=0.02`.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// Name of the case.
    pub case: String,
    /// Largest relative error.
    pub error: f64,
}

impl FromStr for Bound {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let accepted = || {
            format!(
                "found {text:?}; accepted: a case and a share above zero, such as self-weight=2%"
            )
        };
        let (case, share) = text.split_once('=').ok_or_else(accepted)?;
        let (number, unit) = match share.trim().strip_suffix('%') {
            Some(number) => (number.trim(), 0.01),
            None => (share.trim(), 1.0),
        };
        let error = number.parse::<f64>().map_err(|_| accepted())? * unit;
        if case.is_empty() || !error.is_finite() || error <= 0.0 {
            return Err(accepted());
        }
        Ok(Self {
            case: case.to_owned(),
            error,
        })
    }
}

/// The gate of each other solver on a study: the error of its finest run. Without a bound of the user's it may be twice that of
/// this program's own process, or 1 % where that is more.
#[must_use]
pub fn gates(studied: &CaseStudy, bounds: &[Bound]) -> Vec<(String, Gate)> {
    let case = studied.study.name();
    let given = bounds.iter().rfind(|bound| bound.case == case);
    let own = studied
        .peers
        .iter()
        .find(|line| line.name == OWN)
        .and_then(finest);
    let (bound, reason) = match (given, own) {
        (Some(bound), _) => (bound.error, "as the command says"),
        (None, Some(own)) if TIMES_OWN * own > LEAST => (
            TIMES_OWN * own,
            "twice the error of this program's own process on the same meshes",
        ),
        (None, _) => (
            LEAST,
            "1 % where this program's own process is far below it",
        ),
    };
    let measure = studied
        .study
        .measures()
        .first()
        .map_or("result", |measure| measure.word);
    let others = studied
        .peers
        .iter()
        .filter(|line| line.name != OWN && !line.runs.is_empty());
    others
        .map(|line| {
            let gate = Gate {
                name: format!("error of the {measure}, finest run"),
                value: finest(line).unwrap_or(f64::NAN),
                relation: Relation::AtMost,
                bound,
                reason,
            };
            (format!("{}/{case}", line.name), gate)
        })
        .collect()
}

/// The error of the finest run; none where it failed.
fn finest(line: &PeerLine) -> Option<f64> {
    line.runs.last()?.error.as_ref().ok().copied()
}

impl Record {
    /// Adds the gates of other solvers.
    pub fn push_bounds(&mut self, gates: &[(String, Gate)]) {
        for (of, gate) in gates {
            self.push_gate(of, gate, 1);
        }
    }
}
