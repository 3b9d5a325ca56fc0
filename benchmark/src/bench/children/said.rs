//! What a process said: its two outputs, kept in files beside its results, and their ends for a message.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// Files of the two outputs, and what a message calls them. The error is read first.
const OUTPUTS: [(&str, &str); 2] = [
    ("standard-error.txt", "on standard error"),
    ("standard-output.txt", "on standard output"),
];
/// Lines of each that a message shows.
const LINES: usize = 4;
/// Bytes of the end of a file that are looked at, and letters of a line that are shown.
const END: u64 = 8192;
const LETTERS: usize = 200;

/// The files for the standard error and the standard output of a process, in the folder of its results.
pub(super) fn outputs(out: &Path) -> Result<[Stdio; 2], String> {
    let create = |name: &str| {
        let path = out.join(name);
        File::create(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let [errors, output] = OUTPUTS.map(|(name, _)| name);
    Ok([create(errors)?.into(), create(output)?.into()])
}

/// A reason for a failure with the last that the process said on either output.
pub(super) fn with_words(reason: &str, out: &Path) -> String {
    let mut text = reason.to_owned();
    for (name, words) in OUTPUTS {
        let lines = last_lines(&out.join(name));
        if !lines.is_empty() {
            text = format!("{text}; {words}: {}", lines.join(" / "));
        }
    }
    text
}

/// The last lines of a file that are not blank.
fn last_lines(path: &PathBuf) -> Vec<String> {
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
            let plain = line.chars().filter(|c| !c.is_control());
            plain.take(LETTERS).collect::<String>().trim().to_owned()
        })
        .filter(|line| !line.is_empty())
        .collect();
    lines[lines.len().saturating_sub(LINES)..].to_vec()
}
