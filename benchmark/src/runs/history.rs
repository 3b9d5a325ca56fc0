//! A history, read back.

use proctor_files::reading;
use std::path::Path;

/// Columns of `history.csv` over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunHistory {
    /// Times of the rows \[s\].
    pub times: Vec<f64>,
    /// The other columns by their names, not a number where a cell is empty.
    pub columns: Vec<(String, Vec<f64>)>,
}

impl RunHistory {
    /// Reads a history. Half a row at its end, which a run that was killed may leave, is left out.
    ///
    /// # Errors
    /// The reason why the file is none, with its name and line.
    pub fn read(path: &Path) -> Result<Self, String> {
        let name = path.display();
        let text = reading::read_to_string(path).map_err(|error| format!("{name}: {error}"))?;
        Self::parse(&text).map_err(|(line, reason)| {
            format!("{name}:{line}: {reason}; accepted: a history as `proctor run` writes it")
        })
    }

    /// Parses the text of a file; the line and the reason where it is none.
    fn parse(text: &str) -> Result<Self, (usize, String)> {
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .from_reader(&text.as_bytes()[..whole]);
        let head = reader
            .headers()
            .map_err(|error| (1, error.to_string()))?
            .clone();
        if head.get(0) != Some("time") {
            return Err((1, "the first column is not `time`".to_owned()));
        }
        let mut history = Self {
            times: vec![],
            columns: head
                .iter()
                .skip(1)
                .map(|name| (name.to_owned(), vec![]))
                .collect(),
        };
        for (row, record) in reader.records().enumerate() {
            let line = row + 2;
            let record = record.map_err(|error| (line, error.to_string()))?;
            if record.len() != head.len() {
                return Err((line, format!("{} cells, not {}", record.len(), head.len())));
            }
            let mut values = vec![];
            for cell in &record {
                let value = if cell.is_empty() {
                    Ok(f64::NAN)
                } else {
                    cell.parse()
                };
                values.push(value.map_err(|_| (line, format!("{cell:?} is not a number")))?);
            }
            let later = history.times.last().is_none_or(|last| *last < values[0]);
            if !(later && values[0].is_finite()) {
                return Err((line, "the times do not increase".to_owned()));
            }
            history.times.push(values[0]);
            for ((_, column), value) in history.columns.iter_mut().zip(&values[1..]) {
                column.push(*value);
            }
        }
        Ok(history)
    }

    /// The values of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let found = self.columns.iter().find(|(known, _)| known == name);
        found.map(|(_, values)| values.as_slice())
    }

    /// Values of a column at a time between its first row and its last, linear between rows.
    #[must_use]
    pub fn at(&self, values: &[f64], time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t < time);
        let next = *self.times.get(after)?;
        if next == time {
            return Some(values[after]);
        }
        let before = after.checked_sub(1)?;
        let share = (time - self.times[before]) / (next - self.times[before]);
        Some(values[before] + share * (values[after] - values[before]))
    }
}
