//! A mill of manufactured solutions: random smooth motions of random laws, driven by the body force that makes them motions,
//! on ladders of meshes, with errors and orders held against what theory expects.
//!
//! Source: verification notes, A1 to A3, and Salari and Knupp (2000). From a motion x(X, t) and a law follow start, body force
//! b = x'' - Div P/rho_0 and prescribed nodes, with derivatives by forward mode ([`Jet`](crate::exact::jet::Jet)). A problem
//! follows from seed and number alone. What has no solution to converge to is refused and drawn anew, and counted.

pub mod boundary;
pub mod check;
pub mod draw;
pub mod expected;
pub mod ladder;
mod lanes;
pub mod material;
pub mod motion;
pub mod path;
pub mod problem;
pub mod reference;

use expected::Gate;
use ladder::{Errors, Failure, Faults};
use problem::Problem;

/// Draws after which a number is given up.
const MOST_ATTEMPTS: u64 = 100;

/// A problem with its errors and gates.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Number of the problem.
    pub number: u64,
    /// The problem.
    pub problem: Problem,
    /// Errors on its ladder, coarse to fine, or why a run failed.
    pub found: Result<Vec<Errors>, String>,
    /// Gates; none where a run failed.
    pub gates: Vec<Gate>,
    /// Draws of the number that were refused, each with its reason.
    pub refused: Vec<String>,
}

impl Answer {
    /// True where a run failed or a gate does not hold.
    #[must_use]
    pub fn misses(&self) -> bool {
        self.found.is_err() || self.gates.is_empty() || self.gates.iter().any(|gate| !gate.holds())
    }
}

/// Draws the problem of that number and runs it.
///
/// # Errors
/// The reasons for which all draws were refused.
pub fn answer(seed: u64, number: u64) -> Result<Answer, Vec<String>> {
    let mut refused = vec![];
    for attempt in 0..MOST_ATTEMPTS {
        let problem = match draw::problem(seed, number, attempt) {
            Ok(problem) => problem,
            Err(reason) => {
                refused.push(reason);
                continue;
            }
        };
        match judge(&problem, &Faults::default()) {
            Ok((found, gates)) => {
                return Ok(Answer {
                    number,
                    problem,
                    found,
                    gates,
                    refused,
                });
            }
            Err(reason) => refused.push(reason),
        }
    }
    Err(refused)
}

/// Errors on a ladder or why a run failed, and gates.
pub type LadderJudgement = (Result<Vec<Errors>, String>, Vec<Gate>);

/// Runs the ladder of a problem, with deliberate faults if there are any.
///
/// # Errors
/// The reason for which the problem has no solution to converge to.
pub fn judge(problem: &Problem, faults: &Faults) -> Result<LadderJudgement, String> {
    let mut errors = vec![];
    for &cells in &problem.ladder {
        match ladder::run(problem, cells, faults) {
            Ok(found) => errors.push(found),
            Err(Failure::NotSolvable(reason)) => return Err(reason),
            Err(Failure::Run(reason)) => return Ok((Err(reason), vec![])),
        }
    }
    // After the runs: where a point unloads, which they refuse, differences are no derivatives.
    let derivation = check::derivation(problem);
    if !derivation.holds() {
        let reason = format!("derivatives are not those of differences: {derivation:?}");
        return Ok((Err(reason), vec![]));
    }
    let gates = expected::gates(problem, &errors);
    Ok((Ok(errors), gates))
}
