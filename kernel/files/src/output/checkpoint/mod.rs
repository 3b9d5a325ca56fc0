//! `checkpoint.bin`: the state of a run, bit by bit, to go on from.
//!
//! Named arrays of numbers; `format` has the layout of the file.

use std::collections::HashSet;
use std::path::Path;

mod error;
mod file;
mod format;
mod section;
mod shared;

pub use error::CheckpointError;
pub use file::CheckpointFile;
pub use section::{Section, SectionData, SectionNumber};
pub use shared::{SectionPart, SharedCheckpoint};

use super::atomic;

/// Name of the latest checkpoint in the output folder.
pub const CHECKPOINT: &str = "checkpoint.bin";

/// Version of the format that this program writes and reads.
pub const VERSION: u32 = 5;

/// The state of a run as named arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    /// Fingerprint of the scene that is run, made by whoever writes the checkpoint.
    pub fingerprint: u64,
    /// The arrays, in the order of the file.
    pub sections: Vec<Section>,
}

impl Checkpoint {
    /// A checkpoint without sections.
    #[must_use]
    pub fn new(fingerprint: u64) -> Self {
        Self {
            fingerprint,
            sections: Vec::new(),
        }
    }

    /// Adds a section.
    pub fn push<T: SectionNumber>(&mut self, name: impl Into<String>, values: Vec<T>) {
        self.sections.push(Section {
            name: name.into(),
            data: T::wrap(values),
        });
    }

    /// Puts values in the place of those of a section, where there is one of this name.
    pub(crate) fn replace<T: SectionNumber>(&mut self, name: &str, values: Vec<T>) {
        let section = self
            .sections
            .iter_mut()
            .find(|section| section.name == name);
        if let Some(section) = section {
            section.data = T::wrap(values);
        }
    }

    /// The values of the section `name`, which holds `T`.
    ///
    /// # Errors
    /// [`CheckpointError::MissingSection`], [`CheckpointError::WrongType`].
    pub fn values<T: SectionNumber>(&self, name: &str) -> Result<&[T], CheckpointError> {
        let section = self.sections.iter().find(|section| section.name == name);
        let data = match section {
            Some(section) => &section.data,
            None => {
                return Err(CheckpointError::MissingSection {
                    name: name.to_owned(),
                });
            }
        };
        T::unwrap(data).ok_or_else(|| CheckpointError::WrongType {
            name: name.to_owned(),
            expected: T::NAME,
            found: data.type_name(),
        })
    }

    /// The values of the section `name`, which holds exactly `count` of `T`.
    ///
    /// # Errors
    /// As [`Checkpoint::values`], and [`CheckpointError::WrongLength`].
    pub fn array<T: SectionNumber>(
        &self,
        name: &str,
        count: usize,
    ) -> Result<&[T], CheckpointError> {
        let values = self.values::<T>(name)?;
        if values.len() == count {
            Ok(values)
        } else {
            Err(CheckpointError::WrongLength {
                name: name.to_owned(),
                expected: count,
                found: values.len(),
            })
        }
    }

    /// The one value of the section `name`.
    ///
    /// # Errors
    /// As [`Checkpoint::array`].
    pub fn number<T: SectionNumber>(&self, name: &str) -> Result<T, CheckpointError> {
        Ok(self.array::<T>(name, 1)?[0])
    }

    /// Checks that the checkpoint belongs to the scene with the fingerprint `expected`.
    ///
    /// # Errors
    /// [`CheckpointError::OtherScene`] if not.
    pub fn check_fingerprint(&self, expected: u64) -> Result<(), CheckpointError> {
        if self.fingerprint == expected {
            Ok(())
        } else {
            Err(CheckpointError::OtherScene {
                expected,
                found: self.fingerprint,
            })
        }
    }

    /// Length of its file in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        format::length(self)
    }

    /// Writes the checkpoint to `path`, atomically: a run killed meanwhile leaves the earlier one.
    ///
    /// # Errors
    /// [`CheckpointError::RepeatedSection`], [`CheckpointError::Write`].
    pub fn write(&self, path: &Path) -> Result<(), CheckpointError> {
        self.require_different_names()?;
        atomic::write(path, |file| format::write(self, file)).map_err(CheckpointError::Write)
    }

    fn require_different_names(&self) -> Result<(), CheckpointError> {
        let mut names = HashSet::new();
        let mut sections = self.sections.iter();
        match sections.find(|section| !names.insert(section.name.as_str())) {
            None => Ok(()),
            Some(twice) => Err(CheckpointError::RepeatedSection {
                name: twice.name.clone(),
            }),
        }
    }

    /// Reads the checkpoint `path`. Every change of its bytes is found.
    ///
    /// # Errors
    /// [`CheckpointError::Read`], [`CheckpointError::NotACheckpoint`], [`CheckpointError::OtherVersion`],
    /// [`CheckpointError::Truncated`], [`CheckpointError::TooLong`], [`CheckpointError::Checksum`],
    /// [`CheckpointError::Malformed`].
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        format::read(path)
    }
}
