//! The verdict, first thing on the page.

use super::gates;
use super::html::escape;
use super::since::Since;
use super::whole::PageVerdict;
use crate::record::details::{CaseDetail, GateDetail, RefinedDetail};
use crate::record::{Kind, Record, Row};
use crate::stability::extreme::ROWS as EXTREME;
use std::fmt::Write as _;

/// The verdict over the whole record, and over what changed since another one.
pub fn of(record: &Record, since: Option<&Since<'_>>) -> PageVerdict {
    PageVerdict::of(record, &gates(record), failed_rows(record), since)
}

/// The verdict with what it rests on, and what failed.
pub fn html(record: &Record, since: Option<&Since<'_>>) -> String {
    let verdict = of(record, since);
    let (word, class) = (verdict.word(), verdict.class());
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
    let mut text = if all.is_empty() {
        format!("{}, and nothing of it has a bound.", measured(record))
    } else {
        let of = if of.is_empty() {
            String::new()
        } else {
            format!(", {}", of.join(" and "))
        };
        format!("{passed} of {} gates hold{of}.", all.len())
    };
    match verdict {
        PageVerdict::Worse => {
            text.push_str(" <a href=\"#since\">Something is worse than before.</a>");
        }
        PageVerdict::NotCompared => {
            text.push_str(
                " <a href=\"#since\">Not all could be compared with the record before.</a>",
            );
        }
        _ => {}
    }
    text.push_str(&of_bars(record));
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

/// The scenes with error bars, in a sentence each; empty where there are none.
fn of_bars(record: &Record) -> String {
    let of = |scene: &RefinedDetail| {
        let [bars, all] = scene.bars;
        format!(
            " {bars} of {all} values of {} have a bar.",
            escape(&scene.scene)
        )
    };
    record.details.refined.iter().map(of).collect()
}

/// Numbers of the runs and cases that were measured.
fn measured(record: &Record) -> String {
    let is_run = |row: &&Row| matches!(row.kind, Kind::Sample { .. }) && row.error.is_none();
    let runs = record.rows.iter().filter(is_run).count();
    let mut studied: Vec<&str> = record
        .details
        .studies
        .iter()
        .map(|study| study.case.as_str())
        .collect();
    studied.dedup();
    let runs = match runs {
        1 => "1 run was measured".to_owned(),
        n => format!("{n} runs were measured"),
    };
    match studied.len() {
        0 => runs,
        1 => format!("{runs} on 1 case"),
        n => format!("{runs} on {n} cases"),
    }
}

/// Place and date of the measurement, in a line.
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

/// True if all gates of a case hold and all its runs were solved.
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

/// Runs of judged cases and of other solvers that failed; sweeps that look for the bounds of a method may fail.
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
        .filter(|row| row.error.is_some())
        .filter(|row| judged(&row.name) || row.labels.contains_key("executable"))
        .filter(|row| matches!(row.kind, Kind::Sample { .. }))
        .count()
}
