//! Reading of whole files, unless what is made of them does not fit into the memory of the machine.
//!
//! Everything that is read goes through here: see [`proctor_kernel::memory`].

use proctor_kernel::memory::{Memory, words};
use std::fs;
use std::io::{self, Read};
use std::path::Path;
use thiserror::Error;

/// Bytes of memory for each byte of a file that is read and taken apart: a list of empty lists has three letters and
/// three words of memory for each, and a vector that grows is there twice.
const PER_BYTE_OF_FILE: u64 = 32;
/// Longest text from what is no file and so has no length, a pipe or a device \[bytes\].
const LONGEST_STREAM: u64 = 1 << 30;

/// Reads a whole file, unless what is made of it does not fit into the memory of the machine.
///
/// # Errors
/// Those of the system; a file that is too large is [`io::ErrorKind::OutOfMemory`], with both numbers in its text.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_within(path, Memory::of_machine())
}

/// [`read`] as text.
///
/// # Errors
/// As [`read`], and a [`NotUtf8`] within an error of the kind [`io::ErrorKind::InvalidData`].
pub fn read_to_string(path: &Path) -> io::Result<String> {
    text(read(path)?)
}

/// Reads text from what has no name and no length, such as standard input, to its end.
///
/// # Errors
/// As [`read_to_string`].
pub fn stream_to_string(from: impl Read) -> io::Result<String> {
    let most = LONGEST_STREAM.min(Memory::of_machine().bytes() / PER_BYTE_OF_FILE);
    text(read_at_most(from, most)?)
}

/// A byte that stands in no text in UTF-8, and where it is, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the byte 0x{byte:02x} in line {line}, column {column} is no UTF-8")]
pub struct NotUtf8 {
    /// The byte.
    pub byte: u8,
    /// Its line.
    pub line: usize,
    /// Its column in characters.
    pub column: usize,
}

fn text(bytes: Vec<u8>) -> io::Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let end = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        // What is before the byte is sound.
        let before = String::from_utf8_lossy(&bytes[..end]);
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let found = NotUtf8 {
            byte: bytes[end],
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        };
        io::Error::new(io::ErrorKind::InvalidData, found)
    })
}

/// [`read`] with a memory of one's choice.
///
/// # Errors
/// As [`read`].
pub fn read_within(path: &Path, memory: Memory) -> io::Result<Vec<u8>> {
    let too_large = |length: u64| {
        let needed = length as f64 * PER_BYTE_OF_FILE as f64;
        let what = format!("a file of {}", words(length as f64));
        match memory.require(what, needed) {
            Ok(()) => Ok(()),
            Err(error) => Err(io::Error::new(io::ErrorKind::OutOfMemory, error)),
        }
    };
    let file = fs::File::open(path)?;
    let known = file.metadata()?;
    let most = if known.is_file() {
        too_large(known.len())?;
        memory.bytes() / PER_BYTE_OF_FILE
    } else {
        LONGEST_STREAM.min(memory.bytes() / PER_BYTE_OF_FILE)
    };
    read_at_most(file, most)
}

/// All bytes, unless there are more than `most`.
fn read_at_most(from: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = vec![];
    // One more than may be, to tell what ends there from what goes on; a file can grow while it is read.
    from.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::new(
            io::ErrorKind::OutOfMemory,
            format!(
                "more than {}, all that can be read into the memory that is free",
                words(most as f64)
            ),
        ));
    }
    Ok(bytes)
}
