//! Where each method is stable.

use super::html::{Section, Table, paragraph};
use crate::record::Record;
use crate::show::{number, picture};
use crate::stability::{ExtremeDetail, StabilityCell};

/// The section, where the record holds a map.
pub fn section(record: &Record) -> Option<Section> {
    let detail = record.details.stability.as_ref()?;
    let mut body = String::new();
    if !detail.cells.is_empty() {
        body.push_str(&paragraph(
            "The largest stable step, predicted from the linear part of the kernel's own step and measured by runs with \
             noise, of blocks, thin bodies and single particles at nineteen places on the mesh. Hovering over a cell shows \
             what rules it.",
        ));
        body.push_str("<figure>\n");
        body.push_str(&picture::svg(detail));
        body.push_str("<figcaption>The number is the largest safe c dt/h.</figcaption>\n");
        body.push_str("<details><summary>the numbers</summary>\n");
        body.push_str(&cells(&detail.cells));
        body.push_str("</details>\n</figure>\n");
    }
    if !detail.nonlinear.is_empty() {
        let head = [
            "not linear",
            "kernel's c dt/h",
            "stable to, over it",
            "unstable from",
            "energy",
            "cause",
        ];
        let mut table = Table::new("large strain, rotation, contact, moving base", &head);
        for line in &detail.nonlinear {
            table.push(line.iter().cloned());
        }
        body.push_str(&table.html());
    }
    let failing: Vec<_> = detail
        .gates
        .iter()
        .filter(|gate| !gate.passed)
        .cloned()
        .collect();
    if !failing.is_empty() {
        body.push_str(&super::cases::gates(&failing));
    }
    for failure in &detail.failures {
        body.push_str(&paragraph(failure));
    }
    if !detail.extreme.is_empty() {
        body.push_str(&extreme(&detail.extreme));
    }
    Some(Section {
        id: "stability",
        title: "Stability".to_owned(),
        body,
    })
}

/// The cells of the map as a table.
fn cells(cells: &[StabilityCell]) -> String {
    let head = [
        "weighting",
        "gates",
        "scheme",
        "transfer",
        "particles per cell and axis",
        "safe c dt/h",
        "ruled by a",
        "measured over predicted",
        "kernel's c dt/h",
    ];
    let mut table = Table::new("largest safe c dt/h", &head);
    for cell in cells {
        let (class, gates) = if cell.passed {
            ("passed", "hold")
        } else {
            ("failed", "fail")
        };
        let row = [
            cell.weighting.clone(),
            gates.to_owned(),
            cell.scheme.clone(),
            cell.transfer.clone(),
            cell.particles_per_cell.to_string(),
            number(cell.safe),
            cell.ruled_by.clone(),
            cell.ratio.map_or_else(|| "not measured".to_owned(), number),
            number(cell.kernel),
        ];
        table.push_as(class, row);
    }
    table.html()
}

/// The stiff and extreme scenes: how each ended, and all gates of those that failed.
fn extreme(rows: &[ExtremeDetail]) -> String {
    let head = [
        "scene",
        "ended",
        "what is extreme",
        "what must be",
        "nearest to its bound",
        "found",
        "bound",
        "refused",
    ];
    let mut table = Table::new("stiff and extreme scenes", &head);
    for row in rows {
        let class = if row.passed { "passed" } else { "failed" };
        let worst = row.worst();
        let cells = [
            row.name.clone(),
            row.ending.clone(),
            row.what.clone(),
            row.required.clone(),
            worst.map_or_else(String::new, |gate| gate.name.clone()),
            worst.map_or_else(String::new, |gate| {
                gate.value.map_or_else(|| "nothing".to_owned(), number)
            }),
            worst.map_or_else(String::new, |gate| {
                format!("{} {}", gate.relation, number(gate.bound))
            }),
            match row.refusals.first() {
                Some(first) => format!("{}, such as: {first}", row.refusals.len()),
                None => String::new(),
            },
        ];
        table.push_as(class, cells);
    }
    let mut html = table.html();
    for row in rows.iter().filter(|row| !row.passed) {
        let why = row.unexpected.iter().chain(&row.cause);
        for line in why {
            html.push_str(&paragraph(&format!("{}: {line}", row.name)));
        }
        let failing: Vec<_> = row
            .gates
            .iter()
            .filter(|gate| !gate.passed)
            .cloned()
            .collect();
        if !failing.is_empty() {
            html.push_str(&super::cases::gates(&failing));
        }
    }
    html
}
