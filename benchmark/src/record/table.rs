//! A record as a table of comma-separated values: one line per row, one column per counter or label.

use super::{Kind, Record, Row};
use proctor_kernel::output::{OutputError, atomic};
use std::collections::BTreeSet;
use std::path::Path;

impl Record {
    /// Writes the rows, atomically. A counter that a row does not have is an empty cell.
    ///
    /// # Errors
    /// [`OutputError`] if the file cannot be written.
    pub fn write_csv(&self, path: &Path) -> Result<(), OutputError> {
        let keys = |of: fn(&Row) -> Vec<&String>| -> BTreeSet<&String> {
            self.rows.iter().flat_map(of).collect()
        };
        let counters = keys(|row| row.counters.keys().collect());
        let labels = keys(|row| row.labels.keys().collect());
        atomic::write(path, |file| {
            let mut table = csv::Writer::from_writer(file);
            let head = [
                "name",
                "repetition",
                "threads",
                "real_time_ms",
                "cpu_time_ms",
            ];
            let keys = labels.iter().chain(&counters).map(|key| key.as_str());
            table.write_record(head.into_iter().chain(keys).chain(["error_message"]))?;
            for row in &self.rows {
                table.write_record(cells(row, &labels, &counters))?;
            }
            table.flush()
        })
    }
}

fn cells(row: &Row, labels: &BTreeSet<&String>, counters: &BTreeSet<&String>) -> Vec<String> {
    let milliseconds = |time: std::time::Duration| (time.as_secs_f64() * 1e3).to_string();
    let mut cells = vec![
        row.name.clone(),
        match &row.kind {
            Kind::Sample { repetition } => repetition.to_string(),
            Kind::Aggregate { name } => name.clone(),
        },
        row.threads.to_string(),
        row.spent
            .map(|spent| milliseconds(spent.wall))
            .unwrap_or_default(),
        row.spent
            .map(|spent| milliseconds(spent.cpu))
            .unwrap_or_default(),
    ];
    cells.extend(
        labels
            .iter()
            .map(|key| row.labels.get(*key).cloned().unwrap_or_default()),
    );
    cells.extend(counters.iter().map(|key| {
        row.counters
            .get(*key)
            .map(f64::to_string)
            .unwrap_or_default()
    }));
    cells.push(row.error.clone().unwrap_or_default());
    cells
}
