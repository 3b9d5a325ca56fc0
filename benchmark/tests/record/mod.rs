//! Records: what is written is what is read, and what is no record is refused with place and reason.

mod context;
mod details;
mod done;
mod foreign;
mod gate;
mod machine;
mod meaning;
mod refused;
mod renamed;
mod round_trip;
mod row;

use proctor_benchmark::record::{Record, RecordError};
use tempfile::TempDir;

/// Reads a record from text.
fn read(text: &str) -> Result<Record, RecordError> {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("record.json");
    std::fs::write(&path, text).expect("written");
    Record::read(&path)
}
