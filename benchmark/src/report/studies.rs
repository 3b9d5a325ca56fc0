//! Error against run time: which settings to choose for which accuracy.

use super::html::{Section, Table, escape, figures, paragraph};
use crate::record::Record;
use crate::record::details::StudyDetail;
use std::fmt::Write as _;

/// The section, where the record holds studies.
pub fn section(record: &Record) -> Option<Section> {
    let studies = &record.details.studies;
    if studies.is_empty() {
        return None;
    }
    let mut body = paragraph(
        "Down and to the left is better: a smaller error for less time. The table beside each picture says what an \
         error of 1 % and of 0.1 % costs, interpolated along a line and never beyond its ends; a dash means that no \
         run of the line was so good.",
    );
    for study in studies {
        push(&mut body, study);
    }
    Some(Section {
        id: "precision",
        title: "Error against run time".to_owned(),
        body,
    })
}

fn push(body: &mut String, study: &StudyDetail) {
    let _ = writeln!(
        body,
        "<h3>{}: {}</h3>",
        escape(&study.case),
        escape(&study.measure)
    );
    if !study.findings.is_empty() {
        body.push_str("<ul>\n");
        for finding in &study.findings {
            let _ = writeln!(body, "<li>{}</li>", escape(finding));
        }
        body.push_str("</ul>\n");
    }
    body.push_str(&figures(&study.figures));
    let mut lines = study.table.iter();
    if let Some(head) = lines.next() {
        let head: Vec<&str> = head.iter().map(String::as_str).collect();
        let mut table = Table::new("combinations, the cheapest first", &head);
        for line in lines {
            table.push(line.iter().cloned());
        }
        body.push_str(&table.html());
    }
}
