//! What was measured, as JSON in the shape of Google Benchmark: a context, and one flat row per run.
//!
//! There is no NaN and no null: a counter without a finite value is left out.

mod cases;
pub mod context;
mod row;
mod table;

pub use row::{Kind, Row, key};

use proctor_kernel::output::{OutputError, atomic};
use proctor_kernel::simulation::Options;
use serde_json::{Value, json};
use std::path::Path;

/// A record of one invocation.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Where and how it was measured, a flat JSON object.
    pub context: Value,
    /// Rows in the order in which they were measured.
    pub rows: Vec<Row>,
}

impl Record {
    /// A record without rows, of this machine, now.
    #[must_use]
    pub fn new(options: &Options) -> Self {
        Self {
            context: context::now(options),
            rows: vec![],
        }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Row) {
        self.rows.push(row);
    }

    /// Writes the record, atomically.
    ///
    /// # Errors
    /// [`OutputError`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let rows: Vec<Value> = self.rows.iter().map(Row::to_json).collect();
        let record = json!({ "context": self.context, "benchmarks": rows });
        atomic::write(path, |file| writeln!(file, "{record:#}"))
    }
}
