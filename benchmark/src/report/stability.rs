//! Stability of each method.

use super::gates;
use super::html::{Section, Table, escape, folded, paragraph};
use crate::record::Record;
use crate::show::stability::{courant, sizes, words};
use crate::show::{number, picture};
use crate::stability::{ExtremeDetail, StabilityCell, StabilityDetail};
use std::fmt::Write as _;

/// Meaning of c dt/h.
const COURANT: &str =
    "c dt/h: the way that a wave (speed c) goes in a time step (dt), in cells (size h).";

/// True if a gate of stability does not hold, or something could not be done.
#[must_use]
pub fn failing(record: &Record) -> bool {
    let detail = record.details.stability.as_ref();
    detail.is_some_and(|detail| {
        let gates = detail.gates.iter().all(|gate| gate.passed);
        let extreme = detail.extreme.iter().all(|row| row.passed);
        !(gates && extreme && detail.failures.is_empty())
    })
}

/// Gates that hold, and what they are about, in a number and a sentence.
#[must_use]
pub fn headline(record: &Record) -> Option<[String; 2]> {
    let detail = record.details.stability.as_ref()?;
    let passed = detail.extreme.iter().filter(|row| row.passed).count();
    let scenes = format!("{passed} of {}", detail.extreme.len());
    if detail.cells.is_empty() && !detail.extreme.is_empty() {
        return Some([
            scenes,
            "stiff and extreme scenes end as they should".to_owned(),
        ]);
    }
    let held = detail.gates.iter().filter(|gate| gate.passed).count();
    let mut text = format!(
        "gates of stability hold; {} methods measured",
        detail.cells.len()
    );
    let without_step = detail.cells.iter().filter(|cell| cell.warned).count();
    if without_step > 0 {
        let _ = write!(
            text,
            ", {without_step} of them without a step that is safe for every body"
        );
    }
    if !detail.extreme.is_empty() {
        let _ = write!(
            text,
            "; {scenes} stiff and extreme scenes end as they should"
        );
    }
    Some([format!("{held} of {}", detail.gates.len()), text])
}

/// The panel of the first screen: the largest safe step of each method as small tables, one per transfer.
#[must_use]
pub fn panel(record: &Record) -> Option<String> {
    let detail = record.details.stability.as_ref()?;
    let size = *sizes(&detail.cells)
        .iter()
        .min_by_key(|size| size.abs_diff(2))?;
    let mut html = String::from("<div class=\"maps\">\n");
    for transfer in words(&detail.cells, |cell| &cell.transfer) {
        html.push_str(&small_map(detail, transfer, size));
    }
    html.push_str("</div>\n");
    html.push_str(&paragraph(&format!(
        "The largest stable time step, {size} particles per cell and axis, as {COURANT} Rows: weighting functions; columns: \
         time of the stress update. Grey: no step is safe for every body, and the program warns. Red: a gate fails."
    )));
    if !detail.nonlinear.is_empty() {
        let gates = detail.gates.iter();
        let of_scenes: Vec<_> = gates
            .filter(|gate| gate.name.contains(": energy"))
            .collect();
        let held = of_scenes.iter().filter(|gate| gate.passed).count();
        html.push_str(&paragraph(&format!(
            "{held} of {} scenes with large strain, rotation, contact or a moving base are stable at the step that the \
             program chooses.",
            of_scenes.len()
        )));
    }
    Some(html)
}

fn small_map(detail: &StabilityDetail, transfer: &str, size: usize) -> String {
    let schemes = words(&detail.cells, |cell| &cell.scheme);
    let mut html = format!(
        "<table class=\"map\"><caption>{}</caption><thead><tr><th></th>",
        escape(transfer)
    );
    for scheme in &schemes {
        let _ = write!(html, "<th scope=\"col\">{}</th>", escape(scheme));
    }
    html.push_str("</tr></thead><tbody>");
    for weighting in words(&detail.cells, |cell| &cell.weighting) {
        let _ = write!(html, "<tr><th scope=\"row\">{}</th>", escape(weighting));
        for scheme in &schemes {
            let cell = detail.cells.iter().find(|cell| {
                cell.transfer == transfer
                    && cell.weighting == weighting
                    && cell.scheme == *scheme
                    && cell.particles_per_cell == size
            });
            let (class, text) = match cell {
                None => ("none", "–".to_owned()),
                Some(cell) if !cell.passed => ("bad", courant(cell.safe)),
                Some(cell) if cell.warned => ("warned", courant(cell.safe)),
                Some(cell) => ("good", courant(cell.safe)),
            };
            let _ = write!(html, "<td class=\"{class}\">{text}</td>");
        }
        html.push_str("</tr>");
    }
    html.push_str("</tbody></table>\n");
    html
}

/// The section, where the record holds a map.
pub fn section(record: &Record) -> Option<Section> {
    let detail = record.details.stability.as_ref()?;
    let mut body = String::new();
    if !detail.cells.is_empty() {
        body.push_str(&paragraph(&format!(
            "The largest stable step, predicted from the linear part of the kernel's own step and measured by runs with \
             noise, of blocks, thin bodies and single particles at nineteen places on the mesh. Hovering over a cell shows \
             what rules it. {COURANT}"
        )));
        body.push_str("<figure>\n");
        body.push_str(&picture::svg(detail));
        body.push_str("<figcaption>The number is the largest safe c dt/h.</figcaption>\n");
        body.push_str("<details class=\"numbers\"><summary>the numbers</summary>\n");
        body.push_str(&cells(&detail.cells));
        body.push_str("</details>\n</figure>\n");
    }
    if !detail.nonlinear.is_empty() {
        let head = [
            "scene and method",
            "kernel's c dt/h",
            "stable up to, over it",
            "unstable from, over it",
            "energy over that at half the step",
            "what fails first",
        ];
        let caption =
            "Large strain, rotation, contact, moving base: the step may be so many times as long";
        let mut table = Table::new(caption, &head);
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
        let caption = "Gates of stability that do not hold";
        body.push_str(&gates::table(caption, &failing, gates::plain).html());
    }
    let all = gates::table("Gates of stability", &detail.gates, gates::plain);
    if !all.is_empty() {
        let summary = format!("all {} gates of stability", detail.gates.len());
        body.push_str(&folded(&summary, &all.html()));
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
    let mut table = Table::new("Largest safe c dt/h, in the order of the map", &head);
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
    let mut table = Table::new("Stiff and extreme scenes", &head);
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
            html.push_str(
                &gates::table(
                    &format!("Gates of {} that do not hold", row.name),
                    &failing,
                    gates::plain,
                )
                .html(),
            );
        }
    }
    html
}
