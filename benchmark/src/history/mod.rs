//! Records over commits: how each number went, and where it changed.
//!
//! Results are the same bit by bit until somebody changes the program, so that every other value is a change point.
//! Times are noisy: their change points are those of [`divisive`].

pub mod divisive;
mod numbers;
mod read;

pub use read::{HistoryError, of_files, of_git};

use crate::judge::change::{Better, Direction, tolerance};
use crate::record::row::GATE_VALUE;
use crate::record::{CaseKey, Meaning};
use numbers::Numbers;
use std::collections::HashMap;

/// Place of a record in the history.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// Commit, as far as it is known.
    pub commit: String,
    /// Date as ISO 8601, as far as it is known.
    pub date: String,
    /// Subject of the commit, or name of the file.
    pub subject: String,
    /// Processor on which it was measured; empty if unknown.
    pub machine: String,
}

/// A number over all records.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The case that has it.
    pub case: CaseKey,
    /// Its key in the rows, or [`CPU`] or [`CLOCK`].
    pub number: String,
    /// Its meaning; a time is [`Meaning::Information`].
    pub meaning: Meaning,
    /// Better side of the number.
    pub better: Better,
    /// Its values, one per record; none where a record lacks it.
    pub values: Vec<Option<f64>>,
}

/// Name of a median time on the processors \[s\], of runs with one thread.
pub const CPU: &str = "cpu_seconds";
/// Name of a median time by the clock \[s\], of other runs.
pub const CLOCK: &str = "clock_seconds";

/// Relative errors, and what gates compare, are round-off where they differ by no more.
const ROUND_OFF: f64 = 1e-12;

/// A change of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangePoint {
    /// Index of the series.
    pub series: usize,
    /// Index of the first record after it.
    pub at: usize,
    /// Value before it; of a time the mean of the stretch.
    pub before: f64,
    /// Value after it.
    pub after: f64,
    /// Relative loss; negative where it is better.
    pub loss: f64,
    /// Direction in which it moved.
    pub moved: Direction,
    /// Chance of such a change without a reason; 0 of what is exact.
    pub chance: f64,
}

/// Records in the order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// The records.
    pub points: Vec<Point>,
    /// Every number that is judged, and every time.
    pub series: Vec<Series>,
    /// Records that could not be read, each with the reason.
    pub left_out: Vec<String>,
}

impl Series {
    /// Case and number.
    #[must_use]
    pub fn name(&self) -> String {
        // The name of a gate says what it found.
        if self.number == GATE_VALUE {
            self.case.name.clone()
        } else {
            format!("{}: {}", self.case, self.number)
        }
    }

    /// True if its values are noisy.
    #[must_use]
    pub fn is_time(&self) -> bool {
        self.number == CPU || self.number == CLOCK
    }

    fn is_round_off(&self, before: f64, after: f64) -> bool {
        let relative = matches!(self.meaning, Meaning::Error | Meaning::GateValue);
        relative && (after - before).abs() <= ROUND_OFF
    }

    /// Direction of improvement: 1 where a larger number is better, -1 where a smaller one is, none otherwise.
    #[must_use]
    pub fn direction(&self) -> Option<i8> {
        match self.better {
            Better::More => Some(1),
            Better::Less | Better::Lower => Some(-1),
            Better::Neither => None,
        }
    }

    /// The change points, in order; `index` is its own.
    #[must_use]
    pub fn change_points(&self, index: usize) -> Vec<ChangePoint> {
        let known: Vec<(usize, f64)> = self
            .values
            .iter()
            .enumerate()
            .filter_map(|(at, value)| Some((at, (*value)?)))
            .collect();
        let point = |at: usize, before: f64, after: f64, chance: f64| {
            let loss = self.better.loss(before, after);
            let moved = match self.better {
                _ if !self.is_time() && loss.abs() <= tolerance(self.meaning) => Direction::Close,
                _ if self.is_round_off(before, after) => Direction::Close,
                Better::Neither => Direction::Other,
                _ if loss > 0.0 => Direction::Worse,
                _ => Direction::Better,
            };
            ChangePoint {
                series: index,
                at,
                before,
                after,
                loss,
                moved,
                chance,
            }
        };
        if self.is_time() {
            let values: Vec<f64> = known.iter().map(|(_, value)| *value).collect();
            let splits = divisive::splits(&values).into_iter();
            return splits
                .map(|split| point(known[split.at].0, split.before, split.after, split.chance))
                .collect();
        }
        known
            .windows(2)
            .filter(|pair| pair[0].1.to_bits() != pair[1].1.to_bits())
            .map(|pair| point(pair[1].0, pair[0].1, pair[1].1, 0.0))
            .collect()
    }
}

/// A history that grows by one record after the other.
#[derive(Default)]
pub(super) struct Builder {
    history: History,
    /// The series of each case, in the order of its numbers.
    places: HashMap<CaseKey, Vec<usize>>,
}

impl Builder {
    /// Adds a record.
    pub fn add(&mut self, point: Point, numbers: Numbers) {
        let place = self.history.points.len();
        self.history.points.push(point);
        let all = &mut self.history.series;
        for (case, numbers) in numbers {
            let of_case = self.places.entry(case.clone()).or_default();
            for (order, number) in numbers.into_iter().enumerate() {
                // Most records have the same numbers in the same order.
                let is_it = |index: &usize| all[*index].number == number.key;
                let known = of_case.get(order).filter(|index| is_it(index));
                let known = known
                    .or_else(|| of_case.iter().find(|index| is_it(index)))
                    .copied();
                let index = known.unwrap_or_else(|| {
                    all.push(Series {
                        case: case.clone(),
                        number: number.key,
                        meaning: number.meaning,
                        better: number.better,
                        values: vec![],
                    });
                    of_case.push(all.len() - 1);
                    all.len() - 1
                });
                let values = &mut all[index].values;
                values.resize(place, None);
                values.push(Some(number.value));
            }
        }
    }

    /// True if there is no record yet.
    pub fn is_empty(&self) -> bool {
        self.history.points.is_empty()
    }

    /// The history, ordered by dates if all records have one and `by_date` asks for it.
    pub fn finish(mut self, by_date: bool, left_out: Vec<String>) -> History {
        let points = std::mem::take(&mut self.history.points);
        let mut order: Vec<usize> = (0..points.len()).collect();
        if by_date && points.iter().all(|point| !point.date.is_empty()) {
            order.sort_by(|a, b| points[*a].date.cmp(&points[*b].date));
        }
        for series in &mut self.history.series {
            series.values.resize(points.len(), None);
            series.values = order.iter().map(|place| series.values[*place]).collect();
        }
        self.history.points = order.iter().map(|place| points[*place].clone()).collect();
        self.history.left_out = left_out;
        self.history
    }
}

impl History {
    /// Keeps the numbers whose names contain all of these words.
    pub fn keep(&mut self, words: &[String]) {
        let named = |series: &Series| {
            let name = series.name();
            words.iter().all(|word| name.contains(word.as_str()))
        };
        self.series.retain(named);
    }

    /// All change points, by record and then the largest loss first.
    #[must_use]
    pub fn change_points(&self) -> Vec<ChangePoint> {
        let series = self.series.iter().enumerate();
        let mut all: Vec<ChangePoint> = series
            .flat_map(|(index, series)| series.change_points(index))
            .collect();
        all.sort_by(|a, b| a.at.cmp(&b.at).then(b.loss.total_cmp(&a.loss)));
        all
    }

    /// Numbers of each record that are new since the record before it, and those that are gone since then.
    #[must_use]
    pub fn new_and_gone(&self) -> Vec<[usize; 2]> {
        let mut all = vec![[0; 2]; self.points.len()];
        for series in &self.series {
            for (at, pair) in series.values.windows(2).enumerate() {
                match pair {
                    [None, Some(_)] => all[at + 1][0] += 1,
                    [Some(_), None] => all[at + 1][1] += 1,
                    _ => {}
                }
            }
        }
        all
    }
}
