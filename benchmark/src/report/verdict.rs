//! The verdict, first thing on the page.

use super::gates;
use super::html::escape;
use crate::record::Record;
use crate::record::details::{CaseDetail, GateDetail, RefinedDetail};
use crate::stability::extreme::ROWS as EXTREME;
use std::fmt::Write as _;

/// One word for the whole record.
pub fn word(record: &Record) -> &'static str {
    let gates = gates(record);
    if record.incomplete() {
        "INTERRUPTED"
    } else if gates.is_empty() && !record.details.refined.is_empty() {
        "error bars"
    } else if gates.is_empty() {
        "nothing was judged"
    } else if gates.iter().all(|gate| gate.passed) && failed_rows(record) == 0 {
        "PASS"
    } else {
        "FAIL"
    }
}

/// The verdict with what it rests on, and what failed.
pub fn html(record: &Record) -> String {
    let word = word(record);
    if word == "error bars" {
        return of_bars(record);
    }
    let class = if word == "PASS" {
        "verdict"
    } else {
        "verdict fail"
    };
    let all = gates(record);
    let passed = all.iter().filter(|gate| gate.passed).count();
    let mut of = vec![];
    match record.details.cases.len() {
        0 => {}
        1 => of.push("of 1 case with a known answer".to_owned()),
        n => of.push(format!("of {n} cases with a known answer")),
    }
    if record.details.stability.is_some() {
        of.push("of stability".to_owned());
    }
    let mut text = format!("{passed} of {} gates hold", all.len());
    if !of.is_empty() {
        let _ = write!(text, ", {}", of.join(" and "));
    }
    text.push('.');
    let failed = match failed_rows(record) {
        0 => String::new(),
        1 => " One run failed.".to_owned(),
        n => format!(" {n} runs failed."),
    };
    text.push_str(&failed);
    if record.incomplete() {
        text.push_str(" The record is incomplete: it was interrupted.");
    }
    let cases = &record.details.cases;
    let failing: Vec<String> = cases
        .iter()
        .filter(|case| !holds(case, record))
        .map(|case| {
            let name = escape(&case.name);
            format!("<a href=\"#case-{name}\">{name}</a>")
        })
        .collect();
    if !failing.is_empty() {
        let _ = write!(text, " Failed: {}.", failing.join(", "));
    }
    format!(
        "<div class=\"{class}\" role=\"status\"><strong>{}</strong> {text} <span class=\"soft\">A gate is a bound that a \
         result must keep, such as 1 % for the error against an exact solution.</span></div>\n",
        escape(word),
    )
}

/// The verdict of a record that holds refined scenes alone: how many of their values have a bar.
fn of_bars(record: &Record) -> String {
    let of = |scene: &RefinedDetail| {
        let [bars, all] = scene.bars;
        format!(
            "{bars} of {all} values of {} have a bar.",
            escape(&scene.scene)
        )
    };
    let scenes: Vec<String> = record.details.refined.iter().map(of).collect();
    format!(
        "<div class=\"verdict\" role=\"status\"><strong>error bars</strong> {}</div>\n",
        scenes.join(" ")
    )
}

/// Where and when it was measured, in a line.
pub fn whence(record: &Record) -> String {
    let said = |key: &str| record.context[key].as_str().map(escape);
    let mut whence = vec![];
    if let Some(commit) = said("commit") {
        let dirty = if record.context["dirty"] == true {
            ", with uncommitted changes"
        } else {
            ""
        };
        whence.push(format!("commit {}{dirty}", &commit[..commit.len().min(10)]));
    }
    whence.extend(said("date").map(|date| date.replace('T', " ").replace("+00:00", " UTC")));
    whence.extend(said("cpu_model"));
    whence.join(" · ")
}

/// Whether all gates of a case hold and all its runs were solved.
pub fn holds(case: &CaseDetail, record: &Record) -> bool {
    let mut runs = record.rows.iter().filter(|row| is_run_of(&row.name, case));
    case.gates.iter().all(|gate| gate.passed) && runs.all(|row| row.error.is_none())
}

/// The gate of a case that is nearest to its bound, as a share of it.
pub fn nearest(case: &CaseDetail) -> Option<&GateDetail> {
    let gates = case.gates.iter();
    gates.max_by(|a, b| a.used().total_cmp(&b.used()))
}

/// The nearest gate of all cases in a number and a sentence.
pub fn headline(record: &Record) -> Option<[String; 2]> {
    let ranked = gates::ranked(record);
    let (case, gate) = ranked.first()?;
    let [found, bound] = gates::of_case(gate);
    Some([
        crate::show::summary::share(gate.used()),
        format!(
            "of its bound is used up by the nearest gate, of {case}: {found} found, {bound} accepted"
        ),
    ])
}

fn is_run_of(name: &str, case: &CaseDetail) -> bool {
    name.strip_prefix(&case.name)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
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
            || record
                .details
                .cases
                .iter()
                .any(|case| is_run_of(name, case))
    };
    record
        .rows
        .iter()
        .filter(|row| row.error.is_some() && judged(&row.name))
        .filter(|row| matches!(row.kind, crate::record::Kind::Sample { .. }))
        .count()
}
