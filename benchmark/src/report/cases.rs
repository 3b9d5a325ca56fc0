//! Verification cases: gates, runs, pictures.

use super::html::{Section, Table, escape, figures, paragraph};
use crate::record::details::{CaseDetail, GateDetail};
use crate::record::{Kind, Record};
use crate::show::{grouped, number, percent, seconds};
use std::fmt::Write as _;

/// The section, where the record holds cases.
pub fn section(record: &Record) -> Option<Section> {
    let cases = &record.details.cases;
    if cases.is_empty() {
        return None;
    }
    let mut body = String::new();
    for case in cases {
        let name = escape(&case.name);
        let _ = writeln!(body, "<h3 id=\"case-{name}\">{name}</h3>");
        body.push_str(&paragraph(&case.question));
        body.push_str(&gates(&case.gates));
        body.push_str(&runs(case, record).html());
        body.push_str(&figures(&case.figures));
        if !case.for_the_record.is_empty() {
            body.push_str("<details><summary>for the record</summary>\n");
            for line in &case.for_the_record {
                body.push_str(&paragraph(line));
            }
            body.push_str("</details>\n");
        }
    }
    Some(Section {
        id: "cases",
        title: "Cases with an exact answer".to_owned(),
        body,
    })
}

/// Gates with their reasons.
pub fn gates(gates: &[GateDetail]) -> String {
    let head = ["what is bounded", "", "found", "bound", "why this bound"];
    let mut table = Table::new("gates", &head);
    for gate in gates {
        let (class, word) = if gate.passed {
            ("passed", "PASS")
        } else {
            ("failed", "FAIL")
        };
        let cells = [
            gate.name.clone(),
            word.to_owned(),
            gate.value.map_or_else(|| "nothing".to_owned(), number),
            format!("{} {}", gate.relation, number(gate.bound)),
            gate.reason.clone(),
        ];
        table.push_as(class, cells);
    }
    table.html()
}

/// Errors and times of the runs of the ladder, as the rows have them.
fn runs(case: &CaseDetail, record: &Record) -> Table {
    let names = case.quantities.iter();
    let errors: Vec<String> = names.map(|[_, name]| format!("error of {name}")).collect();
    let head: Vec<&str> = ["run", "particles", "steps"]
        .into_iter()
        .chain(errors.iter().map(String::as_str))
        .chain(["wall", "CPU"])
        .collect();
    let mut table = Table::new("runs: relative error beside run time", &head);
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
