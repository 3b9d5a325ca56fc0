//! The files of a run: whole or not there, exact to the bit, and repaired after a kill.

mod atomic;
mod caution;
mod checkpoint;
mod contact;
mod earlier;
mod folder;
mod forecast;
mod frames;
mod history;
mod interval;
mod mortar;
mod ranks;
mod restart;
mod start_state;
mod summary;
mod until;
mod whole;
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
