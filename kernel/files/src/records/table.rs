//! Reading tables of numbers: separators found by looking, every fault with its line and column.

use std::borrow::Cow;
use std::path::Path;

use crate::json::unreadable;
use proctor_scene::{Dimension, History, Location, Problem, SceneError};

/// More problems than this in one file say the same again.
const MOST_PROBLEMS: usize = 10;

/// Reads an accelerogram: columns t, ax, ay and in three dimensions az, separated by `,`, `;`, tabs or blanks.
///
/// `header` says whether the first line holds names; `None` looks. Blank lines are skipped.
///
/// # Errors
/// A file that cannot be read, a first line that contradicts `header`, rows of another length, text that is not
/// a finite number, times that do not increase, fewer than two rows; each with file, line and column.
pub fn read(
    file: &Path,
    header: Option<bool>,
    dimension: Dimension,
) -> Result<History, SceneError> {
    let names = &["t", "ax", "ay", "az"][..=dimension.axes()];
    let mut table = Table::read(file, header, names)?;
    for row in 1..table.rows.len() {
        let (before, now) = (table.rows[row - 1].numbers[0], table.rows[row].numbers[0]);
        if now <= before {
            let at = (table.rows[row].line, 1);
            table.add(
                at,
                format!("the time {now}"),
                format!("a time after that of the row before, {before} [s]"),
            );
        }
    }
    if table.rows.len() < 2 && table.problems.is_empty() {
        table.add(
            (table.lines.max(1), 1),
            if table.rows.is_empty() {
                "no row of numbers"
            } else {
                "one row of numbers"
            },
            "at least two rows",
        );
    }
    let rows = table.finish()?;
    Ok(History {
        times: rows.iter().map(|row| row.numbers[0]).collect(),
        values: rows.iter().map(|row| padded(&row.numbers[1..])).collect(),
    })
}

/// Two or three components as a vector.
pub(super) fn padded(components: &[f64]) -> [f64; 3] {
    std::array::from_fn(|axis| components.get(axis).copied().unwrap_or(0.0))
}

/// A row of numbers, and where they stand.
pub(crate) struct Row {
    pub line: usize,
    pub columns: Vec<usize>,
    pub numbers: Vec<f64>,
}

/// A table while it is read.
pub(crate) struct Table<'a> {
    file: &'a Path,
    lines: usize,
    /// Names of the columns, if the first row holds names.
    pub header: Option<Vec<String>>,
    pub rows: Vec<Row>,
    problems: Vec<Problem>,
}

impl<'a> Table<'a> {
    /// The text of a file.
    pub fn text(file: &Path, accepted: &str) -> Result<String, SceneError> {
        crate::reading::read_to_string(file)
            .map_err(|error| unreadable(&file.display().to_string(), &error, accepted))
    }

    /// Rows of so many numbers; `header` as for [`read`].
    pub fn read(file: &'a Path, header: Option<bool>, names: &[&str]) -> Result<Self, SceneError> {
        let text = Self::text(
            file,
            &format!("a text file with the columns {}", names.join(", ")),
        )?;
        let text = text.trim_start_matches('\u{feff}');
        let mut table = Self {
            file,
            lines: text.lines().count(),
            header: None,
            rows: Vec::new(),
            problems: Vec::new(),
        };
        table.parse(text, header, names);
        Ok(table)
    }

    fn parse(&mut self, text: &str, header: Option<bool>, names: &[&str]) {
        let lines: Vec<&str> = text.lines().collect();
        let separator = Separator::of(&lines);
        let text = separator.alone(text);
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(separator.byte())
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut is_first = true;
        for record in reader.records() {
            let record = match record {
                Ok(record) => record,
                Err(error) => {
                    let line = error.position().map_or(1, csv::Position::line) as usize;
                    self.add((line, 1), error.to_string(), "a row of numbers");
                    return;
                }
            };
            let line = record.position().map_or(1, csv::Position::line) as usize;
            if record.iter().all(str::is_empty) {
                continue;
            }
            let columns = separator.columns(lines.get(line - 1).copied().unwrap_or(""));
            let is_header = is_first && self.is_header(&record, header, line, names);
            is_first = false;
            if is_header {
                self.header = Some(record.iter().map(str::to_lowercase).collect());
            } else {
                self.take(&record, line, columns, names, separator);
            }
            if self.problems.len() >= MOST_PROBLEMS {
                return;
            }
        }
    }

    /// True if the first row holds names; a row that contradicts the scene is a problem.
    fn is_header(
        &mut self,
        record: &csv::StringRecord,
        said: Option<bool>,
        line: usize,
        names: &[&str],
    ) -> bool {
        let numbers = record
            .iter()
            .filter(|text| text.parse::<f64>().is_ok())
            .count();
        let shown = record.iter().collect::<Vec<_>>().join(", ");
        if numbers == record.len() && said == Some(true) {
            self.add(
                (line, 1),
                format!("numbers ({shown}) where `header` is true"),
                format!("the names {}; or `header` false", names.join(", ")),
            );
        } else if numbers == 0 && said == Some(false) {
            self.add(
                (line, 1),
                format!("names ({shown}) where `header` is false"),
                "numbers; or `header` true",
            );
        }
        numbers == 0
    }

    fn take(
        &mut self,
        record: &csv::StringRecord,
        line: usize,
        columns: Vec<usize>,
        names: &[&str],
        separator: Separator,
    ) {
        if record.len() != names.len() {
            let found = match record.len() {
                1 => "one column: no `,`, `;`, tab or blank separates two".to_owned(),
                count => format!("{count} columns, separated by {}", separator.words()),
            };
            self.add(
                (line, 1),
                found,
                format!(
                    "{} columns, separated by `,`, `;`, tabs or blanks: {}",
                    names.len(),
                    names.join(", ")
                ),
            );
            return;
        }
        let mut numbers = Vec::with_capacity(names.len());
        for (i, text) in record.iter().enumerate() {
            match text.parse::<f64>() {
                Ok(number) if number.is_finite() => numbers.push(number),
                _ => self.add(
                    (line, columns.get(i).copied().unwrap_or(1)),
                    format!("{text:?} in column {}", names[i]),
                    if text.contains(',') && text.replacen(',', ".", 1).parse::<f64>().is_ok() {
                        "a finite number with a decimal point"
                    } else {
                        "a finite number"
                    },
                ),
            }
        }
        if numbers.len() == names.len() {
            self.rows.push(Row {
                line,
                columns,
                numbers,
            });
        }
    }

    pub fn add(
        &mut self,
        (line, column): (usize, usize),
        found: impl Into<String>,
        accepted: impl Into<String>,
    ) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems
                .push(Problem::new("", found, accepted).at(Location {
                    file: self.file.display().to_string(),
                    line,
                    column,
                }));
        }
    }

    /// The rows, or everything that is wrong with them.
    pub fn finish(self) -> Result<Vec<Row>, SceneError> {
        SceneError::unless_empty(self.problems)?;
        Ok(self.rows)
    }
}

/// Separator of the columns of a table.
#[derive(Clone, Copy)]
enum Separator {
    Comma,
    Semicolon,
    Tab,
    Blanks,
}

impl Separator {
    /// Separator of the first line that begins with a number, else of the first that is not blank: a header may have blanks
    /// within its names.
    fn of(lines: &[&str]) -> Self {
        let mut filled = lines.iter().map(|line| line.trim());
        let is_number = |line: &&str| {
            let first = line.split(|c: char| c.is_whitespace() || ",;".contains(c));
            (first.into_iter().next()).is_some_and(|text| text.parse::<f64>().is_ok())
        };
        let line = (filled.clone().find(is_number))
            .or_else(|| filled.find(|line| !line.is_empty()))
            .unwrap_or("");
        // A blank beside a comma is no separator; a comma within what blanks separate is a decimal one.
        let alone = |field: &str| !field.starts_with([',', ';']) && !field.ends_with([',', ';']);
        let by_blanks = line.contains(char::is_whitespace) && line.split_whitespace().all(alone);
        let has_blank = |field: &str| field.trim().contains(char::is_whitespace);
        if by_blanks && line.contains('\t') && !line.split('\t').any(has_blank) {
            Self::Tab
        } else if by_blanks {
            Self::Blanks
        } else if line.contains(';') {
            Self::Semicolon
        } else {
            Self::Comma
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Comma => "`,`",
            Self::Semicolon => "`;`",
            Self::Tab => "tabs",
            Self::Blanks => "blanks",
        }
    }

    /// Byte of it in [`Separator::alone`].
    fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab | Self::Blanks => b'\t',
        }
    }

    /// The text with one character between two columns, line by line.
    fn alone(self, text: &str) -> Cow<'_, str> {
        if !matches!(self, Self::Blanks) {
            return text.into();
        }
        let mut alone = String::with_capacity(text.len());
        for line in text.lines() {
            for (i, field) in line.split_whitespace().enumerate() {
                if i > 0 {
                    alone.push('\t');
                }
                alone.push_str(field);
            }
            alone.push('\n');
        }
        alone.into()
    }

    /// Column, counted from 1 in characters, at which the text of each field starts.
    fn columns(self, line: &str) -> Vec<usize> {
        if matches!(self, Self::Blanks) {
            let mut columns = vec![];
            let mut before = ' ';
            for (i, c) in line.chars().enumerate() {
                if before.is_whitespace() && !c.is_whitespace() {
                    columns.push(i + 1);
                }
                before = c;
            }
            return columns;
        }
        let mut start = 0;
        line.split(self.byte() as char)
            .map(|field| {
                let blank = field.chars().take_while(|c| c.is_whitespace()).count();
                let column = start + blank + 1;
                start += field.chars().count() + 1;
                column
            })
            .collect()
    }
}
