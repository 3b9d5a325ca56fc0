//! The record as a page shows it: gates judged from their rows, and cases of which only rows are kept made whole.

use super::since::Since;
use crate::judge::Verdict;
use crate::record::details::{CaseDetail, GateDetail};
use crate::record::gate::GateRow;
use crate::record::{Kind, Record};
use crate::stability::extreme::ROWS as EXTREME;
use proctor_verification::case;
use std::collections::BTreeMap;

/// Case of the gates of the map of stability.
const STABILITY: &str = "stability";

/// The record with its details judged from the rows. A verdict that somebody stored, or a row that somebody changed, cannot
/// make a page kinder than `compare` is.
#[must_use]
pub fn whole(record: &Record) -> Record {
    let mut whole = record.clone();
    let rows: BTreeMap<(&str, &str), GateRow<'_>> = record
        .gate_rows()
        .map(|gate| ((gate.case, gate.name), gate))
        .collect();
    let details = &mut whole.details;
    for case in &mut details.cases {
        judge(&case.name, &mut case.gates, &rows);
    }
    if let Some(stability) = &mut details.stability {
        judge(STABILITY, &mut stability.gates, &rows);
        for row in &mut stability.extreme {
            judge(&format!("{EXTREME}{}", row.name), &mut row.gates, &rows);
            row.passed &= row.gates.iter().all(|gate| gate.passed);
        }
    }
    for gate in record.gate_rows() {
        if gate.case == STABILITY || gate.case.starts_with(EXTREME) {
            continue;
        }
        let at = details.cases.iter().position(|case| case.name == gate.case);
        let at = at.unwrap_or_else(|| {
            details.cases.push(of_rows(record, gate.case));
            details.cases.len() - 1
        });
        let gates = &mut details.cases[at].gates;
        if !gates.iter().any(|known| known.name == gate.name) {
            gates.push(GateDetail {
                name: gate.name.to_owned(),
                value: gate.value,
                relation: gate.side.to_owned(),
                bound: gate.bound.unwrap_or(f64::NAN),
                reason: String::new(),
                passed: gate.holds(),
            });
        }
    }
    whole
}

/// Judges the gates of a case: by their rows, and one that has none by its own numbers.
fn judge(case: &str, gates: &mut [GateDetail], rows: &BTreeMap<(&str, &str), GateRow<'_>>) {
    for gate in gates {
        if let Some(row) = rows.get(&(case, gate.name.as_str())) {
            gate.value = row.value;
            row.side.clone_into(&mut gate.relation);
            gate.bound = row.bound.unwrap_or(f64::NAN);
            gate.passed = row.holds();
        } else {
            let holds = |value: f64| {
                if gate.relation == "at least" {
                    value >= gate.bound
                } else {
                    value <= gate.bound
                }
            };
            gate.passed = gate.value.is_some_and(holds);
        }
    }
}

/// A case without details, from its rows.
fn of_rows(record: &Record, name: &str) -> CaseDetail {
    let known = case::all().iter().find(|case| case.name() == name);
    let mut quantities: Vec<[String; 2]> = vec![];
    for row in &record.rows {
        let of_case = row
            .name
            .strip_prefix(name)
            .is_some_and(|rest| rest.starts_with('/'));
        if !of_case || !matches!(row.kind, Kind::Sample { .. }) {
            continue;
        }
        for key in row.counters.keys() {
            if let Some(key) = key.strip_prefix("error_") {
                let entry = [key.to_owned(), key.replace('_', " ")];
                if !quantities.contains(&entry) {
                    quantities.push(entry);
                }
            }
        }
    }
    CaseDetail {
        name: name.to_owned(),
        question: known.map_or_else(String::new, |case| case.question().to_owned()),
        quantities,
        gates: vec![],
        figures: vec![],
        for_the_record: vec![],
    }
}

/// The verdict of a page: of the gates and runs of the record, and of what changed since another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageVerdict {
    /// The work was interrupted.
    Interrupted,
    /// A gate does not hold, or a run failed.
    Fail,
    /// All holds, and something is worse than in the record to compare with.
    Worse,
    /// All holds; not all could be compared with the other record.
    NotCompared,
    /// All holds.
    Pass,
    /// Nothing has a bound.
    Measured,
}

impl PageVerdict {
    /// Verdict of a record that was made whole; `failed` of its runs failed.
    #[must_use]
    pub fn of(
        record: &Record,
        gates: &[&GateDetail],
        failed: usize,
        since: Option<&Since<'_>>,
    ) -> Self {
        let changed = since.map(|since| since.comparison().verdict());
        if record.incomplete() {
            Self::Interrupted
        } else if failed > 0 || !gates.iter().all(|gate| gate.passed) {
            Self::Fail
        } else if changed == Some(Verdict::Worse) {
            Self::Worse
        } else if changed == Some(Verdict::CannotCompare) {
            Self::NotCompared
        } else if gates.is_empty() {
            Self::Measured
        } else {
            Self::Pass
        }
    }

    /// The word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Interrupted => "INTERRUPTED",
            Self::Fail => "FAIL",
            Self::Worse => "WORSE",
            Self::NotCompared => "PASS, NOT COMPARED",
            Self::Pass => "PASS",
            Self::Measured => "MEASURED",
        }
    }

    /// The look of the line.
    #[must_use]
    pub fn class(self) -> &'static str {
        match self {
            Self::Pass => "verdict",
            Self::Measured => "verdict plain",
            Self::NotCompared => "verdict near",
            Self::Interrupted | Self::Fail | Self::Worse => "verdict fail",
        }
    }
}
