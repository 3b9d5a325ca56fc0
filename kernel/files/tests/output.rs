//! The files of a run: whole or not there, exact to the bit, and repaired after a kill.

#[path = "output/caution.rs"]
mod caution;
#[path = "output/checkpoint.rs"]
mod checkpoint;
#[path = "output/contact.rs"]
mod contact;
#[path = "output/earlier.rs"]
mod earlier;
#[path = "output/folder.rs"]
mod folder;
#[path = "output/frames.rs"]
mod frames;
#[path = "output/history.rs"]
mod history;
#[path = "output/mortar.rs"]
mod mortar;
#[path = "output/summary.rs"]
mod summary;
#[path = "output/whole.rs"]
mod whole;
#[path = "output/yielding.rs"]
mod yielding;

use std::path::Path;

/// Names of all files in `folder`, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}
