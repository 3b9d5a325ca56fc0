//! Verification cases: an index, and all of each case behind a line that unfolds it.

use super::cheapest::Costs;
use super::gates;
use super::html::{Cell, Pictures, Section, Table, escape, folded, paragraph};
use super::packed::packed;
use super::{plans, studies, verdict};
use crate::record::details::CaseDetail;
use crate::record::{Kind, Record};
use crate::show::{grouped, percent, seconds};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The section, where the record holds cases or studies.
pub fn section(record: &Record, pictures: &mut Pictures) -> Option<Section> {
    let names = names(record);
    if names.is_empty() {
        return None;
    }
    let mut body = index(record, &names);
    for name in &names {
        let case = record.details.cases.iter().find(|case| case.name == *name);
        body.push_str(&one(record, name, case, pictures));
    }
    Some(Section {
        id: "cases",
        title: "Cases".to_owned(),
        body,
    })
}

/// Names of the cases that were verified, then of those that were studied alone.
fn names(record: &Record) -> Vec<&str> {
    let cases = record.details.cases.iter().map(|case| case.name.as_str());
    let studied = record.details.studies.iter().map(|s| s.case.as_str());
    let mut known = BTreeSet::new();
    cases
        .chain(studied)
        .filter(|name| known.insert(*name))
        .collect()
}

/// A line per case, in the order of the record.
fn index(record: &Record, names: &[&str]) -> String {
    let costs = Costs::all(record);
    let studied = !costs.is_empty();
    let mut head = vec!["case", "", "gates that hold", "nearest to its bound"];
    if studied {
        head.push("cheapest for 1 %");
    }
    head.push("asks");
    let mut table = Table::new("Index of the cases; a click opens one", &head);
    for name in names {
        let case = record.details.cases.iter().find(|case| case.name == *name);
        let class = match case.map(|case| verdict::holds(case, record)) {
            Some(true) => "passed",
            Some(false) => "failed",
            None => "",
        };
        let word = match class {
            "passed" => "PASS",
            "failed" => "FAIL",
            _ => "not judged",
        };
        let mut cells: Vec<Cell> = vec![
            Cell::linked(*name, format!("case-{name}")),
            word.into(),
            case.map_or_else(String::new, held).into(),
            case.and_then(verdict::nearest)
                .map_or_else(Cell::default, gates::used),
        ];
        if studied {
            let first = costs.iter().find(|costs| costs.case == *name);
            let said = |costs: &Costs| match costs.said(0) {
                missed if missed == "not reached" => {
                    format!("{missed}: {} at best", costs.at_best())
                }
                method => method,
            };
            cells.push(first.map_or_else(String::new, said).into());
        }
        cells.push(question(record, name).into());
        table.push_as(class, cells);
    }
    table.html()
}

fn held(case: &CaseDetail) -> String {
    let held = case.gates.iter().filter(|gate| gate.passed).count();
    format!("{held} of {}", case.gates.len())
}

fn question<'a>(record: &'a Record, name: &str) -> &'a str {
    let cases = record.details.cases.iter();
    let of_case = cases.filter(|case| case.name == name).map(|c| &c.question);
    let studies = record.details.studies.iter();
    let of_study = studies.filter(|s| s.case == name).map(|s| &s.question);
    of_case.chain(of_study).next().map_or("", String::as_str)
}

/// All of a case: open where it fails.
fn one(record: &Record, name: &str, case: Option<&CaseDetail>, pictures: &mut Pictures) -> String {
    let failed = case.is_some_and(|case| !verdict::holds(case, record));
    let (open, mark) = match (case, failed) {
        (_, true) => (" open", "✗"),
        (Some(_), false) => ("", "✓"),
        (None, _) => ("", "·"),
    };
    let class = if failed { "case failed" } else { "case" };
    let gates_held = case.map_or_else(|| "studied alone".to_owned(), |c| held(c) + " gates hold");
    let mut html = format!(
        "<details class=\"{class}\" id=\"case-{0}\"{open}><summary><span class=\"mark\">{mark}</span> <strong>{0}</strong> \
         <span class=\"soft\">{gates_held}</span></summary>\n",
        escape(name)
    );
    html.push_str(&paragraph(question(record, name)));
    if let Some(case) = case {
        let caption = format!("Gates of {name}, in the order of the case");
        html.push_str(&gates::table(&caption, &case.gates, gates::of_case).html());
    }
    html.push_str(&studies::of_case(record, name, failed, pictures));
    if let Some(case) = case {
        let _ = writeln!(
            html,
            "<h3>{}: runs with their own settings</h3>",
            escape(name)
        );
        html.push_str(&runs(case, record).html());
        html.push_str(&paragraph(
            "Errors are relative to the exact solution. L2: root of the mean square over the particles. Clock and processor \
             time are those of the whole run.",
        ));
        let figures = pictures.several(name, &case.figures);
        html.push_str(&if failed { figures } else { packed(&figures) });
        if !case.for_the_record.is_empty() {
            let lines: String = case.for_the_record.iter().map(|l| paragraph(l)).collect();
            html.push_str(&folded("for the record, not judged", &lines));
        }
    }
    html.push_str(&plans::of_case(record, name));
    html.push_str("</details>\n");
    html
}

/// Errors and times of the runs of the ladder, as the rows have them.
fn runs(case: &CaseDetail, record: &Record) -> Table {
    let names = case.quantities.iter();
    let errors: Vec<String> = names.map(|[_, name]| format!("error of {name}")).collect();
    let head: Vec<&str> = ["run", "particles", "steps"]
        .into_iter()
        .chain(errors.iter().map(String::as_str))
        .chain(["clock", "processor"])
        .collect();
    let caption = format!("Runs of {}: relative error beside run time", case.name);
    let mut table = Table::new(&caption, &head);
    for row in &record.rows {
        let run = row.name.strip_prefix(&case.name);
        let Some(run) = run.and_then(|rest| rest.strip_prefix('/')) else {
            continue;
        };
        if !matches!(row.kind, Kind::Sample { .. }) {
            continue;
        }
        let count = |key: &str| {
            let value = row.counters.get(key);
            value.map_or_else(String::new, |n| grouped(*n as u64))
        };
        if let Some(error) = &row.error {
            table.push_as("failed", [run.to_owned(), format!("failed: {error}")]);
            continue;
        }
        let mut cells = vec![run.to_owned(), count("particles"), count("steps")];
        for [key, _] in &case.quantities {
            let error = row.counters.get(&format!("error_{key}"));
            cells.push(error.map_or_else(String::new, |error| percent(*error)));
        }
        if let Some(spent) = row.spent {
            cells.push(seconds(spent.wall.as_secs_f64()));
            cells.push(seconds(spent.cpu.as_secs_f64()));
        }
        table.push(cells);
    }
    table
}
