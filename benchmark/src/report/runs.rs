//! Runs of one scene on a page: their ends, their differences from the first, their histories.

use super::html::{Section, Table, drawn, paragraph};
use crate::runs::{RunComparison, RunFolder, RunHistory, names};
use crate::show::figures::runs::{MOST_CHARTS, histories};
use crate::show::runs::{HEADINGS, differences, ends, verdict};

/// The sections of the page.
pub(super) fn sections(runs: &[RunFolder]) -> Vec<Section> {
    let names = names(runs);
    let mut sections = vec![Section {
        id: "ends",
        title: "How they ended".to_owned(),
        body: table_of_ends(runs, &names),
    }];
    if runs.len() > 1 {
        sections.push(Section {
            id: "differences",
            title: format!("Differences from {}", names[0]),
            body: of_first(runs, &names),
        });
    }
    sections.push(Section {
        id: "histories",
        title: "Histories".to_owned(),
        body: curves(runs, &names),
    });
    sections
}

fn table_of_ends(runs: &[RunFolder], names: &[String]) -> String {
    let head: Vec<&str> = std::iter::once("")
        .chain(names.iter().map(String::as_str))
        .collect();
    let mut table = Table::new("Counts, steps and energies at the end", &head);
    for (name, cells) in ends(runs) {
        table.push(std::iter::once(name.to_owned()).chain(cells));
    }
    let mut html = table.html();
    for (run, name) in runs.iter().zip(names) {
        let warnings = run.summary.warnings.iter().map(|warning| &warning.message);
        for message in warnings.chain(&run.summary.not_to_be_trusted) {
            html.push_str(&paragraph(&format!("{name}: {message}")));
        }
    }
    html
}

fn of_first(runs: &[RunFolder], names: &[String]) -> String {
    let mut html = String::new();
    for (run, name) in runs.iter().zip(names).skip(1) {
        let comparison = RunComparison::new(&runs[0], run);
        html.push_str(&paragraph(&format!(
            "{name}: {}.",
            verdict(&runs[0], run, &comparison)
        )));
        let mut table = Table::new(
            &format!("{name} less {}, the largest over time", names[0]),
            &HEADINGS,
        );
        for row in differences(&comparison) {
            table.push(row);
        }
        if !table.is_empty() {
            html.push_str(&table.html());
        }
    }
    html
}

fn curves(runs: &[RunFolder], names: &[String]) -> String {
    let histories_of: Vec<(String, &RunHistory)> = names
        .iter()
        .cloned()
        .zip(runs.iter().map(|run| &run.history))
        .collect();
    let charts = histories(&histories_of);
    let mut html = String::new();
    if charts.len() == MOST_CHARTS {
        html.push_str(&paragraph(&format!(
            "The first {MOST_CHARTS} groups of columns."
        )));
    }
    html + &drawn(&charts)
}
