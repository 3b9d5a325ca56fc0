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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Spent;
    use crate::suite::{CaseRun, RanRung};
    use proctor_scene::simulation::Options;
    use proctor_verification::case::{self, CaseError, Gate, RungResult, Verdict};

    fn of(name: &str) -> &'static Case {
        let found = case::all().iter().find(|case| case.name() == name);
        found.expect("there is such a case")
    }

    /// A record of a case of which so many runs were made, the last of them failed if `fails`; its gate found 1 of `bound`.
    fn record(name: &str, runs: usize, fails: bool, bound: f64) -> Record {
        let case = of(name);
        let ladder = case.rungs(Size::Quick);
        let last = ladder.len() - 1;
        let solved = || RungResult {
            particles: 4,
            steps: 2,
            time: 0.1,
            quantities: vec![],
            drawings: vec![],
            curve: None,
        };
        let rungs = ladder
            .into_iter()
            .enumerate()
            .take(runs)
            .map(|(i, rung)| RanRung {
                solved: if fails && i == last {
                    Err(CaseError::new(case.name(), &rung, &"a reason".into()))
                } else {
                    Ok(solved())
                },
                rung,
                samples: vec![Spent::default()],
            });
        let gate = Gate::at_most("error".to_owned(), 1.0, bound, "a reason");
        let ran = CaseRun {
            case,
            rungs: rungs.collect(),
            verdict: Verdict {
                gates: vec![gate],
                ..Verdict::default()
            },
            faults: vec![],
        };
        let mut record = Record::new(&Options::default());
        record.push_case(&ran, 1);
        record
    }

    #[test]
    fn a_case_is_missing_failed_or_held() {
        let all = of("hertz").rungs(Size::Quick).len();
        let state = |record: &Record| record.case_state(of("hertz"), Size::Quick);
        assert_eq!(state(&record("hertz", all, false, 2.0)), CaseState::Held);
        assert_eq!(state(&record("hertz", all, true, 2.0)), CaseState::Failed);
        assert_eq!(state(&record("hertz", all, false, 0.5)), CaseState::Failed);
        // Interrupted in its midst, or never begun; its short ladder is not its full one.
        assert_eq!(
            state(&record("hertz", all - 1, false, 2.0)),
            CaseState::Missing
        );
        assert_eq!(state(&record("bar", 9, false, 2.0)), CaseState::Missing);
        let full = record("hertz", all, false, 2.0);
        assert_eq!(full.case_state(of("hertz"), Size::Full), CaseState::Missing);
    }

    #[test]
    fn a_case_whose_name_begins_another_is_told_from_it() {
        let mut both = record("hertz", 9, false, 2.0);
        both.rows.extend(record("hertz-slab", 9, false, 0.5).rows);
        assert_eq!(both.case_state(of("hertz"), Size::Quick), CaseState::Held);
        assert_eq!(
            both.case_state(of("hertz-slab"), Size::Quick),
            CaseState::Failed
        );
        assert_eq!(both.gates_of("hertz"), 1);
        assert!(both.holds_more_than(&["hertz"]));
        assert!(!both.holds_more_than(&["hertz", "hertz-slab"]));
        let first = both.rows[0].name.clone();
        both.sort_cases(&["hertz-slab", "hertz"]);
        assert!(both.rows[0].name.starts_with("hertz-slab"));
        both.keep_cases(&["hertz"]);
        assert_eq!(both.rows[0].name, first);
        assert!(!both.holds_more_than(&["hertz"]));
    }

    #[test]
    fn what_was_asked_for_is_said_where_it_is_not_all() {
        let mut record = Record::new(&Options::default());
        assert_eq!(record.cases_asked(), None);
        record.set_cases(&["bar"], 1);
        assert_eq!(record.cases_asked(), None);
        record.set_cases(&["bar"], 2);
        assert_eq!(record.cases_asked(), Some(vec!["bar"]));
        let mut other = Record::new(&Options::default());
        other.set_cases(&["hertz", "bar"], 9);
        record.join_cases(&other);
        assert_eq!(record.cases_asked(), Some(vec!["bar", "hertz"]));
        record.join_cases(&Record::new(&Options::default()));
        assert_eq!(record.cases_asked(), None);
    }
}
