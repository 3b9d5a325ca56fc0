//! Judges two records: results bit by bit, counts nearly exactly, time by pairs of runs.
//!
//! A pair that cannot be compared is never green: it outranks everything else in the verdict.

mod case;
pub mod change;
pub mod equal_error;
pub mod ledger;
mod machine;
pub mod noise;
pub mod time;

pub use case::{CaseVerdict, Finding};

use crate::record::{Cases, Meaning, Record, Row};
use change::Direction;
use ledger::Ledger;

/// Options of the judge.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules<'a> {
    /// Leave times out: judge errors, orders and counts alone.
    pub ignore_time: bool,
    /// Measured noise by case, as `proctor noise` writes it.
    pub noise: Option<&'a Record>,
    /// Changes that were accepted, each with a reason.
    pub ledger: Option<&'a Ledger>,
    /// True if the ledger must name every difference, those for the better too.
    pub strict: bool,
}

/// Verdict on two records as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything could be compared and nothing got worse.
    Fine,
    /// Something got worse.
    Worse,
    /// Something could not be compared.
    CannotCompare,
}

/// Two records, compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Obstacles to a comparison of the whole.
    pub obstacles: Vec<String>,
    /// Differences that may explain a change.
    pub notes: Vec<String>,
    /// Case by case, in the order of HEAD, then those that HEAD lacks.
    pub findings: Vec<Finding>,
    /// Ladder that was run, `quick` or `full`; empty for records of something else.
    pub ladder: String,
    /// True if times were there and left out.
    pub times_left_out: bool,
}

/// Number of compared numbers and words of one meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally {
    /// Meaning of the numbers.
    pub meaning: Meaning,
    /// Number of those that both records have.
    pub compared: usize,
    /// Number of these that are equal bit by bit.
    pub equal: usize,
    /// Number of those that only one of them has.
    pub alone: usize,
}

impl Comparison {
    /// Compared numbers, meaning by meaning; those that neither record has are left out.
    #[must_use]
    pub fn tallies(&self) -> Vec<Tally> {
        let changes = || self.findings.iter().flat_map(|finding| &finding.changes);
        let tallies = Meaning::JUDGED.into_iter().map(|meaning| {
            let of_it = || changes().filter(move |change| change.meaning == meaning);
            let alone = |change: &&change::Change| {
                let (base, head) = (&change.base, &change.head);
                matches!(base, change::RecordedValue::Nothing)
                    || matches!(head, change::RecordedValue::Nothing)
            };
            let alone = of_it().filter(alone).count();
            Tally {
                meaning,
                compared: of_it().count() - alone,
                equal: of_it().filter(|c| c.moved == Direction::Same).count(),
                alone,
            }
        });
        tallies.filter(|t| t.compared + t.alone > 0).collect()
    }

    /// The verdict over all cases.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let any = |verdict| self.findings.iter().any(|f| f.verdict == verdict);
        if !self.obstacles.is_empty() || any(CaseVerdict::CannotCompare) {
            Verdict::CannotCompare
        } else if any(CaseVerdict::Worse) {
            Verdict::Worse
        } else {
            Verdict::Fine
        }
    }
}

/// Compares HEAD with BASE.
#[must_use]
pub fn compare(base: &Record, head: &Record, rules: &Rules<'_>) -> Comparison {
    let mut obstacles = machine::obstacles(base, head, !rules.ignore_time);
    let notes = machine::notes(base, head);
    if let Some(noise) = rules.noise {
        if !noise::holds_bands(noise) {
            obstacles
                .push("the noise record holds no bands; `proctor noise` writes them".to_owned());
        }
        let foreign = machine::obstacles(noise, head, true);
        obstacles.extend(
            foreign
                .into_iter()
                .map(|what| format!("noise record: {}", what.replace(" in BASE", " there"))),
        );
    }
    let ladder = head.ladder().unwrap_or_default().to_owned();
    if let (Some(before), Some(after)) = (base.ladder(), head.ladder())
        && before != after
    {
        obstacles.push(format!("another ladder: {before} in BASE, {after} in HEAD"));
    }
    let (before, after) = (base, head);
    let (base, head) = (Cases::of(base), Cases::of(head));
    let mut findings: Vec<Finding> = head
        .list
        .iter()
        .map(|(key, series)| case::judge(key, series, &base, rules, &ladder))
        .collect();
    for (key, _) in &base.list {
        if head.get(key).is_none() {
            findings.push(case::missing(key, rules, &ladder));
        }
    }
    let judged = findings.iter().filter(|finding| finding.judged()).count();
    if judged == 0 {
        obstacles.push("nothing to compare: no error, count or time is in both records".to_owned());
    }
    Comparison {
        obstacles,
        notes,
        findings,
        ladder,
        times_left_out: rules.ignore_time && (timed(before) || timed(after)),
    }
}

/// Note where there are no pairs of runs.
const ONCE: &str = "note: times were measured once and are not judged; scripts/compare-commits BASE measures two commits in \
                    pairs, and a folder with one record per pass is such a measurement, too";

/// Compares HEAD with BASE as they were measured: times of a single pass are left out, which a note says.
#[must_use]
pub fn compare_as_measured(base: &Record, head: &Record, rules: &Rules<'_>) -> Comparison {
    let once = !rules.ignore_time && measured_once(base, head);
    let rules = Rules {
        ignore_time: rules.ignore_time || once,
        ..*rules
    };
    let mut comparison = compare(base, head, &rules);
    if once {
        comparison.notes.push(ONCE.to_owned());
    }
    comparison
}

/// True if all times of both records come from a single pass, so that there are no pairs to judge them by. Asked of records
/// that somebody made without a thought of times, such as those of the main job; where one of them has passes, times are meant
/// to be judged.
#[must_use]
pub fn measured_once(base: &Record, head: &Record) -> bool {
    let once = |record: &Record| {
        let passes = record.rows.iter().filter(|row| row.wall().is_some());
        let mut passes: Vec<u64> = passes.map(Row::pass).collect();
        passes.dedup();
        passes.len() == 1
    };
    once(base) && once(head)
}

fn timed(record: &Record) -> bool {
    record.rows.iter().any(|row| row.wall().is_some())
}
