//! Output of an earlier run in the folder of a new one.
//!
//! A viewer that opens `particles_*.vtu` shows every frame that lies there, whatever the list says. So a new run takes away
//! what the lists of an earlier run name, and nothing else: frames that no list names may be somebody's, and are refused.

use super::pvd::{self, BOUNDARIES, GRID, PARTICLES};
use super::summary::SUMMARY;
use super::{OutputError, OutputFolder, pieces};
use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Takes away the frames, lists and summary of an earlier run. Nothing is touched where that is refused.
///
/// # Errors
/// [`OutputError::Unlisted`] if there are frames that no list names, [`OutputError::Read`] and [`OutputError::Malformed`] if
/// a list cannot be read or is not as this program writes it, [`OutputError::Write`] if something cannot be removed.
pub fn clear(folder: &OutputFolder) -> Result<(), OutputError> {
    let mut left = vec![];
    for stem in [PARTICLES, GRID, BOUNDARIES] {
        let list = folder.file(&pvd::list_name(stem));
        let known = frames_of(stem, &pvd::read_list(&list)?);
        let there = frames_in(folder.path(), stem)?;
        let unlisted = there.difference(&known);
        if let Some(first) = unlisted.clone().next() {
            return Err(OutputError::Unlisted {
                path: folder.path().to_owned(),
                first: first.clone(),
                count: unlisted.count(),
            });
        }
        // Pieces first: those that no file names would be nobody's.
        for number in known
            .iter()
            .filter_map(|file| pvd::frame_number(stem, file))
        {
            pieces::remove(folder, stem, number)?;
        }
        left.extend(there);
        left.push(pvd::list_name(stem));
    }
    // A run that is killed has no summary; that of the run before it would be taken for its own.
    left.push(SUMMARY.to_owned());
    for name in left {
        remove(&folder.file(&name))?;
    }
    Ok(())
}

/// Takes away frames that a list named.
///
/// # Errors
/// [`OutputError::Write`] if one cannot be removed.
pub(super) fn drop_frames(
    folder: &OutputFolder,
    stem: &str,
    entries: &[pvd::FrameEntry],
) -> Result<(), OutputError> {
    for entry in entries {
        // The list may name anything; what is not called as we call frames is not ours.
        if let Some(number) = pvd::frame_number(stem, &entry.file) {
            pieces::remove(folder, stem, number)?;
            remove(&folder.file(&entry.file))?;
        }
    }
    Ok(())
}

/// Names of the frames of a list, and of the one behind them, which a run that was killed has written and not yet listed.
fn frames_of(stem: &str, entries: &[pvd::FrameEntry]) -> BTreeSet<String> {
    let numbers = entries
        .iter()
        .filter_map(|entry| pvd::frame_number(stem, &entry.file));
    let next = numbers.max().map_or(0, |number| number + 1);
    let listed = entries.iter().map(|entry| entry.file.clone());
    let behind = pvd::EXTENSIONS.map(|extension| pvd::name_of(stem, next, extension));
    listed.chain(behind).collect()
}

/// Names of the frames that lie in a folder.
fn frames_in(path: &Path, stem: &str) -> Result<BTreeSet<String>, OutputError> {
    let unreadable = |error| OutputError::read(path, error);
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(path).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let file = entry.file_type().map_err(unreadable)?.is_file();
        if let Some(name) = entry.file_name().to_str()
            && file
            && pvd::frame_number(stem, name).is_some()
        {
            names.insert(name.to_owned());
        }
    }
    Ok(names)
}

fn remove(path: &Path) -> Result<(), OutputError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(OutputError::write(path, error)),
        _ => Ok(()),
    }
}
