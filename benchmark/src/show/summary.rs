//! Cases that were run, one line each, and the verdict over all of them.

use super::paint::{Mark, Paint};
use super::{case as full, columns, filled, in_words, percent, seconds};
use crate::measure;
use crate::record::details::{GateDetail, gate};
use crate::record::{CaseState, Record};
use crate::suite::CaseRun;
use proctor_verification::case::{Case, Size};
use std::fmt::Write as _;
use std::io::{self, Write};
use std::time::Duration;

/// Characters of a line of a case beside the names of case and headline error.
const BESIDE: usize = 44;
/// Characters of the name of the headline error, at least and at most.
const HEADLINE: [usize; 2] = [10, 36];
/// Share of its bound up to which a gate is far from it.
const FAR: f64 = 0.8;
/// Cases that failed and are named in the verdict; all of them stand above it.
const NAMED: usize = 6;

/// Lines of cases below each other, in columns that fit their names.
pub struct Lines {
    paint: Paint,
    /// Characters of the longest name.
    name: usize,
    /// Characters of the name of the headline error.
    headline: usize,
}

impl Lines {
    /// Summary for cases of these names.
    pub fn new<'a>(paint: Paint, names: impl IntoIterator<Item = &'a str>) -> Self {
        let lengths = names.into_iter().map(|name| name.chars().count());
        let name = lengths.max().unwrap_or(0).max("case".len());
        let [least, most] = HEADLINE;
        Self {
            paint,
            name,
            headline: columns().saturating_sub(BESIDE + name).clamp(least, most),
        }
    }

    /// Heading above them.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn heading(&self, out: &mut dyn Write) -> io::Result<()> {
        let line = self.line(" ", "case", ["gates", "nearest", "error of", "", "time"]);
        writeln!(
            out,
            "nearest: share of its bound that a gate uses; error: of one finest run (-v: all)"
        )?;
        writeln!(out, "{line}")
    }

    /// The line of a case: gates that hold, the gate nearest to its bound as a share of it, the headline error and the time
    /// of all its runs by the clock. Below it all of it, where something failed.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn case(&self, ran: &CaseRun, out: &mut dyn Write) -> io::Result<()> {
        let gates: Vec<GateDetail> = ran.verdict.gates.iter().map(gate).collect();
        let held = gates.iter().filter(|gate| gate.passed).count();
        let tightest = gates.iter().map(GateDetail::used).reduce(f64::max);
        let (of, error) = headline(ran).map_or_else(Default::default, |(name, error)| {
            (in_words(name, self.headline), percent(error))
        });
        let time: f64 = ran.rungs.iter().map(|r| r.spent().wall.as_secs_f64()).sum();
        let mark = if ran.passed() {
            Mark::Held
        } else {
            Mark::Failed
        };
        let line = self.line(
            &self.paint.symbol(mark),
            ran.case.name(),
            [
                &format!("{held} of {}", gates.len()),
                &tightest.map_or_else(String::new, share),
                &of,
                &error,
                &seconds(time),
            ],
        );
        writeln!(out, "{line}")?;
        if ran.passed() {
            return Ok(());
        }
        writeln!(out)?;
        full::runs(ran, out)?;
        full::tables(ran, out)?;
        full::failed_gates(ran, out)?;
        full::faults(ran, out)
    }

    /// The cases that hold far from all of their bounds, in one paragraph: a table is for what is near a bound.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn far<'a>(
        &self,
        cases: impl Iterator<Item = &'a CaseRun>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let far: Vec<&CaseRun> = cases.filter(|ran| is_far(ran)).collect();
        if far.is_empty() {
            return Ok(());
        }
        let gates: usize = far.iter().map(|ran| ran.verdict.gates.len()).sum();
        let cases = match far.len() {
            1 => "1 more case".to_owned(),
            n => format!("{n} more cases"),
        };
        let names: Vec<&str> = far.iter().map(|ran| ran.case.name()).collect();
        let text = format!(
            "{cases}, {gates} of {gates} gates, each within {:.0} % of its bound: {}",
            100.0 * FAR,
            names.join(", ")
        );
        let symbol = self.paint.symbol(Mark::Held);
        let mut before = symbol.as_str();
        for line in filled(text.split(' '), columns() - 2) {
            writeln!(out, "{before} {line}")?;
            before = " ";
        }
        Ok(())
    }

    fn line(&self, symbol: &str, name: &str, cells: [&str; 5]) -> String {
        let [gates, tightest, of, error, time] = cells;
        let (width, headline) = (self.name, self.headline);
        format!(
            "{symbol} {name:<width$}  {gates:>8}  {tightest:>8}  {of:<headline$}  {error:>9}  {time:>7}"
        )
    }
}

/// True for a case that holds, every gate of it within three quarters of its bound.
#[must_use]
pub fn is_far(ran: &CaseRun) -> bool {
    let mut gates = ran.verdict.gates.iter().map(gate);
    ran.passed() && gates.all(|gate| gate.used() <= FAR)
}

/// A share of a bound in per cent. What holds is never told as all of it or more.
#[must_use]
pub fn share(used: f64) -> String {
    let percent = 100.0 * used;
    match percent {
        _ if percent <= 99.0 => format!("{percent:.0} %"),
        _ if percent <= 100.0 => format!("{:.1} %", (percent * 10.0).floor() / 10.0),
        _ if percent < 1000.0 => format!("{:.0} %", percent.ceil()),
        _ => "> 999 %".to_owned(),
    }
}

/// The first error of the finest run of the first problem that has one, of several as fine ones the last: what the case is
/// about.
fn headline(ran: &CaseRun) -> Option<(&'static str, f64)> {
    let error = |number: usize| {
        let solved = ran.rungs.get(number)?.solved.as_ref().ok()?;
        let found = solved.quantities.iter().find(|q| q.error.is_some())?;
        Some((found.name, found.error?))
    };
    let first = (0..ran.rungs.len()).find(|&number| error(number).is_some())?;
    let variant = ran.rungs[first].rung.variant;
    let finest = (0..ran.rungs.len())
        .rev()
        .filter(|&number| ran.rungs[number].rung.variant == variant && error(number).is_some())
        .min_by(|&a, &b| ran.rungs[a].rung.cell.total_cmp(&ran.rungs[b].rung.cell))?;
    error(finest)
}

/// Cases of an earlier record that are not run again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EarlierCases {
    /// Cases all of which holds.
    pub cases: usize,
    /// Their gates.
    pub gates: usize,
}

impl EarlierCases {
    /// Cases of a record on the ladders of that size.
    #[must_use]
    pub fn of(record: &Record, cases: &[&'static Case], size: Size) -> Self {
        let held = cases
            .iter()
            .filter(|case| record.case_state(case, size) == CaseState::Held);
        held.fold(Self::default(), |kept, case| Self {
            cases: kept.cases + 1,
            gates: kept.gates + record.gates_of(case.name()),
        })
    }
}

/// Verdict on all cases.
pub struct Verdict<'a> {
    /// Cases that were run to their end.
    pub cases: &'a [CaseRun],
    /// Cases that were not run again.
    pub kept: EarlierCases,
    /// Number of cases that were asked for, kept ones too.
    pub asked: usize,
    /// Names of other failures.
    pub also_failed: &'a [&'static str],
    /// True if something is worse than in the record that it was compared with.
    pub worse: bool,
    /// True if the user stopped it.
    pub interrupted: bool,
    /// Gates of stability that hold, and all of them, where there are any.
    pub of_stability: Option<[usize; 2]>,
    /// Time since the beginning.
    pub took: Duration,
}

impl Verdict<'_> {
    /// True if all that was run holds, and nothing is worse than before.
    #[must_use]
    pub fn held(&self) -> bool {
        self.passed() && !self.worse
    }

    fn passed(&self) -> bool {
        self.also_failed.is_empty() && self.cases.iter().all(CaseRun::passed)
    }

    /// The verdict in one line. What was interrupted never passes.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn line(&self, paint: Paint, out: &mut dyn Write) -> io::Result<()> {
        let gates = || self.cases.iter().flat_map(|ran| &ran.verdict.gates);
        let passed = self.kept.gates + gates().filter(|gate| gate.passed()).count();
        let all = self.kept.gates + gates().count();
        let (mark, word) = match (self.interrupted, self.held()) {
            (true, _) => (Mark::Attention, "INTERRUPTED"),
            (false, true) => (Mark::Held, "PASS"),
            (false, false) if self.passed() => (Mark::Failed, "WORSE"),
            (false, false) => (Mark::Failed, "FAIL"),
        };
        let mut text = format!("{passed} of {all} gates in ");
        let cases = match self.asked {
            1 => "1 case".to_owned(),
            n => format!("{n} cases"),
        };
        if self.interrupted {
            let run = self.kept.cases + self.cases.len();
            let _ = if run < self.asked {
                write!(text, "{run} of {cases}; the others were not run")
            } else {
                write!(text, "{cases}; the cases after them were not finished")
            };
        } else {
            text.push_str(&cases);
        }
        if let Some([passed, all]) = self.of_stability {
            let _ = write!(text, " and {passed} of {all} of stability");
        }
        if self.kept.cases > 0 {
            let _ = write!(text, "; {} of them held before", self.kept.cases);
        }
        let failed = self.cases.iter().filter(|ran| !ran.passed());
        let names: Vec<&str> = failed.map(|ran| ran.case.name()).collect();
        let names: Vec<&str> = names.iter().chain(self.also_failed).copied().collect();
        if !names.is_empty() {
            let shown = names[..names.len().min(NAMED)].join(", ");
            let more = match names.len() - names.len().min(NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let _ = write!(text, "; failed: {shown}{more}");
        }
        let word = format!("{} {word}", mark.symbol());
        let took = seconds(self.took.as_secs_f64());
        writeln!(out, "{}: {text}, {took}", paint.text(mark, &word))
    }

    /// Says so where the machine was busy with something else.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn busy(&self, paint: Paint, out: &mut dyn Write) -> io::Result<()> {
        let runs = self.cases.iter().flat_map(|ran| &ran.rungs);
        let Some(times) = measure::busy(runs.map(crate::suite::RanRung::spent)) else {
            return Ok(());
        };
        writeln!(
            out,
            "{} the machine was busy: runs took {times:.1} times as long by the clock as on the processors",
            paint.symbol(Mark::Attention)
        )
    }
}
