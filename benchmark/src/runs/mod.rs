//! Folders that runs left, read back: how each ended, its history, and two of them beside each other.

mod compare;
mod history;

pub use compare::{ColumnDifference, RunComparison};
pub use history::RunHistory;

use proctor_files::output::Summary;
use proctor_files::output::history::HISTORY;
use proctor_files::output::pvd::LIST;
use proctor_files::output::summary::{SUMMARY, Status};
use std::path::{Path, PathBuf};

/// A run that came to its end, with its history.
#[derive(Clone, Debug)]
pub struct RunFolder {
    /// The folder.
    pub path: PathBuf,
    /// The end of the run.
    pub summary: Summary,
    /// Its history.
    pub history: RunHistory,
}

/// True for a folder that holds a file of a run.
#[must_use]
pub fn is_run(path: &Path) -> bool {
    [HISTORY, LIST].iter().any(|name| path.join(name).is_file())
        || Summary::read(&path.join(SUMMARY)).is_ok()
}

impl RunFolder {
    /// Reads a folder.
    ///
    /// # Errors
    /// The reason why it is not a run that came to its end.
    pub fn read(path: &Path) -> Result<Self, String> {
        let refused = |found: String| {
            format!(
                "{}: {found}; accepted: the folder of a run that came to its end",
                path.display()
            )
        };
        if !path.join(SUMMARY).is_file() {
            let why = if is_run(path) {
                "which a run writes when it ends"
            } else {
                "and no other file of a run"
            };
            return Err(refused(format!("no {SUMMARY}, {why}")));
        }
        let summary = Summary::read(&path.join(SUMMARY)).map_err(|error| error.to_string())?;
        let word = match summary.status {
            Status::Finished => None,
            Status::Failed => Some("failed"),
            Status::Interrupted => Some("was interrupted"),
        };
        if let Some(word) = word {
            let time = summary
                .time
                .map_or_else(String::new, |time| format!(" at {time} s"));
            let error = summary
                .error
                .map_or_else(String::new, |error| format!(": {error}"));
            return Err(refused(format!("a run that {word}{time}{error}")));
        }
        if !path.join(HISTORY).is_file() {
            return Err(format!(
                "{}: no {HISTORY}; accepted: a run whose scene has `results.print` or `results.history_interval`",
                path.display()
            ));
        }
        Ok(Self {
            path: path.to_owned(),
            summary,
            history: RunHistory::read(&path.join(HISTORY))?,
        })
    }

    /// Reads several folders of runs of one scene.
    ///
    /// # Errors
    /// As [`RunFolder::read`]; runs of scenes with another name, unless `any_name`, or another number of dimensions.
    pub fn read_all(paths: &[PathBuf], any_name: bool) -> Result<Vec<Self>, String> {
        let runs: Vec<Self> = paths
            .iter()
            .map(|path| Self::read(path))
            .collect::<Result<_, _>>()?;
        for run in runs.iter().skip(1) {
            let [first, own] = [&runs[0], run].map(|run| (&run.summary.scene, run.axes()));
            let differ = if first.1 == own.1 && first.0 != own.0 && !any_name {
                format!("of the scene {:?}, not {:?}", own.0, first.0)
            } else if first.1 != own.1 {
                format!("in {} dimensions, not {}", own.1, first.1)
            } else {
                continue;
            };
            let hint = if first.1 == own.1 {
                ", or with --any-scene runs of scenes that differ in name"
            } else {
                ""
            };
            return Err(format!(
                "{}: a run {differ} as {}; accepted: runs of one scene{hint}",
                run.path.display(),
                runs[0].path.display()
            ));
        }
        Ok(runs)
    }

    /// Number of dimensions.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.summary.momentum.len()
    }
}

/// Names of runs for people: those of their folders, or the whole paths where two folders have the same name.
#[must_use]
pub fn names(runs: &[RunFolder]) -> Vec<String> {
    let short = |run: &RunFolder| {
        run.path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
    };
    let all: Vec<Option<String>> = runs.iter().map(short).collect();
    let whole = |run: &RunFolder| run.path.display().to_string();
    let pairs = runs.iter().zip(&all);
    let name = |(run, name): (&RunFolder, &Option<String>)| match name {
        Some(name) if all.iter().flatten().filter(|other| *other == name).count() == 1 => {
            name.clone()
        }
        _ => whole(run),
    };
    pairs.map(name).collect()
}
