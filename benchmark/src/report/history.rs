//! Course of the numbers over earlier records, where a history was given.

use super::html::{Pictures, Section, Table, folded, paragraph};
use crate::history::History;
use crate::record::details::Figure;
use crate::show::figures::history as figures;
use crate::show::history::{Tally, change, day, largest, short, written};

/// Changes in the table.
const LISTED: usize = 30;

/// The section.
#[must_use]
pub fn section(history: &History, pictures: &mut Pictures) -> Section {
    let changes = history.change_points();
    let mut body = paragraph(&format!(
        "{} records and {} numbers, of which {} changes are found. What is computed changes at every other value; times by \
         E-divisive means with a t-test at 0.001. `proctor history` lists all of them.",
        history.points.len(),
        history.series.len(),
        changes.len()
    ));
    let figures: Vec<Figure> = figures::all(history)
        .into_iter()
        .map(|(_, figure)| figure)
        .collect();
    body.push_str(&pictures.several("", &figures));
    let mut table = Table::new(
        "Largest changes of each case and record, losses first",
        &["number", "before", "after", "change", "record", "subject"],
    );
    for largest in largest(history, &changes).iter().take(LISTED) {
        let found = &largest.change;
        let series = &history.series[found.series];
        let point = &history.points[found.at];
        table.push([
            series.name(),
            written(series, found.before),
            written(series, found.after),
            change(found),
            format!("{} {}", short(point), day(point)),
            point.subject.clone(),
        ]);
    }
    if !table.is_empty() {
        body.push_str(&table.html());
    }
    let mut table = Table::new(
        "Numbers that changed at each record",
        &[
            "record", "day", "worse", "better", "moved", "close", "subject",
        ],
    );
    for (point, tally) in history.points.iter().zip(Tally::of(history, &changes)) {
        if !tally.is_empty() {
            let counts =
                [tally.worse, tally.better, tally.moved, tally.close].map(|n| n.to_string());
            let [worse, better, moved, close] = counts;
            table.push([
                short(point),
                day(point),
                worse,
                better,
                moved,
                close,
                point.subject.clone(),
            ]);
        }
    }
    if !table.is_empty() {
        body.push_str(&folded("record by record", &table.html()));
    }
    for line in &history.left_out {
        body.push_str(&paragraph(&format!("Left out: {line}")));
    }
    Section {
        id: "history",
        title: "History".to_owned(),
        body,
    }
}
