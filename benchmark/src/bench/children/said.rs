//! The output of a process: its two streams, kept in files beside its results, and their ends for a message.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// Files of the two outputs, and what a message calls them. The error is read first.
const OUTPUTS: [(&str, &str); 2] = [
    ("standard-error.txt", "on standard error"),
    ("standard-output.txt", "on standard output"),
];
/// Lines of each that a message shows: the last ones, or where some speak of an error, those.
const LINES: usize = 4;
const ERRORS: usize = 10;
/// Subject of such lines.
const WORDS: [&str; 4] = ["error", "fatal", "exception", "panicked"];
/// Bytes of the end of a file that are looked at, and letters of a line that are shown.
const END: u64 = 65536;
const LETTERS: usize = 200;

/// Largest size of an output \[bytes\]: a program that writes more is ended.
pub(super) const MOST: u64 = 64 << 20;

/// The files for the standard error and the standard output of a process, in the folder of its results.
pub(super) struct Outputs([File; 2]);

impl Outputs {
    /// Creates both.
    pub(super) fn new(out: &Path) -> Result<Self, String> {
        let create = |name: &str| {
            let path = out.join(name);
            File::create(&path).map_err(|error| format!("{}: {error}", path.display()))
        };
        let [errors, output] = OUTPUTS.map(|(name, _)| name);
        Ok(Self([create(errors)?, create(output)?]))
    }

    /// Standard error and standard output for a process.
    pub(super) fn handed(&self) -> Result<[Stdio; 2], String> {
        let copy = |file: &File| file.try_clone().map_err(|error| error.to_string());
        Ok([copy(&self.0[0])?.into(), copy(&self.0[1])?.into()])
    }

    /// True where one is larger than [`MOST`]. A file that its process has removed still has a size.
    pub(super) fn flooded(&self) -> bool {
        let size = |file: &File| file.metadata().map_or(0, |data| data.len());
        self.0.iter().any(|file| size(file) > MOST)
    }
}

/// A reason for a failure with the last that the process said on either output, of the files in the folder `out` of its results;
/// where one of them speaks of an error, that one alone.
#[must_use]
pub fn with_words(reason: &str, out: &Path) -> String {
    let said = OUTPUTS.map(|(name, words)| (words, last_lines(&out.join(name))));
    let of_errors = said.iter().any(|(_, said)| said.of_errors);
    let mut text = reason.to_owned();
    for (words, LastLines { lines, .. }) in said
        .into_iter()
        .filter(|(_, said)| said.of_errors || !of_errors)
    {
        if !lines.is_empty() {
            text = format!("{text}; {words}: {}", lines.join(" / "));
        }
    }
    text
}

/// The end of an output.
struct LastLines {
    lines: Vec<String>,
    /// True if they speak of an error.
    of_errors: bool,
}

/// The last lines of a file that are not blank.
fn last_lines(path: &PathBuf) -> LastLines {
    let read = || -> std::io::Result<Vec<u8>> {
        let mut file = File::open(path)?;
        let length = file.metadata()?.len();
        file.seek(SeekFrom::Start(length.saturating_sub(END)))?;
        let mut bytes = vec![];
        file.take(END).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    // A file that cannot be read has nothing to add to the reason.
    let bytes = read().unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes);
    let lines: Vec<String> = text
        .lines()
        .map(|line| {
            plain(line)
                .chars()
                .take(LETTERS)
                .collect::<String>()
                .trim()
                .to_owned()
        })
        .filter(|line| !line.is_empty())
        .collect();
    let speaks = |line: &&String| {
        let line = line.to_lowercase();
        WORDS.iter().any(|word| line.contains(word))
    };
    let errors: Vec<String> = lines.iter().filter(speaks).cloned().collect();
    let of_errors = !errors.is_empty();
    let (lines, most) = if of_errors {
        (errors, ERRORS)
    } else {
        (lines, LINES)
    };
    LastLines {
        lines: lines[lines.len().saturating_sub(most)..].to_vec(),
        of_errors,
    }
}

/// A line without control characters, and without the sequences that set colours on a terminal.
fn plain(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line.chars();
    while let Some(c) = rest.next() {
        if c == '\u{1b}' {
            // To the letter that ends the sequence.
            let mut inside = rest.by_ref().skip_while(|c| *c == '[');
            inside.find(char::is_ascii_alphabetic);
        } else if !c.is_control() {
            text.push(c);
        }
    }
    text
}
