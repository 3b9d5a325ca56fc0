//! Records of a history: from files, or from what git keeps of one file.

use super::numbers::{self, Numbers};
use super::{Builder, History, Point};
use crate::record::error::Reason;
use crate::record::{Record, RecordError};
use crate::side_by_side::all_of;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use thiserror::Error;

/// Records that are read before their numbers are joined.
const AT_ONCE: usize = 32;

/// Reason for which there is no history.
#[derive(Debug, Error)]
pub enum HistoryError {
    /// A file that is no record of this version.
    #[error(transparent)]
    Record(RecordError),
    /// A path under which there is no record.
    #[error("{}: no record; accepted: records, or folders of them", .0.display())]
    Nothing(PathBuf),
    /// Git gave no answer: what it said.
    #[error("git: {0}")]
    Git(String),
}

/// The history of files, and of the files of folders. All are ordered by their dates if all of them have one; otherwise they
/// keep the order in which they are given, and the files of a folder that of their names.
///
/// # Errors
/// [`HistoryError`] if a file is no record.
pub fn of_files(paths: &[PathBuf]) -> Result<History, HistoryError> {
    let mut files: Vec<PathBuf> = vec![];
    for path in paths {
        let before = files.len();
        gather(path, &mut files);
        if files.len() == before {
            return Err(HistoryError::Nothing(path.clone()));
        }
    }
    let mut builder = Builder::default();
    for part in files.chunks(AT_ONCE) {
        for found in all_of(part, |path| of_file(path)) {
            let (point, numbers) = found.map_err(HistoryError::Record)?;
            builder.add(point, numbers);
        }
    }
    Ok(builder.finish(true, vec![]))
}

fn of_file(path: &Path) -> Result<(Point, Numbers), RecordError> {
    let text = proctor_files::reading::read(path)
        .map_err(|error| RecordError::new(path, Reason::Unreadable(error)))?;
    let (mut point, numbers) = read(path, &text)?;
    point.subject = path.display().to_string();
    Ok((point, numbers))
}

/// The numbers of a text that stands under that name.
fn read(named: &Path, text: &[u8]) -> Result<(Point, Numbers), RecordError> {
    match numbers::read(text) {
        Some(found) => Ok(found),
        // The reader of whole records says what is wrong, and where.
        None => match Record::parse(named, text) {
            Err(error) => Err(error),
            Ok(_) => Err(RecordError::new(named, Reason::NoBenchmarks)),
        },
    }
}

/// The records below a path, in the order of their names.
fn gather(path: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(path) else {
        files.push(path.to_owned());
        return;
    };
    let mut below: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    below.sort();
    for path in below {
        if path.is_dir() {
            gather(&path, files);
        } else if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            files.push(path);
        }
    }
}

/// The history of a file that git keeps, a record per commit that changed it.
///
/// # Errors
/// [`HistoryError`] if git cannot tell, or if no commit has a record there.
pub fn of_git(path: &Path) -> Result<History, HistoryError> {
    if path.is_dir() {
        let reason = format!("found the folder {}; accepted: a record", path.display());
        return Err(HistoryError::Git(reason));
    }
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new(".")).to_owned();
    let file = path
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let log = git(&folder)
        .args(["log", "--reverse", "--format=%H%x09%cI%x09%s", "--", &file])
        .output()
        .map_err(|error| HistoryError::Git(error.to_string()))?;
    if !log.status.success() {
        return Err(HistoryError::Git(first_line(&log.stderr)));
    }
    let text = String::from_utf8_lossy(&log.stdout).into_owned();
    let commits: Vec<[&str; 3]> = text
        .lines()
        .filter_map(|line| {
            let mut parts = line.splitn(3, '\t');
            Some([parts.next()?, parts.next()?, parts.next()?])
        })
        .collect();
    let names: Vec<String> = commits
        .iter()
        .map(|[hash, ..]| format!("{hash}:./{file}"))
        .collect();
    let unreadable = |error: std::io::Error| HistoryError::Git(error.to_string());
    let mut blobs = Blobs::new(&folder).map_err(unreadable)?;
    let (mut builder, mut left_out) = (Builder::default(), vec![]);
    for (part, names) in commits.chunks(AT_ONCE).zip(names.chunks(AT_ONCE)) {
        let texts: std::io::Result<Vec<_>> = names.iter().map(|name| blobs.read(name)).collect();
        let both: Vec<_> = part.iter().zip(texts.map_err(unreadable)?).collect();
        let found = all_of(&both, |([hash, date, subject], text)| {
            // A commit that removed the file has none.
            let text = text.as_deref()?;
            let named = PathBuf::from(format!("{}:{file}", &hash[..hash.len().min(10)]));
            Some(read(&named, text).map(|(mut point, numbers)| {
                (*hash).clone_into(&mut point.commit);
                (*date).clone_into(&mut point.date);
                (*subject).clone_into(&mut point.subject);
                (point, numbers)
            }))
        });
        for found in found.into_iter().flatten() {
            match found {
                Ok((point, numbers)) => builder.add(point, numbers),
                Err(error) => left_out.push(error.to_string()),
            }
        }
    }
    if builder.is_empty() {
        let why = left_out.into_iter().next();
        let nothing = || format!("{}: no commit has a record there", path.display());
        return Err(HistoryError::Git(why.unwrap_or_else(nothing)));
    }
    Ok(builder.finish(false, left_out))
}

fn git(folder: &Path) -> Command {
    let mut git = Command::new("git");
    git.arg("-C").arg(folder);
    git
}

fn first_line(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.lines()
        .next()
        .unwrap_or("ended without a word")
        .to_owned()
}

/// A process of git that hands out what it keeps under a name.
struct Blobs {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

impl Blobs {
    fn new(folder: &Path) -> std::io::Result<Self> {
        let mut child = git(folder)
            .args(["cat-file", "--batch"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let input = child.stdin.take();
        let output = child
            .stdout
            .take()
            .ok_or_else(|| std::io::Error::other("no pipe"))?;
        Ok(Self {
            child,
            input,
            output: BufReader::new(output),
        })
    }

    /// The value of a name; none where there is nothing.
    fn read(&mut self, name: &str) -> std::io::Result<Option<Vec<u8>>> {
        let input = self
            .input
            .as_mut()
            .ok_or_else(|| std::io::Error::other("no pipe"))?;
        writeln!(input, "{name}")?;
        input.flush()?;
        let mut heading = String::new();
        self.output.read_line(&mut heading)?;
        let words: Vec<&str> = heading.split_whitespace().collect();
        let [_, "blob", size] = words.as_slice() else {
            return Ok(None);
        };
        let size = size.parse().map_err(std::io::Error::other)?;
        let mut blob = vec![0; size];
        self.output.read_exact(&mut blob)?;
        self.output.read_exact(&mut [0])?;
        Ok(Some(blob))
    }
}

impl Drop for Blobs {
    fn drop(&mut self) {
        // Without its input it ends.
        self.input = None;
        let _ = self.child.wait();
    }
}
