//! Records over commits for Apache Otava, formerly Hunter, which finds change points in tables of numbers.
//!
//! Otava reads a file of comma-separated values, a line per run in the order of time, and a configuration in YAML that names the
//! columns. It wants a value in every line: numbers that every record has get a column, those that are judged and the median time
//! of each case.

use crate::history::{History, Series};
use std::fmt::Write as _;

/// Column of the time of a record, as ISO 8601.
const TIME: &str = "time";
/// Column of its commit.
const COMMIT: &str = "commit";

/// The table, a line per record.
///
/// # Errors
/// If it cannot be written.
pub fn table(history: &History) -> csv::Result<String> {
    let mut table = csv::Writer::from_writer(vec![]);
    let whole: Vec<&Series> = whole(history).collect();
    let columns = whole.iter().map(|series| series.name());
    table.write_record(
        [TIME.to_owned(), COMMIT.to_owned()]
            .into_iter()
            .chain(columns),
    )?;
    for (place, point) in history.points.iter().enumerate() {
        let values = whole.iter().map(|series| {
            let value = series.values[place];
            value.map_or_else(String::new, |value| value.to_string())
        });
        let whence = [point.date.clone(), point.commit.clone()];
        table.write_record(whence.into_iter().chain(values))?;
    }
    let bytes = table
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The numbers that every record has.
fn whole(history: &History) -> impl Iterator<Item = &Series> {
    let series = history.series.iter();
    series.filter(|series| series.values.iter().all(Option::is_some))
}

/// The configuration of a test on the table of that name.
#[must_use]
pub fn configuration(history: &History, file: &str) -> String {
    let mut yaml = format!(
        "# OTAVA_CONFIG=THIS otava analyze proctor\ntests:\n  proctor:\n    type: csv\n    file: {}\n    \
         time_column: {TIME}\n    attributes: [{COMMIT}]\n    metrics:\n",
        quoted(file)
    );
    for (number, series) in whole(history).enumerate() {
        let _ = write!(
            yaml,
            "      {}:\n        column: {}\n",
            quoted(&format!("{:03} {}", number + 1, series.name())),
            quoted(&series.name()),
        );
        if let Some(direction) = series.direction() {
            let _ = writeln!(yaml, "        direction: {direction}");
        }
    }
    yaml
}

/// A text as a JSON string, which YAML takes.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
