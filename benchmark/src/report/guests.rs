//! Other solvers, where the record has them.

use super::html::{Cell, Table, folded, paragraph};
use crate::record::gate::GateRow;
use crate::record::summary::{error_of, finest};
use crate::record::{Record, Row};
use crate::show::{percent, seconds};

/// Answer of the first screen: how many bounds hold.
#[must_use]
pub fn headline(record: &Record) -> Option<[String; 2]> {
    let finest = finest(record);
    let mut solvers: Vec<&str> = finest.iter().map(|(_, solver, _)| *solver).collect();
    solvers.sort_unstable();
    solvers.dedup();
    let gates = bounds(record);
    let held = gates.iter().filter(|gate| gate.holds()).count();
    (!solvers.is_empty()).then(|| {
        let names = solvers.join(", ");
        [
            format!("{held} of {}", gates.len()),
            format!("bounds of other solvers hold; measured: {names}"),
        ]
    })
}

/// True if a bound does not hold, or a run failed.
#[must_use]
pub fn failing(record: &Record) -> bool {
    let failed = |row: &Row| row.labels.contains_key("executable") && row.error.is_some();
    !bounds(record).iter().all(GateRow::holds) || record.rows.iter().any(failed)
}

/// The gates of solvers, which are named `solver/case`.
fn bounds(record: &Record) -> Vec<GateRow<'_>> {
    let finest = finest(record);
    let is_of = |gate: &GateRow<'_>, solver: &str, case: &str| {
        let rest = gate.case.strip_prefix(solver);
        rest.and_then(|rest| rest.strip_prefix('/')) == Some(case)
    };
    let of_solver = |gate: &GateRow<'_>| {
        finest
            .iter()
            .any(|(case, solver, _)| is_of(gate, solver, case))
    };
    record.gate_rows().filter(of_solver).collect()
}

/// The panel: the finest run of each solver on each case.
#[must_use]
pub fn panel(record: &Record) -> Option<String> {
    let finest = finest(record);
    if finest.is_empty() {
        return None;
    }
    let gates = bounds(record);
    let head = ["case, solver", "error", "at most", "CPU"];
    let caption = "Error of the finest run, and the processor time of its process";
    let mut table = Table::new(caption, &head);
    for (case, solver, row) in finest {
        let name = format!("{solver}/{case}");
        let gate = gates.iter().find(|gate| gate.case == name);
        let class = match gate {
            _ if row.error.is_some() => "failed",
            Some(gate) if !gate.holds() => "failed",
            Some(_) => "passed",
            None => "",
        };
        let bound = gate.and_then(|gate| gate.bound);
        let cells: [Cell; 4] = [
            Cell::linked(format!("{case}, {solver}"), format!("case-{case}")),
            error_of(row).into(),
            bound.map_or_else(|| "-".to_owned(), percent).into(),
            row.cpu().map_or_else(|| "-".to_owned(), seconds).into(),
        ];
        table.push_as(class, cells);
    }
    let mut html = table.html();
    let mut reasons: Vec<&str> = vec![];
    for row in record
        .rows
        .iter()
        .filter(|row| row.labels.contains_key("executable"))
    {
        if let Some(reason) = row.error.as_deref()
            && !reasons.contains(&reason)
        {
            reasons.push(reason);
        }
    }
    if !reasons.is_empty() {
        let lines: String = reasons.iter().map(|reason| paragraph(reason)).collect();
        html.push_str(&folded("why runs failed", &lines));
    }
    Some(html)
}
