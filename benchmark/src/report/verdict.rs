//! The verdict, first thing on the page.

use super::html::escape;
use crate::record::Record;
use crate::record::details::GateDetail;
use crate::stability::extreme::ROWS as EXTREME;

/// One word for the whole record.
pub fn word(record: &Record) -> &'static str {
    let gates = gates(record);
    if record.incomplete() {
        "INTERRUPTED"
    } else if gates.is_empty() {
        "nothing was judged"
    } else if gates.iter().all(|gate| gate.passed) && failed_rows(record) == 0 {
        "PASS"
    } else {
        "FAIL"
    }
}

/// The verdict with what it rests on.
pub fn html(record: &Record) -> String {
    let word = word(record);
    let class = if word == "PASS" {
        "verdict"
    } else {
        "verdict fail"
    };
    let gates = gates(record);
    let passed = gates.iter().filter(|gate| gate.passed).count();
    let mut text = format!(
        "{passed} of {} gates in {} cases.",
        gates.len(),
        record.details.cases.len()
    );
    if record.details.stability.is_some() {
        text.truncate(text.len() - 1);
        text.push_str(" and of stability.");
    }
    let failed = match failed_rows(record) {
        0 => String::new(),
        1 => " One run failed.".to_owned(),
        n => format!(" {n} runs failed."),
    };
    text.push_str(&failed);
    if record.incomplete() {
        text.push_str(" The record is incomplete: it was interrupted.");
    }
    let said = |key: &str| record.context[key].as_str().map(escape);
    let mut whence = vec![];
    if let Some(commit) = said("commit") {
        let dirty = if record.context["dirty"] == true {
            ", with changes"
        } else {
            ""
        };
        whence.push(format!("commit {}{dirty}", &commit[..commit.len().min(12)]));
    }
    whence.extend(said("date"));
    whence.extend(said("cpu_model"));
    whence.extend(said("lanes").map(|lanes| format!("{lanes} lanes")));
    format!(
        "<div class=\"{class}\" role=\"status\"><strong>{}</strong> {text}<br>\
         <span class=\"soft\">{}</span></div>\n",
        escape(word),
        whence.join(" · ")
    )
}

fn gates(record: &Record) -> Vec<&GateDetail> {
    let cases = record.details.cases.iter().flat_map(|case| &case.gates);
    let stability = record.details.stability.iter();
    let of_stability = stability.flat_map(|detail| {
        let extreme = detail.extreme.iter().flat_map(|row| &row.gates);
        detail.gates.iter().chain(extreme)
    });
    cases.chain(of_stability).collect()
}

/// Runs of judged cases that failed; sweeps that look for the bounds of stability may fail.
fn failed_rows(record: &Record) -> usize {
    let judged = |name: &str| {
        name.starts_with(EXTREME)
            || record.details.cases.iter().any(|case| {
                name.strip_prefix(&case.name)
                    .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
            })
    };
    record
        .rows
        .iter()
        .filter(|row| row.error.is_some() && judged(&row.name))
        .filter(|row| matches!(row.kind, crate::record::Kind::Sample { .. }))
        .count()
}
