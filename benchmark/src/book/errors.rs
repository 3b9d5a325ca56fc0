//! The errors of the kept runs of a case: as a table with observed orders, and over the work that they took.

use crate::record::{Kind, LADDER, Record, key};
use crate::show::chart::{
    Axis, Chart, Colour, Entry, Format, Mark, Point, Scale, Series, Strength, Stroke,
};
use crate::show::{grouped, number, percent};
use proctor_verification::case::Case;
use std::fmt::Write as _;

/// Errors that a table shows.
const COLUMNS: usize = 4;
/// Runs that a table shows; the finest of each ladder where there are more.
const ROWS: usize = 32;
/// Lines of a chart.
const LINES: usize = 5;

/// A kept run.
struct KeptRun {
    label: String,
    ladder: String,
    cell: f64,
    particles: f64,
    steps: f64,
    errors: Vec<Option<f64>>,
}

/// The runs of a case and the names of the errors that are shown.
pub struct Errors {
    case: &'static str,
    names: Vec<String>,
    runs: Vec<KeptRun>,
}

impl Errors {
    /// The runs of a case in a record.
    pub fn of(case: &'static Case, record: &Record) -> Self {
        let rows: Vec<_> = record
            .rows
            .iter()
            .filter(|row| matches!(row.kind, Kind::Sample { .. }) && row.error.is_none())
            .filter_map(|row| {
                let label = row.name.strip_prefix(case.name())?.strip_prefix('/')?;
                Some((label, row))
            })
            .collect();
        let named = case.named_quantities().into_iter();
        let named = named.map(|name| (format!("error_{}", key(name)), name.to_owned()));
        let has = |key: &String| rows.iter().any(|(_, row)| row.counters.contains_key(key));
        let shown: Vec<(String, String)> =
            named.filter(|(key, _)| has(key)).take(COLUMNS).collect();
        let count = |row: &crate::record::Row, key: &str| {
            row.counters.get(key).copied().unwrap_or(f64::NAN)
        };
        let compared = |row: &crate::record::Row| {
            shown.is_empty() || { shown.iter() }.any(|(key, _)| row.counters.contains_key(key))
        };
        let runs = rows.iter().filter(|(_, row)| compared(row));
        let runs = runs.map(|(label, row)| KeptRun {
            label: (*label).to_owned(),
            ladder: row.labels.get(LADDER).cloned().unwrap_or_default(),
            cell: count(row, "cell_size"),
            particles: count(row, "particles"),
            steps: count(row, "steps"),
            errors: { shown.iter() }
                .map(|(key, _)| row.counters.get(key).copied())
                .collect(),
        });
        Self {
            case: case.name(),
            runs: runs.collect(),
            names: shown.into_iter().map(|(_, name)| name).collect(),
        }
    }

    /// Runs with their errors; behind an error its observed order against the coarser run of the same ladder.
    pub fn table(&self) -> String {
        if self.names.is_empty() {
            return String::new();
        }
        let mut text = "\n## Errors\n\n".to_owned();
        if self.runs.len() > ROWS {
            let _ = writeln!(text, "The finest run of each ladder.\n");
        } else if self
            .runs
            .iter()
            .enumerate()
            .any(|(i, _)| self.coarser(i).is_some())
        {
            text.push_str(
                "Behind an error stands its observed order against the coarser run above it.\n\n",
            );
        }
        let _ = write!(text, "| run | h (m) | particles | steps |");
        for name in &self.names {
            let _ = write!(text, " {} |", name.replace('|', "\\|"));
        }
        text.push_str("\n|---|--:|--:|--:|");
        text.push_str(&"--:|".repeat(self.names.len()));
        text.push('\n');
        for (i, run) in self.runs.iter().enumerate() {
            let finer = self.runs.get(i + 1);
            if self.runs.len() > ROWS && finer.is_some_and(|finer| finer.ladder == run.ladder) {
                continue;
            }
            let _ = write!(
                text,
                "| {} | {} | {} | {} |",
                run.label.replace('|', "\\|"),
                number(run.cell),
                grouped(run.particles as u64),
                grouped(run.steps as u64)
            );
            for (column, error) in run.errors.iter().enumerate() {
                let order = self.order(i, column);
                let order = order.map_or_else(String::new, |order| format!(" ({order:.2})"));
                let error = error.map_or_else(String::new, percent);
                let _ = write!(text, " {error}{order} |");
            }
            text.push('\n');
        }
        text
    }

    /// The run before one, where it is coarser and of the same ladder.
    fn coarser(&self, run: usize) -> Option<&KeptRun> {
        let before = &self.runs[run.checked_sub(1)?];
        let same = before.ladder == self.runs[run].ladder && !before.ladder.is_empty();
        (same && before.cell > self.runs[run].cell).then_some(before)
    }

    /// log(e0/e1)/log(h0/h1) of an error against that of the coarser run.
    fn order(&self, run: usize, column: usize) -> Option<f64> {
        let before = self.coarser(run)?;
        let (coarse, fine) = (before.errors[column]?, self.runs[run].errors[column]?);
        let order = libm::log(coarse / fine) / libm::log(before.cell / self.runs[run].cell);
        (order.is_finite() && coarse > 1e-9 && fine > 1e-9).then_some(order)
    }

    /// The first error over the work of a run, a line per ladder of more than one run.
    pub fn chart(&self) -> Option<Chart> {
        let name = self.names.first()?;
        let mut ladders: Vec<&str> = vec![];
        for (i, run) in self.runs.iter().enumerate() {
            if self.coarser(i).is_some() && !ladders.contains(&run.ladder.as_str()) {
                ladders.push(&run.ladder);
            }
        }
        ladders.truncate(LINES);
        if ladders.is_empty() {
            return None;
        }
        let looks = |i: usize| {
            let marks = [
                Mark::Circle,
                Mark::Square,
                Mark::Triangle,
                Mark::Diamond,
                Mark::Circle,
            ];
            (Colour::Hue(i), marks[i])
        };
        let line = |i: usize, ladder: &str| {
            let own = self.runs.iter().filter(|run| run.ladder == ladder);
            let points = own.filter_map(|run| {
                let error = run.errors[0].filter(|error| *error > 0.0)?;
                let work = run.particles * run.steps;
                (work > 0.0).then(|| Point {
                    x: work,
                    y: Some(error),
                    title: format!(
                        "{}: {} with a work of {}",
                        run.label,
                        percent(error),
                        number(work)
                    ),
                })
            });
            Series {
                colour: looks(i).0,
                mark: looks(i).1,
                stroke: Stroke::Solid,
                strength: Strength::Plain,
                points: points.collect(),
            }
        };
        let series: Vec<Series> = { ladders.iter().enumerate() }
            .map(|(i, ladder)| line(i, ladder))
            .collect();
        if series.iter().all(|series| series.points.len() < 2) {
            return None;
        }
        let axis = |label: String, format| Axis {
            label,
            scale: Scale::Log,
            format,
        };
        let word = |ladder: &str| {
            let short = ladder
                .split_once('/')
                .map_or(ladder, |(_, variant)| variant);
            short.to_owned()
        };
        Some(Chart {
            title: format!("{}: error of {name} against work", self.case),
            description: format!(
                "Error of {name} of {} ladders over the particles times steps of each run.",
                ladders.len()
            ),
            x: axis("particles times steps".to_owned(), Format::Number),
            y: axis(format!("error of {name}"), Format::Percent),
            guides: vec![],
            legend: { ladders.iter().enumerate() }
                .map(|(i, ladder)| Entry {
                    label: word(ladder),
                    colour: looks(i).0,
                    mark: looks(i).1,
                    stroke: Stroke::Solid,
                    strength: Strength::Plain,
                    open: false,
                })
                .collect(),
            series,
            equal: false,
        })
    }
}
