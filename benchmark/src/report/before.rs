//! Base of the main job's comparison: its last record in this folder, else the record that is kept with the sources.

use super::Since;
use crate::judge::ledger::Ledger;
use crate::judge::{Rules, Verdict};
use crate::record::Record;
use crate::show::comparison;
use crate::show::paint::{Mark, Paint};
use proctor_verification::case;
use std::io::{self, Write};
use std::path::Path;

/// The short ladders as they are kept with the sources of this program.
const KEPT: &str = include_str!("../../../fixtures/expected/errors.json");
/// The ledger of accepted changes, in a checkout.
const LEDGER: &str = "fixtures/expected/accepted.csv";
/// The last record of a main job that was not interrupted.
const LAST: &str = "last.json";

/// An earlier record, and what it is.
pub struct Before {
    record: Record,
    of_this_folder: bool,
    ledger: Option<Ledger>,
}

impl Before {
    /// Keeps the record of the job before as the last one, and reads that, or else the one of the sources. A record that
    /// cannot be read, such as one of another version, is passed over.
    #[must_use]
    pub fn take(folder: &Path) -> Option<Self> {
        let (record, last) = (folder.join("record.json"), folder.join(LAST));
        if Record::read(&record).is_ok_and(|record| !record.incomplete()) {
            // Where it cannot be kept the kept one of the sources serves.
            let _ = std::fs::rename(&record, &last);
        }
        let ledger = Ledger::read(Path::new(LEDGER)).ok();
        let last = Record::read(&last).ok();
        let of_this_folder = last.is_some();
        let kept = || Record::parse(Path::new("errors.json"), KEPT.as_bytes()).ok();
        last.or_else(kept).map(|record| Self {
            record,
            of_this_folder,
            ledger,
        })
    }

    /// Judges the record of this job: errors and counts, since times were measured once. The kept record has cases alone.
    #[must_use]
    pub fn judge(&self, record: &Record) -> Since<'_> {
        let rules = Rules {
            ignore_time: true,
            ledger: self.ledger.as_ref(),
            ..Rules::default()
        };
        if self.of_this_folder {
            return Since::by(&self.record, record, &rules);
        }
        let mut cases = record.clone();
        let names: Vec<&str> = case::all().iter().map(|case| case.name()).collect();
        cases.keep_cases(&names);
        Since::by(&self.record, &cases, &rules)
    }

    /// True where it is the last record of the folder, and not the one that is kept with the sources.
    #[must_use]
    pub fn is_of_this_folder(&self) -> bool {
        self.of_this_folder
    }

    /// Writes the changes since then, in a line.
    ///
    /// # Errors
    /// If `out` cannot be written.
    pub fn tell(&self, since: &Since<'_>, paint: Paint, out: &mut dyn Write) -> io::Result<()> {
        let what = if self.of_this_folder {
            "the last run here"
        } else {
            "the kept record"
        };
        let mark = match since.comparison().verdict() {
            Verdict::Fine => Mark::Held,
            Verdict::Worse => Mark::Failed,
            Verdict::CannotCompare => Mark::Attention,
        };
        let line = comparison::verdict_line(since.comparison());
        writeln!(out, "{} since {what}: {line}", paint.symbol(mark))
    }
}
