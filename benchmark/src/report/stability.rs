//! Where each method is stable.

use super::html::{Section, Table, paragraph};
use crate::record::Record;
use crate::show::picture;

/// The section, where the record holds a map.
pub fn section(record: &Record) -> Option<Section> {
    let detail = record.details.stability.as_ref()?;
    let mut body = paragraph(
        "The largest stable step, predicted from the linear part of the kernel's own step and measured by runs with noise, of \
         blocks, thin bodies and single particles at nineteen places on the mesh. Hovering over a cell shows what rules it.",
    );
    if !detail.cells.is_empty() {
        body.push_str("<figure>\n");
        body.push_str(&picture::svg(detail));
        body.push_str(
            "<figcaption>The number is the largest safe c dt/h.</figcaption>\n</figure>\n",
        );
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
    Some(Section {
        id: "stability",
        title: "Stability".to_owned(),
        body,
    })
}
