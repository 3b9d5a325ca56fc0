//! A checkpoint that ranks write together: each its own part of the long sections, into one file with the bytes of one process.

use super::super::atomic::{self, Temporary};
use super::format::{self, CHECKSUM, HEADER};
use super::{Checkpoint, CheckpointError};
use crate::output::OutputError;
use crc32fast::Hasher;
use proctor_kernel::ranks::Ranks;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

/// The part of a section that this rank has. A section without one is the same on all ranks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectionPart {
    /// Place of the section in the checkpoint.
    pub section: usize,
    /// Values of the ranks before.
    pub before: u64,
    /// Values of all ranks.
    pub all: u64,
}

/// A checkpoint whose long sections are parted among ranks.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedCheckpoint {
    /// The sections, of parted ones the part of this rank.
    pub checkpoint: Checkpoint,
    /// The parts, in order of the sections.
    pub parts: Vec<SectionPart>,
}

/// Where a section lies in the file.
struct SectionPlace {
    /// First byte of its head.
    head: u64,
    /// First byte of its values.
    values: u64,
    /// Values of all ranks.
    count: u64,
}

impl SharedCheckpoint {
    /// Writes the file, atomically. All ranks call this at the same time, and see the same folder.
    ///
    /// # Errors
    /// As [`Checkpoint::write`], on the rank where it happens: the others return nothing, and the file is as it was.
    pub fn write(&self, path: &Path, ranks: &dyn Ranks) -> Result<(), CheckpointError> {
        self.checkpoint.require_different_names()?;
        let failed = |source| CheckpointError::Write(OutputError::write(path, source));
        let (places, length) = self.places();
        let first = ranks.rank() == 0;
        // The first rank makes the file, and the others open it by its name.
        let made = first.then(|| Temporary::beside(path, length)).transpose();
        let name = made.as_ref().ok().and_then(Option::as_ref);
        let name: Vec<u64> = name
            .map(|file| file.name().bytes().map(u64::from).collect())
            .unwrap_or_default();
        let name: Vec<u8> = ranks.all_gather(&name)[0]
            .iter()
            .map(|byte| *byte as u8)
            .collect();
        let temporary = made.map_err(failed)?;
        if name.is_empty() {
            return Ok(());
        }
        let shared = path.with_file_name(String::from_utf8_lossy(&name).into_owned());
        let own = self.write_own(&shared, (&places, length), first);
        let mut words = vec![u64::from(own.is_err())];
        let sums = own.as_ref().map(Vec::as_slice).unwrap_or_default();
        words.extend(
            sums.iter()
                .flat_map(|(sum, bytes)| [u64::from(*sum), *bytes]),
        );
        let all = ranks.all_gather(&words);
        own.map_err(failed)?;
        if all.iter().any(|words| words[0] != 0) {
            return Ok(());
        }
        let Some(temporary) = temporary else {
            return Ok(());
        };
        let sum = self.checksum((&places, length), &all).map_err(failed)?;
        let finish = |file: &mut File| {
            file.seek(SeekFrom::Start(length - CHECKSUM as u64))?;
            file.write_all(&sum.to_le_bytes())
        };
        temporary.finish(path, finish).map_err(failed)
    }

    /// Where each section lies, and the length of the file.
    fn places(&self) -> (Vec<SectionPlace>, u64) {
        let mut at = HEADER as u64;
        let mut parts = self.parts.iter().peekable();
        let mut places = vec![];
        for (index, section) in self.checkpoint.sections.iter().enumerate() {
            let part = parts.next_if(|part| part.section == index);
            let count = part.map_or(section.data.len() as u64, |part| part.all);
            let values = at + format::head_length(section) as u64;
            places.push(SectionPlace {
                head: at,
                values,
                count,
            });
            at = values + count * format::width(&section.data) as u64;
        }
        (places, at + CHECKSUM as u64)
    }

    /// Writes the parts of this rank, and on the first one all that is not parted; checksum and length of each part.
    fn write_own(
        &self,
        path: &Path,
        (places, length): (&[SectionPlace], u64),
        first: bool,
    ) -> io::Result<Vec<(u32, u64)>> {
        let file = OpenOptions::new().write(true).open(path)?;
        let mut file = BufWriter::with_capacity(atomic::BUFFER, file);
        let mut sums = vec![];
        let mut parts = self.parts.iter().peekable();
        if first {
            file.write_all(&format::header(&self.checkpoint, length)?)?;
        }
        for (index, (section, place)) in self.checkpoint.sections.iter().zip(places).enumerate() {
            let part = parts.next_if(|part| part.section == index);
            if first {
                file.seek(SeekFrom::Start(place.head))?;
                file.write_all(&format::head(section, place.count)?)?;
            }
            let Some(part) = part else {
                if first {
                    format::write_values(&section.data, &mut file)?;
                }
                continue;
            };
            let width = format::width(&section.data) as u64;
            file.seek(SeekFrom::Start(place.values + part.before * width))?;
            let mut summed = format::ChecksumWriter::new(&mut file);
            format::write_values(&section.data, &mut summed)?;
            sums.push((summed.sum(), section.data.len() as u64 * width));
        }
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.sync_all()?;
        Ok(sums)
    }

    /// The checksum of the file, from those of the parts of all ranks: whether one failed, then sum and length of each part.
    fn checksum(
        &self,
        (places, length): (&[SectionPlace], u64),
        all: &[Vec<u64>],
    ) -> io::Result<u32> {
        let mut sum = format::ChecksumWriter::new(io::sink());
        sum.write_all(&format::header(&self.checkpoint, length)?)?;
        let mut parts = self.parts.iter().enumerate().peekable();
        for (index, (section, place)) in self.checkpoint.sections.iter().zip(places).enumerate() {
            sum.write_all(&format::head(section, place.count)?)?;
            let Some((number, _)) = parts.next_if(|(_, part)| part.section == index) else {
                format::write_values(&section.data, &mut sum)?;
                continue;
            };
            for words in all {
                let (own, bytes) = (words[1 + 2 * number], words[2 + 2 * number]);
                sum.add_part(&Hasher::new_with_initial_len(own as u32, bytes));
            }
        }
        Ok(sum.sum())
    }
}
