//! `history.csv`: one row of sums and probes per output time.
//!
//! A row is appended with a single write. Replacing the whole file instead, as all other output does, would cost
//! the square of the number of rows, and a history may have a hundred thousand. The price is that a run killed
//! inside that write may leave half a row; it has no line end, readers of CSV show it as a short row, and
//! [`HistoryWriter::resume`] takes it off.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::{OutputError, OutputFolder, atomic};

/// Name of the history in the output folder.
pub const HISTORY: &str = "history.csv";

/// The first two columns of every history.
const LEADING: [&str; 2] = ["time", "step"];

/// Appends rows to a history.
#[derive(Debug)]
pub struct HistoryWriter {
    path: PathBuf,
    file: File,
    /// Columns behind `time` and `step`.
    columns: usize,
    /// Bytes of the header and of all complete rows.
    length: u64,
    last_time: Option<f64>,
}

/// State of a history that was continued.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ContinuedHistory {
    /// Rows kept.
    pub kept: usize,
    /// Rows taken off because they are later than the restart.
    pub dropped: usize,
    /// True if half a row, left by a killed run, was taken off.
    pub half_row: bool,
}

impl HistoryWriter {
    /// Replaces the history in `folder` by an empty one. `columns` are the names behind `time` and `step`.
    ///
    /// # Errors
    /// [`OutputError::Name`] if a name is empty, repeated or has control characters, [`OutputError::Write`].
    pub fn create(folder: &OutputFolder, columns: &[String]) -> Result<Self, OutputError> {
        let path = folder.file(HISTORY);
        let header = header(&path, columns)?;
        let line = csv_line(&header).map_err(|error| OutputError::write(&path, error))?;
        atomic::write(&path, |file| file.write_all(line.as_bytes()))?;
        Self::open(path, columns.len(), line.len() as u64, None)
    }

    /// Goes on with the history in `folder` from `restart_time` \[s\]: later rows and half a row at the end are
    /// taken off. Where there is no history yet, a new one is made.
    ///
    /// # Errors
    /// [`OutputError::Columns`] if the file has other columns, [`OutputError::Malformed`] if a complete row is not
    /// as this program writes it, [`OutputError::Name`], [`OutputError::Read`], [`OutputError::Write`]. The file is
    /// then untouched.
    pub fn resume(
        folder: &OutputFolder,
        columns: &[String],
        restart_time: f64,
    ) -> Result<(Self, ContinuedHistory), OutputError> {
        let path = folder.file(HISTORY);
        let text = match crate::reading::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Ok((Self::create(folder, columns)?, ContinuedHistory::default()));
            }
            Err(error) => return Err(OutputError::read(&path, error)),
        };
        let kept = kept_rows(&path, &text, header(&path, columns)?, restart_time)?;
        if kept.length < text.len() {
            atomic::write(&path, |file| {
                file.write_all(&text.as_bytes()[..kept.length])
            })?;
        }
        let writer = Self::open(path, columns.len(), kept.length as u64, kept.last_time)?;
        Ok((writer, kept.resumed))
    }

    fn open(
        path: PathBuf,
        columns: usize,
        length: u64,
        last_time: Option<f64>,
    ) -> Result<Self, OutputError> {
        match OpenOptions::new().append(true).open(&path) {
            Ok(file) => Ok(Self {
                path,
                file,
                columns,
                length,
                last_time,
            }),
            Err(error) => Err(OutputError::write(&path, error)),
        }
    }

    /// Appends one row: the time \[s\], the number of steps done, and one value per column in the shortest form that
    /// reads back to the same bits. A value that is not finite becomes an empty cell.
    ///
    /// # Errors
    /// [`OutputError::Length`] if there are more or fewer values than columns, [`OutputError::Time`] if the time is
    /// not finite or not later than the last row, [`OutputError::Write`]. The file keeps whole rows only.
    pub fn append(&mut self, time: f64, step: u64, values: &[f64]) -> Result<(), OutputError> {
        if values.len() != self.columns {
            return Err(OutputError::Length {
                path: self.path.clone(),
                name: "row".to_owned(),
                expected: self.columns,
                found: values.len(),
            });
        }
        if !time.is_finite() || self.last_time.is_some_and(|last| time <= last) {
            return Err(OutputError::Time {
                path: self.path.clone(),
                time,
                last: self.last_time,
            });
        }
        let line = row(time, step, values);
        if let Err(error) = self.file.write_all(line.as_bytes()) {
            // A full disk takes part of a row: take it off, or the next row would be joined to it. Should that
            // fail too, the end of the file lacks its line end and `resume` repairs it.
            let _ = self.file.set_len(self.length);
            return Err(OutputError::write(&self.path, error));
        }
        self.length += line.len() as u64;
        self.last_time = Some(time);
        Ok(())
    }

    /// Time of the last row \[s\].
    #[must_use]
    pub fn last_time(&self) -> Option<f64> {
        self.last_time
    }
}

/// All column names, checked.
fn header(path: &Path, columns: &[String]) -> Result<Vec<String>, OutputError> {
    let mut header: Vec<String> = LEADING.map(str::to_owned).to_vec();
    for name in columns {
        let reason = if name.is_empty() {
            "it is empty"
        } else if name.chars().any(char::is_control) {
            // A line end inside quotes is legal CSV, but a row would no longer be a line.
            "it has a control character"
        } else if header.contains(name) {
            "another column has it"
        } else {
            header.push(name.clone());
            continue;
        };
        return Err(OutputError::Name {
            path: path.to_path_buf(),
            name: name.clone(),
            reason,
        });
    }
    Ok(header)
}

/// `fields` as one line of CSV, quoted where needed, with its line end.
fn csv_line(fields: &[String]) -> io::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(fields)?;
    let bytes = writer
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?;
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// The line of a row, with its line end.
pub(crate) fn row(time: f64, step: u64, values: &[f64]) -> String {
    use std::fmt::Write as _;
    // `{:?}` is the shortest form that round-trips; unlike `{}` it writes 1e-300 with an exponent.
    let mut line = format!("{time:?},{step}");
    for value in values {
        line.push(',');
        if value.is_finite() {
            // Writing to a string does not fail.
            let _ = write!(line, "{value:?}");
        }
    }
    line.push('\n');
    line
}

/// The part of an earlier history that stays.
struct KeptRows {
    /// Length in bytes from the start.
    length: usize,
    last_time: Option<f64>,
    resumed: ContinuedHistory,
}

fn kept_rows(
    path: &Path,
    text: &str,
    expected: Vec<String>,
    restart_time: f64,
) -> Result<KeptRows, OutputError> {
    let mut lines = text.split_inclusive('\n').enumerate();
    let first = lines.next().map_or("", |(_, line)| line);
    let found = csv_fields(first);
    if found != expected {
        return Err(OutputError::Columns {
            path: path.to_path_buf(),
            expected,
            found,
        });
    }
    let mut kept = KeptRows {
        length: first.len(),
        last_time: None,
        resumed: ContinuedHistory::default(),
    };
    let mut previous: Option<f64> = None;
    for (index, line) in lines {
        if !line.ends_with('\n') {
            kept.resumed.half_row = true;
            break;
        }
        let time = row_time(line, expected.len())
            .map_err(|why| OutputError::malformed(path, index + 1, why))?;
        if previous
            .replace(time)
            .is_some_and(|previous| time <= previous)
        {
            return Err(OutputError::malformed(
                path,
                index + 1,
                "the times do not increase",
            ));
        }
        // Times increase, so what is kept is the start of the file.
        if time > restart_time {
            kept.resumed.dropped += 1;
        } else {
            kept.resumed.kept += 1;
            kept.length += line.len();
            kept.last_time = Some(time);
        }
    }
    Ok(kept)
}

/// The time of a complete row, which must have `columns` cells, each a number or empty.
fn row_time(line: &str, columns: usize) -> Result<f64, String> {
    let cells: Vec<&str> = line.trim_end().split(',').collect();
    if cells.len() != columns {
        return Err(format!("{} cells, expected {columns}", cells.len()));
    }
    if let Some(cell) = cells
        .iter()
        .find(|cell| !cell.is_empty() && cell.parse::<f64>().is_err())
    {
        return Err(format!("'{cell}' is not a number"));
    }
    let time: Option<f64> = cells[0].parse().ok().filter(|time: &f64| time.is_finite());
    time.ok_or_else(|| "no time in the first cell".to_owned())
}

fn csv_fields(line: &str) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    record
        .map(|record| record.iter().map(str::to_owned).collect())
        .unwrap_or_default()
}
