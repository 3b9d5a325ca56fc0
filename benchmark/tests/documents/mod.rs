//! What the documents say: their figures are those of the kept record, their commands exist, take their arguments and run.

mod commands;
mod figures;
mod found;
mod scripts;

use std::path::PathBuf;

/// The documents whose figures and commands are checked.
const DOCUMENTS: [&str; 4] = [
    "README.md",
    "kernel/README.md",
    "verification/README.md",
    "benchmark/README.md",
];

/// The folder of the repository.
fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}
