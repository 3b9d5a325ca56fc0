//! Documents: their figures are those of the kept record, their commands exist, take their arguments and run,
//! what they print of an output is in it, their links lead somewhere and their names are in the sources.

mod book;
mod commands;
mod figures;
mod found;
mod guests;
mod links;
mod names;
mod packages;
mod promises;
mod ranks;
mod scripts;
#[cfg(unix)]
mod workflows;

use std::fs;
use std::path::{Path, PathBuf};

/// The documents outside the book.
const DOCUMENTS: [&str; 15] = [
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "docs/README.md",
    "kernel/README.md",
    "kernel/contact/README.md",
    "kernel/files/README.md",
    "kernel/geometry/README.md",
    "kernel/laws/README.md",
    "kernel/scene/README.md",
    "kernel/stages/README.md",
    "verification/README.md",
    "benchmark/README.md",
    "scripts/README.md",
];

/// The chapters of the book.
const BOOK: &str = "docs/src";

/// The folder of the repository.
fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Documents and chapters whose figures, commands, links and names are checked, by their paths.
fn documents() -> Vec<String> {
    let mut all: Vec<String> = DOCUMENTS.iter().map(ToString::to_string).collect();
    all.extend(files_below(BOOK, &["md"]));
    all
}

/// The text of a document.
fn text_of(document: &str) -> String {
    fs::read_to_string(root().join(document)).unwrap_or_else(|error| panic!("{document}: {error}"))
}

/// Files below a folder with one of these endings, by their paths from the root, in order.
fn files_below(folder: &str, endings: &[&str]) -> Vec<String> {
    let mut all = vec![];
    let mut folders = vec![PathBuf::from(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root().join(&folder)).expect("a folder") {
            let entry = entry.expect("an entry");
            let path = folder.join(entry.file_name());
            if root().join(&path).is_dir() {
                if entry.file_name() != "target" {
                    folders.push(path);
                }
            } else if has_ending(&path, endings) {
                all.push(path.to_string_lossy().into_owned());
            }
        }
    }
    all.sort();
    all
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|e| e.to_str());
    endings.contains(&ending.unwrap_or_default())
}
