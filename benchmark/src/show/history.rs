//! A history of records on a terminal.

use super::{Table, filled, in_words, number, shortened};
use crate::history::divisive::CHANCE;
use crate::history::{ChangePoint, History, Point, Series};
use crate::judge::change::Direction;
use crate::record::Meaning;
use crate::show::{percent, seconds};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Columns of a terminal.
const WIDTH: usize = 80;
/// Changes that are listed where not all are.
const LISTED: usize = 12;
/// Characters of the name of a number.
const NAME: usize = 46;
/// Characters of a commit.
const COMMIT: usize = 10;

/// Number of values that changed at a record, and their direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Computed numbers and times that became worse.
    pub worse: usize,
    /// The same, better.
    pub better: usize,
    /// Figures of which neither side is better.
    pub moved: usize,
    /// Computed numbers that changed by no more than sums in another order do.
    pub close: usize,
}

impl Tally {
    /// Counts the changes at each record.
    #[must_use]
    pub fn of(history: &History, changes: &[ChangePoint]) -> Vec<Self> {
        let mut all = vec![Self::default(); history.points.len()];
        for change in changes {
            let tally = &mut all[change.at];
            match change.moved {
                Direction::Worse => tally.worse += 1,
                Direction::Better => tally.better += 1,
                Direction::Close => tally.close += 1,
                _ => tally.moved += 1,
            }
        }
        all
    }

    /// True if nothing changed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A commit in short, or the name of a file.
#[must_use]
pub fn short(point: &Point) -> String {
    if point.commit.is_empty() {
        shortened(&point.subject, COMMIT)
    } else {
        point.commit.chars().take(COMMIT).collect()
    }
}

/// The day of a record.
#[must_use]
pub fn day(point: &Point) -> String {
    point.date.chars().take("2026-01-01".len()).collect()
}

/// Value of a number, in its unit.
#[must_use]
pub fn written(series: &Series, value: f64) -> String {
    match series.meaning {
        _ if series.is_time() => seconds(value),
        Meaning::Error => percent(value),
        _ => number(value),
    }
}

/// Size of the change, in per cent or as a factor.
#[must_use]
pub fn change(change: &ChangePoint) -> String {
    let ratio = change.after / change.before;
    if (0.1..10.0).contains(&ratio) {
        format!("{:+.1} %", 100.0 * (ratio - 1.0))
    } else if (1e-3..1e5).contains(&ratio) {
        format!("x{}", number(ratio))
    } else if ratio.is_finite() {
        format!("x{ratio:.1e}")
    } else {
        "from 0".to_owned()
    }
}

/// A change that stands for all that happened to its case at its record in the same way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// The largest of them.
    pub change: ChangePoint,
    /// Number of others.
    pub others: usize,
}

/// The largest changes that are no matter of round-off, one per case and record: losses first, then gains, each by its size.
#[must_use]
pub fn largest(history: &History, changes: &[ChangePoint]) -> Vec<Largest> {
    let rank = |change: &ChangePoint| match change.moved {
        Direction::Worse => 0,
        Direction::Better => 1,
        _ => 2,
    };
    let size = |change: &ChangePoint| {
        (change.after - change.before).abs() / change.after.abs().max(change.before.abs())
    };
    let mut all: Vec<&ChangePoint> = changes
        .iter()
        .filter(|change| change.moved != Direction::Close)
        .collect();
    all.sort_by(|a, b| rank(a).cmp(&rank(b)).then(size(b).total_cmp(&size(a))));
    let mut first: HashMap<(&str, usize, u8), usize> = HashMap::new();
    let mut largest: Vec<Largest> = vec![];
    for change in all {
        let name = history.series[change.series].case.name.as_str();
        let case = name.split(['/', ':']).next().unwrap_or(name);
        match first.entry((case, change.at, rank(change))) {
            Entry::Occupied(place) => largest[*place.get()].others += 1,
            Entry::Vacant(place) => {
                place.insert(largest.len());
                largest.push(Largest {
                    change: *change,
                    others: 0,
                });
            }
        }
    }
    largest
}

/// A line per record in which something changed, and the changes; `all` lists all of them, in the order of time.
///
/// # Errors
/// If `out` cannot be written.
pub fn terminal(history: &History, all: bool, out: &mut dyn Write) -> io::Result<()> {
    let changes = history.change_points();
    heading(history, out)?;
    let tallies = Tally::of(history, &changes);
    let mut table = Table::new([
        "record", "day", "worse", "better", "moved", "close", "new", "gone",
    ]);
    let new_and_gone = history.new_and_gone();
    let mut quiet = 0;
    for (at, tally) in tallies.iter().enumerate() {
        let new_and_gone = new_and_gone[at];
        if tally.is_empty() && new_and_gone == [0; 2] {
            quiet += 1;
            continue;
        }
        let counts = [tally.worse, tally.better, tally.moved, tally.close].into_iter();
        let counts = counts.chain(new_and_gone).map(|count| {
            if count == 0 {
                "-".to_owned()
            } else {
                count.to_string()
            }
        });
        let point = &history.points[at];
        table.push([short(point), day(point)].into_iter().chain(counts));
    }
    if table.lines().len() > 1 {
        writeln!(
            out,
            "\nHow many numbers changed; close: by no more than sums in another order do\n"
        )?;
        write!(out, "{table}")?;
        let verb = if quiet == 1 { "changes" } else { "change" };
        writeln!(
            out,
            "  {quiet} of {} records {verb} nothing",
            history.points.len()
        )?;
    }
    if changes.is_empty() {
        return writeln!(out, "\nNo number changed.");
    }
    let alone = |change: &ChangePoint| Largest {
        change: *change,
        others: 0,
    };
    let listed: Vec<Largest> = if all {
        changes.iter().map(alone).collect()
    } else {
        largest(history, &changes)
            .into_iter()
            .take(LISTED)
            .collect()
    };
    let what = if all {
        "All changes"
    } else {
        "Largest changes of each case and record, losses first (--all: every one)"
    };
    writeln!(out, "\n{what}\n")?;
    for found in &listed {
        line(history, found, out)?;
    }
    Ok(())
}

/// A change in three lines: number and size, values, record.
fn line(history: &History, found: &Largest, out: &mut dyn Write) -> io::Result<()> {
    let Largest {
        change: found,
        others,
    } = found;
    let series = &history.series[found.series];
    let point = &history.points[found.at];
    let word = match found.moved {
        Direction::Worse => "worse",
        Direction::Better => "better",
        Direction::Close => "close",
        _ => "moved",
    };
    let mut values = format!(
        "{} -> {}",
        written(series, found.before),
        written(series, found.after)
    );
    if series.is_time() {
        let _ = write!(values, ", p {:.0e}", found.chance);
    }
    if *others > 0 {
        let _ = write!(values, "; {others} more of this case");
    }
    let name = shortened(&series.name(), NAME);
    writeln!(out, "  {word:6}  {name:NAME$}  {}", change(found))?;
    writeln!(out, "          {values}")?;
    let subject = in_words(&point.subject, WIDTH - 10 - COMMIT - 2);
    writeln!(out, "          {}  {subject}", short(point))
}

/// The values that were read.
fn heading(history: &History, out: &mut dyn Write) -> io::Result<()> {
    let times = history
        .series
        .iter()
        .filter(|series| series.is_time())
        .count();
    let mut text = format!(
        "{} records, {} numbers that are exact",
        history.points.len(),
        history.series.len() - times
    );
    if times > 0 {
        let _ = write!(text, ", {times} times (change points at p < {CHANCE})");
    }
    if let (Some(first), Some(last)) = (history.points.first(), history.points.last()) {
        let _ = write!(
            text,
            ", from {} {} to {} {}.",
            short(first),
            day(first),
            short(last),
            day(last)
        );
    }
    let mut machines: Vec<&str> = history
        .points
        .iter()
        .map(|point| point.machine.as_str())
        .collect();
    machines.dedup();
    if times > 0 && machines.len() > 1 {
        text.push_str(" The machine changes on the way, and with it the times.");
    }
    for line in filled(text.split(' '), WIDTH) {
        writeln!(out, "{line}")?;
    }
    for line in &history.left_out {
        writeln!(out, "left out: {line}")?;
    }
    Ok(())
}
