//! Records of measurements, as JSON in the shape of Google Benchmark: a context, and one flat row per run.
//!
//! There is no NaN and no null: a counter without a finite value is left out.

mod cases;
pub mod context;
pub mod details;
mod done;
pub(crate) mod error;
pub mod export;
pub mod gate;
mod join;
pub mod junit;
pub mod machine;
mod meaning;
pub mod otava;
mod read;
mod refined;
pub mod renamed;
mod reported;
pub(crate) mod row;
mod series;
pub mod summary;
mod table;

pub use details::Details;
pub use done::CaseState;
pub use error::RecordError;
pub use meaning::Meaning;
pub use row::{BY_SCENE, Kind, Row, key};
pub use series::{CaseKey, Cases, Series};

use proctor_files::output::{OutputError, atomic};
use proctor_scene::simulation::Options;
use proctor_verification::case::Size;
use serde_json::{Value, json};
use std::path::Path;

/// Label that rows of one ladder share: runs that differ in resolution alone, so that their errors and times say what
/// accuracy costs. Rows without it belong to none.
pub const LADDER: &str = "ladder";

/// Key of the context that marks a record of interrupted work.
const INCOMPLETE: &str = "incomplete";

/// Key of the context that says which ladders of the cases were run.
const LADDERS: &str = "ladders";

/// Key of the context that says how many ranks shared each step.
const RANKS: &str = "ranks";

/// A record of one invocation.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Circumstances of the measurement, a JSON object.
    pub context: Value,
    /// Rows in the order in which they were measured.
    pub rows: Vec<Row>,
    /// Details that do not fit into flat rows.
    pub details: Details,
}

impl Record {
    /// A record without rows, of this machine, now.
    #[must_use]
    pub fn new(options: &Options) -> Self {
        Self {
            context: context::now(options),
            rows: vec![],
            details: Details::default(),
        }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Row) {
        self.rows.push(row);
    }

    /// Says which ladders of the cases were run.
    pub fn set_ladder(&mut self, size: Size) {
        let word = match size {
            Size::Quick => "quick",
            Size::Full => "full",
        };
        self.context[LADDERS] = word.into();
    }

    /// Names the ranks that shared each step; one is not named.
    pub fn set_ranks(&mut self, ranks: usize) {
        if ranks > 1 {
            self.context[RANKS] = ranks.into();
        }
    }

    /// Ladders of the cases that were run, `quick` or `full`; none for records of something else.
    #[must_use]
    pub fn ladder(&self) -> Option<&str> {
        self.context[LADDERS].as_str()
    }

    /// Says whether the record lacks what was asked for, because the work was interrupted or still goes on.
    pub fn set_incomplete(&mut self, incomplete: bool) {
        if let Some(context) = self.context.as_object_mut() {
            if incomplete {
                context.insert(INCOMPLETE.to_owned(), true.into());
            } else {
                context.remove(INCOMPLETE);
            }
        }
    }

    /// True if the record lacks a part that was asked for.
    #[must_use]
    pub fn incomplete(&self) -> bool {
        self.context[INCOMPLETE] == true
    }

    /// Writes the record, atomically.
    ///
    /// # Errors
    /// [`OutputError`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let rows: Vec<Value> = self.rows.iter().map(Row::to_json).collect();
        let mut record = json!({ "context": self.context, "benchmarks": rows });
        if !self.details.is_empty() {
            record["details"] = json!(self.details);
        }
        atomic::write(path, |file| writeln!(file, "{record:#}"))
    }
}
