//! Whole files, unless what is made of them does not fit into the memory of the machine.
//!
//! Everything that is read goes through here: see [`proctor_kernel::memory`].

use proctor_kernel::memory::{Memory, words};
use std::fs;
use std::io::{self, Read};
use std::path::Path;

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
/// As [`read`], and bytes that are no UTF-8.
pub fn read_to_string(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|_| {
        io::Error::new(
            io::ErrorKind::InvalidData,
            "stream did not contain valid UTF-8",
        )
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
    let mut bytes = vec![];
    // One more than may be, to tell what ends there from what goes on; a file can grow while it is read.
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
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
