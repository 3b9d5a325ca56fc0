//! Folders of the scenes and results of executables.

use crate::exit::Failure;
use std::path::{Path, PathBuf};

/// Folder of the results of executables.
pub(super) enum Folder {
    Kept(PathBuf),
    Removed(tempfile::TempDir),
}

impl Folder {
    /// The folder that a user named, made if it is not there, or one that goes with this value.
    pub fn new(kept: Option<&Path>) -> Result<Self, Failure> {
        match kept {
            Some(path) => std::fs::create_dir_all(path)
                .map(|()| Self::Kept(path.to_owned()))
                .map_err(|error| Failure::BadInput(format!("{}: {error}", path.display()))),
            None => tempfile::tempdir()
                .map(Self::Removed)
                .map_err(|error| Failure::BadInput(format!("no folder for results: {error}"))),
        }
    }

    pub fn path(&self) -> &Path {
        match self {
            Self::Kept(path) => path,
            Self::Removed(folder) => folder.path(),
        }
    }
}
