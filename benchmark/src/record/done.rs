//! The cases that a record holds, and how they ended, so that work can go on where it was stopped.

use super::row::GATE;
use super::{Kind, Record, Row};
use proctor_verification::case::{Case, Size};
use serde_json::Value;

/// Key of the context that names the cases that were asked for, where these were not all.
const CASES: &str = "cases";

/// Name of the aggregate that is the verdict of a case.
pub(super) const VERDICT: &str = "verdict";

/// Stage of a record with a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseState {
    /// Not all of its runs are there.
    Missing,
    /// All of its runs are there, and one of them or a gate failed.
    Failed,
    /// All of it is there and holds.
    Held,
}

impl Record {
    /// Says which cases were asked for; nothing is said where that is all of them.
    pub fn set_cases(&mut self, names: &[&str], all: usize) {
        if names.len() < all {
            self.context[CASES] = names.iter().copied().collect();
        }
    }

    /// The cases that were asked for; `None` where that was all of them.
    #[must_use]
    pub fn cases_asked(&self) -> Option<Vec<&str>> {
        let names = self.context[CASES].as_array()?;
        Some(names.iter().filter_map(Value::as_str).collect())
    }

    /// Takes the cases that were asked for in another record to those of this one.
    pub(super) fn join_cases(&mut self, other: &Self) {
        let its = other.context[CASES].as_array().cloned();
        match (self.context[CASES].as_array_mut(), its) {
            (Some(mine), Some(its)) => {
                let new = its.into_iter().filter(|name| !mine.contains(name));
                let new: Vec<Value> = new.collect();
                mine.extend(new);
            }
            // All of them were asked for.
            (Some(_), None) => {
                if let Some(context) = self.context.as_object_mut() {
                    context.remove(CASES);
                }
            }
            (None, _) => {}
        }
    }

    /// Stage of the record with the ladder of a case.
    #[must_use]
    pub fn case_state(&self, case: &Case, size: Size) -> CaseState {
        let rows: Vec<&Row> = self
            .rows
            .iter()
            .filter(|row| is_of(row, case.name()))
            .collect();
        let sampled = |name: &str| {
            let sample = |row: &&&Row| matches!(row.kind, Kind::Sample { .. }) && row.name == name;
            rows.iter().any(|row| sample(&row))
        };
        let ladder = case.rungs(size);
        let names = ladder
            .iter()
            .map(|rung| format!("{}/{}", case.name(), rung.label));
        let judged = rows.iter().any(|row| is_aggregate(row, VERDICT));
        if !judged || !names.into_iter().all(|name| sampled(&name)) {
            CaseState::Missing
        } else if rows.iter().any(|row| row.error.is_some()) {
            CaseState::Failed
        } else {
            CaseState::Held
        }
    }

    /// Number of gates of a case.
    #[must_use]
    pub fn gates_of(&self, case: &str) -> usize {
        let gates = self.rows.iter().filter(|row| is_of(row, case));
        gates.filter(|row| is_aggregate(row, GATE)).count()
    }

    /// True if the record holds anything but cases of these names.
    #[must_use]
    pub fn holds_more_than(&self, cases: &[&str]) -> bool {
        let known = |row: &Row| cases.iter().any(|case| is_of(row, case));
        !self.rows.iter().all(known)
    }

    /// Keeps these cases and nothing else.
    pub fn keep_cases(&mut self, cases: &[&str]) {
        self.rows
            .retain(|row| cases.iter().any(|case| is_of(row, case)));
        let details = std::mem::take(&mut self.details.cases);
        self.details = super::Details::default();
        self.details.cases = details;
        self.details
            .cases
            .retain(|case| cases.contains(&case.name.as_str()));
    }

    /// Puts cases into the order of these names; what belongs to none of them comes last.
    pub fn sort_cases(&mut self, cases: &[&str]) {
        let place = |of: &dyn Fn(&str) -> bool| {
            cases
                .iter()
                .position(|case| of(case))
                .unwrap_or(cases.len())
        };
        self.rows.sort_by_key(|row| place(&|case| is_of(row, case)));
        self.details
            .cases
            .sort_by_key(|detail| place(&|case| detail.name == case));
    }
}

/// True if a row belongs to a case: its runs are called `case/run`, its gates `case: gate`, its verdict as the case.
fn is_of(row: &Row, case: &str) -> bool {
    let rest = row.name.strip_prefix(case);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/') || rest.starts_with(": "))
}

fn is_aggregate(row: &Row, of: &str) -> bool {
    matches!(&row.kind, Kind::Aggregate { name } if name == of)
}
