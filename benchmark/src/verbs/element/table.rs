//! A path of one's own as a table: a header, then rows in order of time.

use super::COMPONENTS;
use crate::exit::Failure;
use proctor_files::reading;
use proctor_scene::{Location, Problem, SceneError};
use proctor_verification::element::path::{Path as Steps, Row};
use std::path::Path;

/// Head of the column of times.
const TIME: &str = "time";
/// More problems than this say the same again.
const MOST_PROBLEMS: usize = 10;

/// Quantity of a column.
#[derive(Clone, Copy, PartialEq)]
enum Column {
    Time,
    Strain(usize),
    Stress(usize),
}

impl Column {
    fn of(name: &str) -> Option<Self> {
        if name == TIME {
            return Some(Self::Time);
        }
        let (kind, component) = name.split_once('_')?;
        let i = COMPONENTS.iter().position(|known| *known == component)?;
        match kind {
            "strain" => Some(Self::Strain(i)),
            "stress" => Some(Self::Stress(i)),
            _ => None,
        }
    }

    fn component(self) -> Option<usize> {
        match self {
            Self::Time => None,
            Self::Strain(i) | Self::Stress(i) => Some(i),
        }
    }

    fn name(self) -> String {
        match self {
            Self::Time => TIME.to_owned(),
            Self::Strain(i) => format!("strain_{}", COMPONENTS[i]),
            Self::Stress(i) => format!("stress_{}", COMPONENTS[i]),
        }
    }
}

/// The problems of a file.
struct Problems<'a> {
    file: &'a Path,
    all: Vec<Problem>,
}

impl Problems<'_> {
    fn add(&mut self, (line, column): (usize, usize), found: String, accepted: &str) {
        if self.all.len() < MOST_PROBLEMS {
            let location = Location {
                file: self.file.display().to_string(),
                line,
                column,
            };
            let problem = Problem::new("", found, accepted);
            self.all.push(problem.at(location));
        }
    }
}

/// Reads a path that begins under an isotropic pressure \[Pa\].
pub fn read(file: &Path, pressure: f64) -> Result<Steps, Failure> {
    let text = reading::read_to_string(file).map_err(|error| {
        let names =
            "a CSV file with the columns time, strain_xx ... strain_xy, stress_xx ... stress_xy";
        Failure::BadInput(format!(
            "{}: found {error}; accepted: {names}",
            file.display()
        ))
    })?;
    let text = text.trim_start_matches('\u{feff}');
    let mut problems = Problems { file, all: vec![] };
    let path = take(text, pressure, &mut problems);
    SceneError::unless_empty(problems.all).map_err(Failure::bad_input)?;
    Ok(path)
}

fn take(text: &str, pressure: f64, problems: &mut Problems<'_>) -> Steps {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let lines: Vec<&str> = text.lines().collect();
    let mut path = Steps {
        stress: [false; 6],
        rows: vec![],
    };
    let mut header: Option<Vec<Column>> = None;
    let (mut before, mut last) = (None, 1);
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                let line = error.position().map_or(1, csv::Position::line) as usize;
                problems.add((line, 1), error.to_string(), "a row of numbers");
                return path;
            }
        };
        let line = record.position().map_or(1, csv::Position::line) as usize;
        last = line;
        if record.iter().all(str::is_empty) {
            continue;
        }
        let at = columns(lines.get(line - 1).copied().unwrap_or(""));
        let place = |i: usize| (line, at.get(i).copied().unwrap_or(1));
        let Some(columns) = &header else {
            let Some(columns) = heads(&record, &place, problems) else {
                return path;
            };
            for column in &columns {
                if let Column::Stress(i) = column {
                    path.stress[*i] = true;
                }
            }
            header = Some(columns);
            continue;
        };
        let Some(row) = numbers(&record, columns, &place, problems) else {
            continue;
        };
        let of_time = place(columns.iter().position(|c| *c == Column::Time).unwrap_or(0));
        if let Some(before) = before.replace(row.time) {
            if row.time <= before {
                let accepted = format!("a time after that of the row before, {before} [s]");
                problems.add(of_time, format!("the time {}", row.time), &accepted);
            }
        } else if row.time < 0.0 {
            problems.add(
                of_time,
                format!("the time {}", row.time),
                "0 or greater [s]",
            );
        } else if row.time == 0.0 {
            // The start itself, which is not gone to.
            for (i, column) in columns.iter().enumerate() {
                let (value, start) = match column {
                    Column::Time => continue,
                    Column::Strain(c) => (row.values[*c], 0.0),
                    Column::Stress(c) => (row.values[*c], if *c < 3 { -pressure } else { 0.0 }),
                };
                if value != start {
                    let found = format!("{value} in column {} at time 0", column.name());
                    let accepted = format!("what is there at the start, {start}; or a later time");
                    problems.add(place(i), found, &accepted);
                }
            }
            continue;
        }
        path.rows.push(row);
    }
    if path.rows.is_empty() && problems.all.is_empty() {
        let accepted = "a header, then at least one row of a time greater than 0";
        problems.add((last, 1), "no row to go to".to_owned(), accepted);
    }
    path
}

/// The columns that a header names.
fn heads(
    record: &csv::StringRecord,
    place: &dyn Fn(usize) -> (usize, usize),
    problems: &mut Problems<'_>,
) -> Option<Vec<Column>> {
    let mut columns: Vec<Column> = vec![];
    for (i, name) in record.iter().enumerate() {
        let Some(column) = Column::of(name) else {
            let parts = COMPONENTS.join(", ");
            let accepted = format!("time, strain_ or stress_ and one of {parts}");
            problems.add(place(i), format!("the column {name:?}"), &accepted);
            continue;
        };
        if columns.contains(&column) {
            let accepted = "each column once";
            problems.add(place(i), format!("the column {name:?} again"), accepted);
        } else if let Some(other) = (columns.iter())
            .find(|other| column.component().is_some() && other.component() == column.component())
        {
            let found = format!("the columns {} and {name}", other.name());
            problems.add(place(i), found, "strain or stress of a component, not both");
        }
        columns.push(column);
    }
    if problems.all.is_empty() && !columns.contains(&Column::Time) {
        let accepted = "a column time [s], in which times increase";
        problems.add(place(0), "no column time".to_owned(), accepted);
    }
    problems.all.is_empty().then_some(columns)
}

/// A row of numbers below a header.
fn numbers(
    record: &csv::StringRecord,
    columns: &[Column],
    place: &dyn Fn(usize) -> (usize, usize),
    problems: &mut Problems<'_>,
) -> Option<Row> {
    if record.len() != columns.len() {
        let accepted = format!("{}, as in the header", columns.len());
        problems.add(place(0), format!("{} columns", record.len()), &accepted);
        return None;
    }
    let mut row = Row {
        time: 0.0,
        values: [0.0; 6],
    };
    let mut whole = true;
    for (i, (text, column)) in record.iter().zip(columns).enumerate() {
        match (text.parse::<f64>(), column.component()) {
            (Ok(number), Some(component)) if number.is_finite() => row.values[component] = number,
            (Ok(number), None) if number.is_finite() => row.time = number,
            _ => {
                let found = format!("{text:?} in column {}", column.name());
                problems.add(place(i), found, "a finite number");
                whole = false;
            }
        }
    }
    whole.then_some(row)
}

/// Column, counted from 1 in characters, at which the text of each field starts.
fn columns(line: &str) -> Vec<usize> {
    let mut start = 0;
    line.split(',')
        .map(|field| {
            let blank = field.chars().take_while(|c| c.is_whitespace()).count();
            let column = start + blank + 1;
            start += field.chars().count() + 1;
            column
        })
        .collect()
}
