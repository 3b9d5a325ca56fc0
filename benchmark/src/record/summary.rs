//! A record in a few lines for a CI service: Markdown for the summary of a job, and a badge.

use super::gate::GateRow;
use super::{Kind, Record, Row};
use crate::show::comparison::escaped;
use crate::show::{number, percent, seconds};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Largest number of failing gates that the summary lists; the page has all of them.
const LISTED: usize = 20;

/// End of a record: finished, failed or interrupted.
struct State<'a> {
    gates: Vec<GateRow<'a>>,
    failed_runs: usize,
    incomplete: bool,
}

impl<'a> State<'a> {
    fn of(record: &'a Record) -> Self {
        let of_solvers = record.rows.iter().filter(|row| solver(row).is_some());
        Self {
            gates: record.gate_rows().collect(),
            failed_runs: of_solvers.filter(|row| row.error.is_some()).count(),
            incomplete: record.incomplete(),
        }
    }

    fn held(&self) -> usize {
        self.gates.iter().filter(|gate| gate.holds()).count()
    }

    fn passes(&self) -> bool {
        !self.incomplete && self.failed_runs == 0 && self.held() == self.gates.len()
    }

    fn words(&self) -> String {
        let mut text = format!("{} of {} gates hold", self.held(), self.gates.len());
        match self.failed_runs {
            0 => {}
            1 => text.push_str(", 1 run failed"),
            n => {
                let _ = write!(text, ", {n} runs failed");
            }
        }
        if self.incomplete {
            text.push_str(", interrupted");
        }
        text
    }
}

/// The solver of a row of another program.
fn solver(row: &Row) -> Option<&str> {
    row.labels.get("executable").map(String::as_str)
}

/// A badge as the endpoint of shields.io takes it.
#[must_use]
pub fn badge(record: &Record) -> Value {
    let state = State::of(record);
    let (message, colour) = match (state.passes(), state.gates.is_empty()) {
        (true, true) => ("measured".to_owned(), "blue"),
        (true, false) => (state.words(), "brightgreen"),
        (false, _) => (state.words(), "red"),
    };
    json!({ "schemaVersion": 1, "label": "Proctor", "message": message, "color": colour })
}

/// The verdict, what does not hold, and a table of other solvers, as Markdown.
#[must_use]
pub fn markdown(record: &Record) -> String {
    let state = State::of(record);
    let word = if state.passes() { "PASS" } else { "FAIL" };
    let mut text = format!("### Proctor: {word}, {}\n", state.words());
    let failing: Vec<&GateRow<'_>> = state.gates.iter().filter(|gate| !gate.holds()).collect();
    if !failing.is_empty() {
        text.push_str("\n| gate that does not hold | found | bound |\n|---|--:|--:|\n");
        for gate in failing.iter().take(LISTED) {
            let written =
                |value: Option<f64>| value.map_or_else(|| "nothing".to_owned(), |x| x.to_string());
            let _ = writeln!(
                text,
                "| {}: {} | {} | {} {} |",
                escaped(gate.case),
                escaped(gate.name),
                written(gate.value),
                gate.side,
                written(gate.bound)
            );
        }
        if failing.len() > LISTED {
            let _ = writeln!(text, "\nand {} more", failing.len() - LISTED);
        }
    }
    text.push_str(&solvers(record));
    text
}

/// The finest run of each solver on each case, by case and solver.
#[must_use]
pub fn finest(record: &Record) -> Vec<(&str, &str, &Row)> {
    let mut finest: BTreeMap<(&str, &str), (f64, &Row)> = BTreeMap::new();
    for row in &record.rows {
        let (Some(solver), Some(case)) = (solver(row), row.labels.get("case")) else {
            continue;
        };
        let cell = row
            .counters
            .get("cell_size")
            .copied()
            .unwrap_or(f64::INFINITY);
        if matches!(row.kind, Kind::Sample { .. }) {
            let known = finest.entry((case, solver)).or_insert((cell, row));
            if cell < known.0 {
                *known = (cell, row);
            }
        }
    }
    finest
        .into_iter()
        .map(|((case, solver), (_, row))| (case, solver, row))
        .collect()
}

/// The error of a run, in words.
#[must_use]
pub fn error_of(row: &Row) -> String {
    let error = row
        .counters
        .iter()
        .find(|(key, _)| key.starts_with("error_"));
    match (&row.error, error) {
        (Some(_), _) => "failed".to_owned(),
        (None, Some((_, error))) => percent(*error),
        // A number that is reported is no error.
        (None, None) => row.reported().map_or_else(
            || "-".to_owned(),
            |found| format!("{} {}", found.name, number(found.value)),
        ),
    }
}

/// The finest runs as a table, and why runs failed.
fn solvers(record: &Record) -> String {
    let finest = finest(record);
    if finest.is_empty() {
        return String::new();
    }
    let mut text =
        "\n| case | solver | error, finest run | CPU | particles |\n|---|---|--:|--:|--:|\n"
            .to_owned();
    for (case, solver, row) in finest {
        let error = error_of(row);
        let count = row.counters.get("particles");
        let _ = writeln!(
            text,
            "| {} | {} | {error} | {} | {} |",
            escaped(case),
            escaped(solver),
            row.cpu().map_or_else(|| "-".to_owned(), seconds),
            count.map_or_else(
                || "-".to_owned(),
                |count| crate::show::grouped(*count as u64)
            ),
        );
    }
    let told = |row: &Row| {
        let (solver, reason) = (solver(row)?, row.error.as_deref()?);
        let case = row.labels.get("case").map_or("", String::as_str);
        Some(format!("{case}, {solver}: {reason}"))
    };
    let mut reasons: Vec<String> = record.rows.iter().filter_map(told).collect();
    reasons.dedup();
    for reason in reasons.iter().take(LISTED) {
        let _ = writeln!(text, "\n- {}", escaped(reason));
    }
    text
}
