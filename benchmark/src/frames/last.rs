//! The frames of a folder in the order of their times.

use std::path::{Path, PathBuf};

/// The last frame in a folder or below it, and its time where a `.pvd` beside it says so.
///
/// Frame with the latest time of a `.pvd`; without one, that with the greatest number in its name.
#[must_use]
pub fn last(folder: &Path) -> Option<(PathBuf, Option<f64>)> {
    all(folder).pop()
}

/// All frames in a folder or below it in order, each with its time where a `.pvd` beside it says so: those of all `.pvd`
/// by their times, or without one all `.vtu` by the numbers in their names.
#[must_use]
pub fn all(folder: &Path) -> Vec<(PathBuf, Option<f64>)> {
    let mut files = vec![];
    collect(folder, &mut files);
    let with = |extension: &str| {
        files
            .iter()
            .filter(|file| {
                file.extension()
                    .is_some_and(|e| e.eq_ignore_ascii_case(extension))
            })
            .cloned()
            .collect::<Vec<PathBuf>>()
    };
    let mut by_time: Vec<(f64, PathBuf)> = with("pvd")
        .iter()
        .filter_map(|pvd| {
            Some((
                pvd.parent()?.to_owned(),
                proctor_files::reading::read_to_string(pvd).ok()?,
            ))
        })
        .flat_map(|(folder, text)| {
            super::tags(&text)
                .filter(|tag| tag.name == "DataSet")
                .filter_map(|tag| {
                    let time: f64 = tag.get("timestep")?.parse().ok()?;
                    Some((time, folder.join(tag.get("file")?)))
                })
                .filter(|(_, file)| file.is_file())
                .collect::<Vec<_>>()
        })
        .collect();
    if !by_time.is_empty() {
        by_time.sort_by(|a, b| a.0.total_cmp(&b.0));
        return by_time
            .into_iter()
            .map(|(time, file)| (file, Some(time)))
            .collect();
    }
    let mut by_number = with("vtu");
    by_number.sort_by_key(|file| (number(file), file.clone()));
    by_number.into_iter().map(|file| (file, None)).collect()
}

/// All files below a folder.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        // Links could lead in circles.
        match entry.file_type() {
            Ok(kind) if kind.is_dir() => collect(&path, files),
            Ok(kind) if kind.is_file() => files.push(path),
            _ => {}
        }
    }
}

/// The last whole number in the name of a file.
fn number(file: &Path) -> Option<u64> {
    let stem = file.file_stem()?.to_string_lossy().into_owned();
    stem.split(|c: char| !c.is_ascii_digit())
        .rfind(|digits| !digits.is_empty())?
        .parse()
        .ok()
}
