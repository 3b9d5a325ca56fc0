//! A record as a table of comma-separated values: one line per row, one column per counter or label.

use super::{Kind, Record, Row};
use proctor_files::output::{OutputError, atomic};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;

/// Columns that every row has a place in; the counters and the labels follow.
const FIXED: [&str; 8] = [
    "name",
    "repetition",
    "aggregate",
    "threads",
    "iterations",
    "wall_seconds",
    "cpu_seconds",
    "failure",
];

impl Record {
    /// Writes the rows as a table, failed ones too. A counter that a row does not have is an empty cell; times are
    /// in s.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn table(&self, out: impl Write) -> csv::Result<()> {
        let keys = |of: fn(&Row) -> Vec<&String>| -> BTreeSet<&String> {
            self.rows.iter().flat_map(of).collect()
        };
        let counters = keys(|row| row.counters.keys().collect());
        let labels = keys(|row| row.labels.keys().collect());
        let mut table = csv::Writer::from_writer(out);
        let named = counters.iter().chain(&labels).map(|key| key.as_str());
        table.write_record(FIXED.into_iter().chain(named))?;
        for row in &self.rows {
            let mut cells = fixed(row).to_vec();
            cells.extend(
                counters
                    .iter()
                    .map(|key| number(row.counters.get(*key).copied())),
            );
            let word = |key: &&String| row.labels.get(*key).cloned().unwrap_or_default();
            cells.extend(labels.iter().map(word));
            table.write_record(cells)?;
        }
        table.flush()?;
        Ok(())
    }

    /// Writes the table to a file, atomically.
    ///
    /// # Errors
    /// [`OutputError`] if the file cannot be written.
    pub fn write_csv(&self, path: &Path) -> Result<(), OutputError> {
        atomic::write(path, |file| self.table(file).map_err(Into::into))
    }
}

/// Cells of the [`FIXED`] columns.
fn fixed(row: &Row) -> [String; FIXED.len()] {
    let (repetition, aggregate) = match &row.kind {
        Kind::Sample { repetition } => (repetition.to_string(), String::new()),
        Kind::Aggregate { name } => (String::new(), name.clone()),
    };
    [
        row.name.clone(),
        repetition,
        aggregate,
        row.threads.to_string(),
        row.iterations.to_string(),
        number(row.wall()),
        number(row.cpu()),
        row.error.clone().unwrap_or_default(),
    ]
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |x| x.to_string())
}
