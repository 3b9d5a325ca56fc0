//! A checkpoint that is read in parts: an index of its sections first, then those that somebody needs.

use super::format::{self, CHECKSUM, HEADER};
use super::{Checkpoint, CheckpointError, Section, SectionData};
use crate::output::atomic::BUFFER;
use crc32fast::Hasher;
use proctor_kernel::ranks::Ranks;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A checkpoint file and the places of its sections.
#[derive(Debug)]
pub struct CheckpointFile {
    path: PathBuf,
    file: File,
    length: u64,
    fingerprint: u64,
    sections: Vec<IndexEntry>,
}

/// A section in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
struct IndexEntry {
    name: String,
    code: u8,
    /// First byte of its values.
    values: u64,
    count: u64,
}

impl CheckpointFile {
    /// Reads the index of a checkpoint.
    ///
    /// # Errors
    /// As [`Checkpoint::read`], but for the checksum.
    pub fn open(path: &Path) -> Result<Self, CheckpointError> {
        let failed = |source| CheckpointError::Read {
            path: path.to_path_buf(),
            source,
        };
        let malformed = |reason| CheckpointError::Malformed {
            path: path.to_path_buf(),
            reason,
        };
        let (file, header, length) = format::open(path)?;
        let (count, fingerprint) = format::count_and_fingerprint(&header);
        let mut sections: Vec<IndexEntry> = vec![];
        let mut reader = BufReader::new(&file);
        let mut at = HEADER as u64;
        for _ in 0..count {
            reader.seek(SeekFrom::Start(at)).map_err(failed)?;
            let entry = read_head(&mut reader, at).map_err(|error| match error.kind() {
                io::ErrorKind::UnexpectedEof => malformed(BEYOND.to_owned()),
                io::ErrorKind::InvalidData => malformed(error.to_string()),
                _ => failed(error),
            })?;
            if sections.iter().any(|other| other.name == entry.name) {
                return Err(malformed(format!("two sections '{}'", entry.name)));
            }
            let width = format::width_of(entry.code).ok_or_else(|| {
                let IndexEntry { name, code, .. } = &entry;
                malformed(format!("section '{name}' has the unknown type {code}"))
            })?;
            let bytes = entry.count.checked_mul(width as u64);
            let end = bytes.and_then(|bytes| entry.values.checked_add(bytes));
            let end = end.filter(|end| *end <= length - CHECKSUM as u64);
            at = end.ok_or_else(|| malformed(BEYOND.to_owned()))?;
            sections.push(entry);
        }
        let rest = length - CHECKSUM as u64 - at;
        if rest > 0 {
            return Err(malformed(format!("{rest} bytes too many")));
        }
        Ok(Self {
            path: path.to_path_buf(),
            file,
            length,
            fingerprint,
            sections,
        })
    }

    /// Compares the checksum; each rank reads its share of the bytes.
    ///
    /// # Errors
    /// [`CheckpointError::Read`], on the rank where it happens; [`CheckpointError::Checksum`] on all.
    pub fn verify(&self, ranks: &dyn Ranks) -> Result<(), CheckpointError> {
        let content = self.length - CHECKSUM as u64;
        let end = |rank: usize| (u128::from(content) * rank as u128 / ranks.count() as u128) as u64;
        let own = end(ranks.rank())..end(ranks.rank() + 1);
        let sum = self.sum_of(own.clone());
        let (state, number) = match &sum {
            Ok(sum) => (0, u64::from(*sum)),
            Err(_) => (1, 0),
        };
        let all = ranks.all_gather(&[state, number, own.end - own.start]);
        sum.map_err(|source| self.unreadable(source))?;
        let mut whole = Hasher::new();
        for words in &all {
            whole.combine(&Hasher::new_with_initial_len(words[1] as u32, words[2]));
        }
        let expected = self.checksum().map_err(|source| self.unreadable(source))?;
        let found = whole.finalize();
        if expected == found || all.iter().any(|words| words[0] != 0) {
            return Ok(());
        }
        Err(CheckpointError::Checksum {
            path: self.path.clone(),
            expected,
            found,
        })
    }

    /// The sections whose names pass, as a checkpoint.
    ///
    /// # Errors
    /// [`CheckpointError::Read`].
    pub fn sections(&self, passes: impl Fn(&str) -> bool) -> Result<Checkpoint, CheckpointError> {
        let mut checkpoint = Checkpoint::new(self.fingerprint);
        for entry in self.sections.iter().filter(|entry| passes(&entry.name)) {
            checkpoint
                .sections
                .push(self.part(&entry.name, 0..entry.count)?);
        }
        Ok(checkpoint)
    }

    /// Some values of a section.
    ///
    /// # Errors
    /// [`CheckpointError::MissingSection`], [`CheckpointError::WrongLength`] for values that it does not have,
    /// [`CheckpointError::Read`].
    pub fn part(&self, name: &str, values: Range<u64>) -> Result<Section, CheckpointError> {
        let entry = self.sections.iter().find(|entry| entry.name == name);
        let entry = entry.ok_or_else(|| CheckpointError::MissingSection {
            name: name.to_owned(),
        })?;
        if values.end > entry.count {
            return Err(CheckpointError::WrongLength {
                name: name.to_owned(),
                expected: values.end as usize,
                found: entry.count as usize,
            });
        }
        let width = format::width_of(entry.code).unwrap_or(1) as u64;
        let from = entry.values + values.start * width;
        let bytes = self.bytes(from..from + (values.end - values.start) * width);
        let bytes = bytes.map_err(|source| self.unreadable(source))?;
        Ok(Section {
            name: name.to_owned(),
            data: SectionData::of_bytes(entry.code, &bytes),
        })
    }

    fn bytes(&self, range: Range<u64>) -> io::Result<Vec<u8>> {
        let count = (range.end - range.start) as usize;
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(count)?;
        bytes.resize(count, 0);
        let mut file = &self.file;
        file.seek(SeekFrom::Start(range.start))?;
        file.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn sum_of(&self, range: Range<u64>) -> io::Result<u32> {
        let mut sum = Hasher::new();
        let mut at = range.start;
        while at < range.end {
            let end = range.end.min(at + BUFFER as u64);
            sum.update(&self.bytes(at..end)?);
            at = end;
        }
        Ok(sum.finalize())
    }

    fn checksum(&self) -> io::Result<u32> {
        let bytes = self.bytes(self.length - CHECKSUM as u64..self.length)?;
        Ok(format::checksum(&bytes))
    }

    fn unreadable(&self, source: io::Error) -> CheckpointError {
        CheckpointError::Read {
            path: self.path.clone(),
            source,
        }
    }
}

/// Fault of a section that ends behind the file.
const BEYOND: &str = "a section reaches beyond the end";

/// The head of a section that begins at a byte.
fn read_head(file: &mut impl Read, at: u64) -> io::Result<IndexEntry> {
    let mut code = [0; 1];
    file.read_exact(&mut code)?;
    let mut length = [0; 4];
    file.read_exact(&mut length)?;
    let length = u64::from(u32::from_le_bytes(length));
    let mut name = vec![];
    file.take(length).read_to_end(&mut name)?;
    let name = String::from_utf8(name);
    let name = name.map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))?;
    let mut count = [0; 8];
    file.read_exact(&mut count)?;
    Ok(IndexEntry {
        values: at + 1 + 4 + length + 8,
        name,
        code: code[0],
        count: u64::from_le_bytes(count),
    })
}
