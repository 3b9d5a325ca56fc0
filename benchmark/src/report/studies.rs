//! Error against run time of a case: which settings to choose for which accuracy.

use super::html::{Pictures, Table, escape, paragraph};
use super::packed::packed;
use crate::record::details::StudyDetail;
use crate::record::{Kind, Record};
use std::fmt::Write as _;

/// Legend of the columns of the table.
const COLUMNS: &str = "Combination: weighting function, time of the stress update, transfer. C: the time step as c dt/h (wave \
    speed, time step, cell size). Finest: relative error of the finest run, whose particles, steps, clock (wall) and processor \
    time (CPU) follow. Order: by which power of the cell size the error fell between the two finest runs. For 1 %, for \
    0.1 %: time to that error, interpolated between two runs and never beyond them; ≤: the first run had it; a dash: no run had.";

/// Legend of the mark behind a method.
const MARKED: &str = "!: with this method no time step is safe for every body.";

/// Error against run time of a case, where the record holds it; its pictures are loaded when the case is opened, unless it is
/// open.
pub fn of_case(record: &Record, case: &str, open: bool, pictures: &mut Pictures) -> String {
    let mut html = String::new();
    let studies = record.details.studies.iter();
    let studies: Vec<&StudyDetail> = studies.filter(|study| study.case == case).collect();
    for study in &studies {
        html.push_str(&one(record, study, open, pictures));
    }
    if !studies.is_empty() {
        html.push_str(&paragraph(COLUMNS));
        let marked = |line: &Vec<String>| line.first().is_some_and(|name| name.ends_with('!'));
        if studies.iter().any(|study| study.table.iter().any(marked)) {
            html.push_str(&paragraph(MARKED));
        }
    }
    html
}

fn one(record: &Record, study: &StudyDetail, open: bool, pictures: &mut Pictures) -> String {
    let name = format!(
        "{}: error of the {} against run time",
        study.case, study.measure
    );
    let mut html = format!("<h3>{}</h3>\n", escape(&name));
    if !study.findings.is_empty() {
        html.push_str("<ul>\n");
        for finding in &study.findings {
            let _ = writeln!(html, "<li>{}</li>", escape(finding));
        }
        html.push_str("</ul>\n");
    }
    let figures = pictures.several(&study.case, &study.figures);
    html.push_str(&if open { figures } else { packed(&figures) });
    let mut lines = study.table.iter();
    let Some(head) = lines.next() else {
        return html;
    };
    let reasons: Vec<Option<String>> = study.table[1..]
        .iter()
        .map(|line| line.first().and_then(|name| failure(record, study, name)))
        .collect();
    let mut head: Vec<&str> = head.iter().map(String::as_str).collect();
    if reasons.iter().any(Option::is_some) {
        head.push("why runs failed");
    }
    let caption =
        format!("{name}: by the time for 0.1 %, then for 1 %, then by the error of the finest run");
    let mut table = Table::new(&caption, &head);
    for (line, reason) in lines.zip(reasons) {
        let mut cells: Vec<String> = line.iter().map(|cell| cell.replace("<=", "≤")).collect();
        if cells.len() < head.len() {
            cells.resize(head.len() - 1, String::new());
            cells.push(reason.unwrap_or_default());
        }
        table.push(cells);
    }
    html.push_str(&table.html());
    html
}

/// Failure of the finest failed run of a method, if any.
fn failure(record: &Record, study: &StudyDetail, name: &str) -> Option<String> {
    let method = name.trim_end_matches(" !");
    let mut failed: Vec<(f64, &str)> = vec![];
    for row in &record.rows {
        let word = |key: &str| row.labels.get(key).map_or("", String::as_str);
        let is_run = matches!(row.kind, Kind::Sample { .. }) && row.name.starts_with("precision/");
        if is_run
            && word("case") == study.case
            && ["weighting", "scheme", "transfer"].map(word).join(" ") == method
            && let Some(reason) = &row.error
        {
            let cell = row.counters.get("cell_size").copied();
            failed.push((cell.unwrap_or(f64::INFINITY), reason));
        }
    }
    failed.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let (cell, reason) = failed.first()?;
    let more = match failed.len() {
        1 => String::new(),
        n => format!(" ({n} runs; this is the finest)"),
    };
    Some(format!(
        "h = {} m: {}{more}",
        crate::show::number(*cell),
        crate::show::rounded(reason)
    ))
}
