//! The generated parts of the book: an index of the cases and a page per case, the keys of scene files, and drawings that
//! explain the method.
//!
//! Pages are made of the cases' own values and of kept records, without a run. A test compares the files of the book with
//! them.

pub mod diagrams;
mod errors;
mod keys;
mod page;
mod sketch;

use crate::record::Record;
use proctor_verification::case::{self, Case};
use std::fmt::Write as _;

/// The line that every page has first: who wrote it.
const WRITTEN: &str =
    "<!-- Written by the program (export --format book). Change the case, not this page. -->\n\n";

/// The same for the chapter of the keys.
const WRITTEN_FROM_KEYS: &str = "<!-- Written by the program (export --format book). Change the text of the key, not this page. -->\n\n";

/// Folder of the pages of the cases below the sources of the book.
const CASES: &str = "verification/cases";

/// A generated file of the book, by its path below the sources of the book.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BookFile {
    /// Path below the sources of the book.
    pub path: String,
    /// The whole text.
    pub text: String,
}

/// All generated files: the index, case by case a page and its pictures, the keys, and the drawings. The numbers of a case are those
/// of the first record that holds its gates; a case without such a record has no page.
#[must_use]
pub fn files(records: &[Record]) -> Vec<BookFile> {
    let mut files = vec![];
    let mut index = format!(
        "{WRITTEN}# The cases\n\nEach page has the question, the set-up, the gates with the reason of each bound, and the errors \
         of the kept runs. Units are SI; errors are relative unless a unit stands beside them.\n\n\
         | case | question | gates that hold | nearest to its bound |\n|---|---|--:|--:|\n"
    );
    for case in case::all() {
        let Some(record) = records.iter().find(|record| holds(record, case)) else {
            continue;
        };
        let page = page::Page::new(case, record);
        let _ = writeln!(
            index,
            "| [{0}]({0}.md) | {1} | {2} | {3} |",
            case.name(),
            case.question(),
            page.held(),
            page.nearest()
        );
        files.extend(page.files());
    }
    files.insert(
        0,
        BookFile {
            path: "index.md".to_owned(),
            text: index,
        },
    );
    for file in &mut files {
        file.path = format!("{CASES}/{}", file.path);
    }
    files.push(keys::chapter());
    files.extend(diagrams::all());
    files
}

/// True where a record has gates of a case.
fn holds(record: &Record, case: &Case) -> bool {
    record.gate_rows().any(|gate| gate.case == case.name())
}
