//! The ledger of accepted changes: which number moved from where to where, and why somebody took it.
//!
//! A file of comma-separated values that grows at its end, one line per number. A change that it names is accepted; and
//! it remembers the best value that a number ever had, so that many small steps do not add up to a large one unseen.

use super::change::{Change, Direction, RecordedValue, tolerance};
use crate::record::{Meaning, renamed};
use proctor_files::output::{OutputError, atomic};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Kind of the move of a number, in the words of the ledger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ChangeKind {
    /// Better, or moved by less than is judged.
    Better,
    /// Worse, or where neither is better: somebody accepted it with its reason.
    Worse,
    /// It was not there before.
    New,
    /// It is no longer there.
    Gone,
}

/// An accepted change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Line {
    /// The kept record: `quick`, `full`, or empty for counts.
    pub ladder: String,
    /// Case, as a comparison names it.
    pub case: String,
    /// Key of the number or word.
    pub number: String,
    /// Value before, `none` where there was none.
    pub from: String,
    /// Value now, `none` where there is none.
    pub to: String,
    /// Kind of the move.
    pub what: ChangeKind,
    /// Reason for which it was accepted.
    pub reason: String,
    /// Commit of the sources that were measured, `+` where they held more than it.
    pub commit: String,
}

/// All accepted changes, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ledger {
    lines: Vec<Line>,
    /// Places of the lines of each number: a comparison looks up every number of a record.
    of_number: HashMap<String, Vec<usize>>,
}

/// Key of a number in [`Ledger::of_number`]. No name has a line break.
fn key(ladder: &str, case: &str, number: &str) -> String {
    [ladder, case, number].join("\n")
}

/// A ledger that cannot be read.
#[derive(Debug, Error)]
#[error("{}: {reason}", path.display())]
pub struct LedgerError {
    path: PathBuf,
    reason: String,
}

impl Ledger {
    /// The ledger of these lines.
    #[must_use]
    pub fn new(lines: Vec<Line>) -> Self {
        let mut ledger = Self::default();
        ledger.append(lines);
        ledger
    }

    /// Adds lines at the end.
    pub fn append(&mut self, lines: Vec<Line>) {
        for (line, place) in lines.iter().zip(self.lines.len()..) {
            let key = key(&line.ladder, &line.case, &line.number);
            self.of_number.entry(key).or_default().push(place);
        }
        self.lines.extend(lines);
    }

    /// Reads a ledger, with all names as they are today ([`renamed`]).
    ///
    /// # Errors
    /// [`LedgerError`] if there is no file, or a line is none of a ledger.
    pub fn read(path: &Path) -> Result<Self, LedgerError> {
        let fault = |error: csv::Error| LedgerError {
            path: path.to_owned(),
            reason: format!(
                "{error}; accepted: lines of ladder, case, number, from, to, what (better, worse, new, gone), reason, commit"
            ),
        };
        let mut reader = csv::Reader::from_path(path).map_err(fault)?;
        let lines: Result<Vec<Line>, _> = reader.deserialize().collect();
        let mut lines = lines.map_err(fault)?;
        if let Some(at) = lines.iter().position(|line| line.reason.trim().is_empty()) {
            return Err(LedgerError {
                path: path.to_owned(),
                reason: format!("line {}: no reason is given", at + 2),
            });
        }
        // Most names stand in many lines.
        let (mut cases, mut numbers) = (HashMap::new(), HashMap::new());
        for line in &mut lines {
            let today = cases.entry(line.case.clone());
            let today = today.or_insert_with_key(|case| renamed::name(case).into_owned());
            line.case.clone_from(today);
            let today = numbers.entry(line.number.clone());
            let today = today.or_insert_with_key(|number| renamed::key_of_row(number).into_owned());
            line.number.clone_from(today);
        }
        Ok(Self::new(lines))
    }

    /// Writes the ledger, atomically.
    ///
    /// # Errors
    /// [`OutputError`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        atomic::write(path, |file| {
            let mut table = csv::Writer::from_writer(file);
            for line in &self.lines {
                table.serialize(line)?;
            }
            if self.lines.is_empty() {
                table.write_record([
                    "ladder", "case", "number", "from", "to", "what", "reason", "commit",
                ])?;
            }
            table.flush()?;
            Ok(())
        })
    }

    /// True if `self` is `before` with lines added at its end.
    #[must_use]
    pub fn continues(&self, before: &Self) -> bool {
        self.lines.starts_with(&before.lines)
    }

    /// True if lines lead from the value in BASE to the value in HEAD.
    #[must_use]
    pub fn accepts(&self, ladder: &str, case: &str, change: &Change) -> bool {
        let target = change.head.to_string();
        let mut reached = change.base.to_string();
        let mut stepped = false;
        for line in self.of(ladder, case, &change.number) {
            if line.from == reached {
                reached.clone_from(&line.to);
                stepped = true;
            }
        }
        stepped && reached == target
    }

    /// The best value that a number ever had since somebody last took a worse one; `None` where the ledger knows nothing.
    #[must_use]
    pub fn best(&self, ladder: &str, case: &str, change: &Change) -> Option<f64> {
        let mut best: Option<f64> = None;
        for line in self.of(ladder, case, &change.number) {
            let (from, to) = (line.from.parse().ok(), line.to.parse::<f64>().ok());
            best = match (line.what, best.or(from), to) {
                (ChangeKind::Better, Some(best), Some(to))
                    if change.better.loss(best, to) > 0.0 =>
                {
                    Some(best)
                }
                (ChangeKind::Gone, _, _) => None,
                (_, best, to) => to.or(best),
            };
        }
        best
    }

    /// Best value that was ever accepted, if HEAD is worse than it by more than is judged.
    #[must_use]
    pub fn below_best(&self, ladder: &str, case: &str, change: &Change) -> Option<f64> {
        if change.meaning == Meaning::Information {
            return None;
        }
        let head = change.head.number()?;
        let best = self.best(ladder, case, change)?;
        (change.better.loss(best, head) > tolerance(change.meaning)).then_some(best)
    }

    fn of(&self, ladder: &str, case: &str, number: &str) -> impl Iterator<Item = &Line> {
        let places = self.of_number.get(&key(ladder, case, number));
        places
            .into_iter()
            .flatten()
            .map(|place| &self.lines[*place])
    }

    /// The line that accepts a change.
    #[must_use]
    pub fn line(
        &self,
        ladder: &str,
        case: &str,
        change: &Change,
        reason: &str,
        commit: &str,
    ) -> Line {
        let what = match (&change.base, &change.head) {
            (RecordedValue::Nothing, _) => ChangeKind::New,
            (_, RecordedValue::Nothing) => ChangeKind::Gone,
            _ if self.worse(ladder, case, change) => ChangeKind::Worse,
            _ => ChangeKind::Better,
        };
        Line {
            ladder: ladder.to_owned(),
            case: case.to_owned(),
            number: change.number.clone(),
            from: change.base.to_string(),
            to: change.head.to_string(),
            what,
            reason: reason.to_owned(),
            commit: commit.to_owned(),
        }
    }

    /// True if a change is for the worse, against BASE or against the best value ever accepted.
    #[must_use]
    pub fn worse(&self, ladder: &str, case: &str, change: &Change) -> bool {
        matches!(change.moved, Direction::Worse | Direction::Other)
            || self.below_best(ladder, case, change).is_some()
    }
}
