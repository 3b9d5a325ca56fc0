//! Two runs of one scene as text: their ends, and how far their histories are apart.

use super::{Table, grouped, number, percent};
use crate::runs::{RunComparison, RunFolder, names};
use proctor_files::output::Summary;
use std::fmt::{self, Write as _};

/// Columns of which the differences are listed one by one.
const SHOWN: usize = 30;

/// Rows of the ends of runs: a name, and the value of each run.
#[must_use]
pub fn ends(runs: &[RunFolder]) -> Vec<(&'static str, Vec<String>)> {
    let row = |name, of: &dyn Fn(&Summary) -> String| -> (&'static str, Vec<String>) {
        (name, runs.iter().map(|run| of(&run.summary)).collect())
    };
    let real = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), number);
    let mut rows = vec![
        row("particles", &|s| grouped(s.particles)),
        row("nodes with mass", &|s| grouped(s.nodes_active)),
        row("steps", &|s| grouped(s.steps)),
        row("time (s)", &|s| real(s.time)),
        row("smallest step (s)", &|s| real(s.dt_min)),
        row("largest step (s)", &|s| real(s.dt_max)),
        row("mass (kg)", &|s| real(s.mass)),
        row("kinetic energy (J)", &|s| real(s.energy.kinetic)),
        row("strain energy (J)", &|s| real(s.energy.strain)),
        row("contact energy (J)", &|s| real(s.energy.contact)),
        row("external work (J)", &|s| real(s.energy.external_work)),
        row("damping (J)", &|s| real(s.energy.damping)),
        row("friction (J)", &|s| real(s.energy.friction)),
        row("plastic work (J)", &|s| real(s.energy.plastic)),
        row("remainder (J)", &|s| real(s.energy.remainder)),
        row("events", &|s| grouped(s.events.len() as u64)),
        row("warnings", &|s| grouped(s.warnings.len() as u64)),
        row("state hash", &|s| format!("{:016x}", s.state_hash)),
    ];
    let is_nothing = |cell: &String| cell == "0" || cell == "-";
    rows.retain(|(name, cells)| !name.contains("(J)") || !cells.iter().all(is_nothing));
    rows
}

/// A sentence on how far two runs are apart.
#[must_use]
pub fn verdict(first: &RunFolder, second: &RunFolder, comparison: &RunComparison) -> String {
    let all = comparison.columns.len();
    let differ = comparison.differing().count();
    let same_end = first.summary.state_hash == second.summary.state_hash;
    let end = if same_end {
        "the states at the end are the same bit by bit"
    } else {
        "the states at the end differ"
    };
    let mut text = match (comparison.times.len(), differ) {
        (0, _) => format!("{end}; the histories have no time in common"),
        (_, 0) => format!("{end}; all {all} columns of the histories are the same"),
        _ => format!("{end}; {differ} of {all} columns of the histories differ"),
    };
    if comparison.is_interpolated {
        text.push_str(", those of the second at the times of the first, linear between its rows");
    }
    text
}

/// The columns that differ, those by most first: name, largest difference, its share, its time, values at the end.
#[must_use]
pub fn differences(comparison: &RunComparison) -> Vec<[String; 6]> {
    let rows = comparison.differing().map(|column| {
        [
            column.name.clone(),
            number(column.most),
            percent(column.share),
            number(column.time),
            number(column.ends[0]),
            number(column.ends[1]),
        ]
    });
    rows.collect()
}

/// Headings of [`differences`].
pub const HEADINGS: [&str; 6] = [
    "column",
    "largest difference",
    "of the largest value",
    "at (s)",
    "first at the end",
    "second at the end",
];

/// Two runs as text.
pub struct RunPair<'a> {
    /// The two runs.
    pub runs: &'a [RunFolder],
    /// Their difference.
    pub comparison: &'a RunComparison,
}

impl fmt::Display for RunPair<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.runs else {
            return Ok(());
        };
        let run_names = names(self.runs);
        let mut table = Table::new(["run", &run_names[0], &run_names[1]]);
        for (name, cells) in ends(self.runs) {
            let mark = if cells[0] == cells[1] { "" } else { "differs" };
            table.push([name, &cells[0], &cells[1], mark]);
        }
        writeln!(f, "scene {}\n{table}", first.summary.scene)?;
        let rows = differences(self.comparison);
        if !rows.is_empty() {
            let mut table = Table::new(HEADINGS);
            for row in rows.iter().take(SHOWN) {
                table.push(row.clone());
            }
            writeln!(f, "{table}")?;
            if rows.len() > SHOWN {
                let more = rows.len() - SHOWN;
                writeln!(
                    f,
                    "  and {more} more that differ by less: proctor report has all of them\n"
                )?;
            }
        }
        for (names, run) in self.comparison.alone.iter().zip(run_names) {
            if !names.is_empty() {
                let mut text = String::new();
                for name in names {
                    write!(text, " {name}")?;
                }
                writeln!(f, "in {run} alone:{text}")?;
            }
        }
        writeln!(f, "{}", verdict(first, second, self.comparison))
    }
}
