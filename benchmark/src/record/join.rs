//! Several records as one: the files of a folder.

use super::error::{Reason, RecordError};
use super::{Kind, LADDERS, Record};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Keys of the context that all files of a folder must share.
const SHARED: [&str; 7] = [
    "commit",
    "dirty",
    "library_build_type",
    "target_features_compiled",
    "cpu_model",
    "lanes",
    "num_cpus",
];

impl Record {
    /// Reads a record, or a folder of them as one.
    ///
    /// A folder holds passes in the order of their names: each sub-folder is a pass, whose files are repetitions of each
    /// other or different cases; a folder without sub-folders holds one pass per file. Only files that end in `.json`
    /// count.
    ///
    /// # Errors
    /// [`RecordError`] if a file is no record, holds several passes itself, or was measured with another program or on
    /// another machine than the first; or if there is no file.
    pub fn read_joined(path: &Path) -> Result<Self, RecordError> {
        if !path.is_dir() {
            return Self::read(path);
        }
        let (folders, files) = entries(path)?;
        let passes = if folders.is_empty() {
            files.into_iter().map(|file| vec![file]).collect()
        } else {
            let files = folders.iter().map(|folder| Ok(entries(folder)?.1));
            files.collect::<Result<Vec<_>, RecordError>>()?
        };
        let mut joined: Option<(PathBuf, Self)> = None;
        for (pass, files) in passes.into_iter().enumerate() {
            let mut repetitions = BTreeMap::new();
            for file in files {
                let mut record = Self::read(&file)?;
                record.place(&file, pass as u64, &mut repetitions)?;
                match &mut joined {
                    None => joined = Some((file, record)),
                    Some((first, joined)) => joined.join(record, first, &file)?,
                }
            }
        }
        let empty = || RecordError::new(path, Reason::Shape("no record in this folder".to_owned()));
        Ok(joined.ok_or_else(empty)?.1)
    }

    /// Puts all samples into a pass, counting repetitions on.
    fn place(
        &mut self,
        file: &Path,
        pass: u64,
        repetitions: &mut BTreeMap<(String, u64), u64>,
    ) -> Result<(), RecordError> {
        if self.rows.iter().any(|row| row.pass() > 0) {
            let what = "a record of several passes inside a folder of passes".to_owned();
            return Err(RecordError::new(file, Reason::Shape(what)));
        }
        for row in &mut self.rows {
            if let Kind::Sample { repetition } = &mut row.kind {
                let next = repetitions
                    .entry((row.name.clone(), row.threads))
                    .or_insert(0);
                *repetition = *next;
                *next += 1;
                row.set_pass(pass);
            }
        }
        Ok(())
    }

    /// Difference of two records that cannot be one, as they come from other programs or machines: a key, and its value in this
    /// one and in the other.
    #[must_use]
    pub fn differs_from(&self, other: &Self) -> Option<[String; 3]> {
        let of = |record: &Self, key: &str| record.context[key].to_string();
        SHARED
            .into_iter()
            .find(|key| self.context[*key] != other.context[*key])
            .map(|key| [key.to_owned(), of(self, key), of(other, key)])
    }

    /// Appends the rows of another record of the same program and machine.
    fn join(&mut self, other: Self, first: &Path, file: &Path) -> Result<(), RecordError> {
        if let Some([key, mine, its]) = self.differs_from(&other) {
            let what = format!("`{key}` is {its}, but {mine} in {}", first.display());
            return Err(RecordError::new(file, Reason::Shape(what)));
        }
        if other.incomplete() {
            self.set_incomplete(true);
        }
        // A record of speed beside those of cases says nothing of ladders.
        if let (None, Some(ladder)) = (self.ladder(), other.ladder()) {
            self.context[LADDERS] = ladder.into();
        }
        self.join_cases(&other);
        self.rows.extend(other.rows);
        Ok(())
    }
}

/// Sub-folders and JSON files of a folder, each in the order of their names.
fn entries(path: &Path) -> Result<(Vec<PathBuf>, Vec<PathBuf>), RecordError> {
    let unreadable = |error| RecordError::new(path, Reason::Unreadable(error));
    let (mut folders, mut files) = (vec![], vec![]);
    for entry in fs::read_dir(path).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.is_dir() {
            folders.push(path);
        } else if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            files.push(path);
        }
    }
    folders.sort();
    files.sort();
    Ok((folders, files))
}
