//! The bytes of a checkpoint.
//!
//! The file describes itself; all numbers are little-endian:
//!
//! ```text
//! magic       8 bytes
//! version     u32
//! sections    u32   how many
//! fingerprint u64   of the scene
//! length      u64   of the whole file in bytes
//! then for every section
//!   type      u8    0 f64, 1 u64, 2 i64, 3 u8
//!   name      u32 bytes long, then UTF-8
//!   count     u64
//!   values
//! checksum    u32   CRC-32 of everything before it
//! ```
//!
//! CRC-32 finds every single flipped bit and every burst of up to 32 bits, and runs at several gigabytes a second,
//! where a byte-wise 64-bit hash would take longer than the disk. The length finds a truncated file.

use std::collections::HashSet;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use crc32fast::Hasher;

use super::super::little_endian::{self, LittleEndian};
use super::{Checkpoint, CheckpointError, Section, SectionData, VERSION};

/// First bytes as in PNG: the first byte is not text, and the line ends show a transfer that changed them.
const MAGIC: [u8; 8] = *b"\x89PRC\r\n\x1a\n";
/// Magic, version, sections, fingerprint, length.
pub(super) const HEADER: usize = 32;
pub(super) const CHECKSUM: usize = 4;

/// Length of the file of `checkpoint` in bytes.
pub(super) fn length(checkpoint: &Checkpoint) -> u64 {
    let stored =
        |section: &Section| head_length(section) + width(&section.data) * section.data.len();
    let body: usize = checkpoint.sections.iter().map(stored).sum();
    (HEADER + body + CHECKSUM) as u64
}

/// Writes the bytes of `checkpoint`.
pub(super) fn write(checkpoint: &Checkpoint, file: &mut dyn Write) -> io::Result<()> {
    let mut file = ChecksumWriter::new(file);
    file.write_all(&header(checkpoint, length(checkpoint))?)?;
    for section in &checkpoint.sections {
        file.write_all(&head(section, section.data.len() as u64)?)?;
        write_values(&section.data, &mut file)?;
    }
    let checksum = file.sum();
    file.write_all(&checksum.to_le_bytes())
}

/// The bytes before the first section, of a file of this length.
pub(super) fn header(checkpoint: &Checkpoint, length: u64) -> io::Result<Vec<u8>> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(length_u32(checkpoint.sections.len())?.to_le_bytes());
    bytes.extend(checkpoint.fingerprint.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    Ok(bytes)
}

/// The bytes of a section before its values, of which there are so many.
pub(super) fn head(section: &Section, count: u64) -> io::Result<Vec<u8>> {
    let mut bytes = vec![type_code(&section.data)];
    bytes.extend(length_u32(section.name.len())?.to_le_bytes());
    bytes.extend(section.name.as_bytes());
    bytes.extend(count.to_le_bytes());
    Ok(bytes)
}

/// Number of these bytes.
pub(super) fn head_length(section: &Section) -> usize {
    1 + 4 + section.name.len() + 8
}

/// Writes the values of a section.
pub(super) fn write_values(data: &SectionData, file: &mut impl Write) -> io::Result<()> {
    match data {
        SectionData::F64(values) => little_endian::write(values.iter().copied(), file),
        SectionData::U64(values) => little_endian::write(values.iter().copied(), file),
        SectionData::I64(values) => little_endian::write(values.iter().copied(), file),
        SectionData::U8(values) => file.write_all(values),
    }
}

/// Bytes of a value of a section.
pub(super) fn width(data: &SectionData) -> usize {
    if matches!(data, SectionData::U8(_)) {
        1
    } else {
        8
    }
}

/// Opens the checkpoint `path`: the file behind its header, the header, and the length that the file should have.
pub(super) fn open(path: &Path) -> Result<(File, Vec<u8>, u64), CheckpointError> {
    let failed = |source| CheckpointError::Read {
        path: path.to_path_buf(),
        source,
    };
    let file = File::open(path).map_err(failed)?;
    let found = file.metadata().map_err(failed)?.len();
    // The header first: a wrong file may be of any size.
    let mut header = Vec::with_capacity(HEADER);
    (&file)
        .take(HEADER as u64)
        .read_to_end(&mut header)
        .map_err(failed)?;
    let length = check_header(path, &header, found)?;
    Ok((file, header, length))
}

/// Reads the checkpoint `path`; see [`Checkpoint::read`].
pub(super) fn read(path: &Path) -> Result<Checkpoint, CheckpointError> {
    let failed = |source| CheckpointError::Read {
        path: path.to_path_buf(),
        source,
    };
    let (file, mut bytes, expected) = open(path)?;
    bytes
        .try_reserve_exact(expected as usize - bytes.len())
        .map_err(|_| failed(io::ErrorKind::OutOfMemory.into()))?;
    (&file).read_to_end(&mut bytes).map_err(failed)?;
    check_length(path, expected, bytes.len() as u64)?;

    let (content, checksum) = bytes.split_at(bytes.len() - CHECKSUM);
    let (expected, found) = (u32::get(checksum), crc32fast::hash(content));
    if expected != found {
        return Err(CheckpointError::Checksum {
            path: path.to_path_buf(),
            expected,
            found,
        });
    }
    parse(content).map_err(|reason| CheckpointError::Malformed {
        path: path.to_path_buf(),
        reason,
    })
}

/// Number of sections and fingerprint of a header that was checked.
pub(super) fn count_and_fingerprint(header: &[u8]) -> (u32, u64) {
    (u32::get(&header[12..16]), u64::get(&header[16..24]))
}

/// The checksum in the last bytes.
pub(super) fn checksum(bytes: &[u8]) -> u32 {
    u32::get(bytes)
}

/// Returns the length that the file should have.
fn check_header(path: &Path, header: &[u8], found: u64) -> Result<u64, CheckpointError> {
    let path = path.to_path_buf();
    // A file cut off inside the magic is still recognisable as far as it goes; an empty file is not.
    let known = header.len().min(MAGIC.len());
    if known == 0 || header[..known] != MAGIC[..known] {
        return Err(CheckpointError::NotACheckpoint { path });
    }
    if header.len() < HEADER {
        return Err(CheckpointError::Truncated {
            path,
            expected: (HEADER + CHECKSUM) as u64,
            found,
        });
    }
    let version = u32::get(&header[8..12]);
    if version != VERSION {
        return Err(CheckpointError::OtherVersion {
            path,
            found: version,
        });
    }
    let expected = u64::get(&header[24..32]);
    check_length(&path, expected, found)?;
    if expected < (HEADER + CHECKSUM) as u64 {
        let reason = format!("a length of {expected} bytes");
        return Err(CheckpointError::Malformed { path, reason });
    }
    Ok(expected)
}

fn check_length(path: &Path, expected: u64, found: u64) -> Result<(), CheckpointError> {
    let path = path.to_path_buf();
    match found.cmp(&expected) {
        std::cmp::Ordering::Less => Err(CheckpointError::Truncated {
            path,
            expected,
            found,
        }),
        std::cmp::Ordering::Greater => Err(CheckpointError::TooLong {
            path,
            expected,
            found,
        }),
        std::cmp::Ordering::Equal => Ok(()),
    }
}

/// The checkpoint of a file whose magic, version, length and checksum are as they should be, without the checksum.
fn parse(content: &[u8]) -> Result<Checkpoint, String> {
    let mut rest = Bytes(&content[12..]); // behind magic and version
    let sections = rest.number::<u32>()?;
    let mut checkpoint = Checkpoint::new(rest.number()?);
    let _length = rest.number::<u64>()?;
    let mut names = HashSet::new();
    for _ in 0..sections {
        let code = rest.number::<u8>()?;
        let length = rest.number::<u32>()?;
        let name = std::str::from_utf8(rest.take(u64::from(length))?)
            .map_err(|error| error.to_string())?;
        if !names.insert(name) {
            return Err(format!("two sections '{name}'"));
        }
        let count = rest.number::<u64>()?;
        let width = width_of(code)
            .ok_or_else(|| format!("section '{name}' has the unknown type {code}"))?;
        let bytes = count.checked_mul(width as u64);
        let bytes = rest.take(bytes.ok_or("a section reaches beyond the end")?)?;
        checkpoint.sections.push(Section {
            name: name.to_owned(),
            data: SectionData::of_bytes(code, bytes),
        });
    }
    if rest.0.is_empty() {
        Ok(checkpoint)
    } else {
        Err(format!("{} bytes too many", rest.0.len()))
    }
}

fn type_code(data: &SectionData) -> u8 {
    match data {
        SectionData::F64(_) => 0,
        SectionData::U64(_) => 1,
        SectionData::I64(_) => 2,
        SectionData::U8(_) => 3,
    }
}

/// Bytes of a value of a type, by its code.
pub(super) fn width_of(code: u8) -> Option<usize> {
    match code {
        0..=2 => Some(8),
        3 => Some(1),
        _ => None,
    }
}

impl SectionData {
    /// The values of a type, by its code, from their bytes.
    pub(super) fn of_bytes(code: u8, bytes: &[u8]) -> Self {
        match code {
            0 => Self::F64(little_endian::read(bytes)),
            1 => Self::U64(little_endian::read(bytes)),
            2 => Self::I64(little_endian::read(bytes)),
            _ => Self::U8(bytes.to_vec()),
        }
    }
}

fn length_u32(length: usize) -> io::Result<u32> {
    u32::try_from(length).map_err(|_| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            "more than 2^32 sections or letters",
        )
    })
}

/// Sums up what passes through.
pub(super) struct ChecksumWriter<W> {
    file: W,
    crc: Hasher,
}

impl<W: Write> ChecksumWriter<W> {
    pub(super) fn new(file: W) -> Self {
        Self {
            file,
            crc: Hasher::new(),
        }
    }

    /// Adds bytes that somebody else has written, by their checksum.
    pub(super) fn add_part(&mut self, part: &Hasher) {
        self.crc.combine(part);
    }

    /// The checksum so far.
    pub(super) fn sum(&self) -> u32 {
        self.crc.clone().finalize()
    }
}

impl<W: Write> Write for ChecksumWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.crc.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Bytes that are left to parse.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: u64) -> Result<&'a [u8], String> {
        let split = usize::try_from(count)
            .ok()
            .and_then(|count| self.0.split_at_checked(count));
        let (taken, rest) = split.ok_or("a section reaches beyond the end")?;
        self.0 = rest;
        Ok(taken)
    }

    fn number<T: LittleEndian>(&mut self) -> Result<T, String> {
        self.take(T::SIZE as u64).map(T::get)
    }
}
