//! Base of the main job's comparison: its last record in this folder, else the record that is kept with the sources.

use crate::exit::Failure;
use crate::judge::ledger::Ledger;
use crate::judge::{Rules, Verdict};
use crate::record::Record;
use crate::report::Since;
use crate::show::comparison;
use crate::show::paint::{Mark, Paint};
use proctor_verification::case;
use std::io::Write;
use std::path::Path;

/// The short ladders as they are kept with the sources of this program.
const KEPT: &str = include_str!("../../../../fixtures/expected/errors.json");
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

    /// Changes since, in a line.
    pub fn tell(
        &self,
        since: &Since<'_>,
        paint: Paint,
        out: &mut dyn Write,
    ) -> Result<(), Failure> {
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
        Ok(writeln!(
            out,
            "{} since {what}: {line}",
            paint.symbol(mark)
        )?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::change::Direction;

    fn kept() -> Record {
        Record::parse(Path::new("kept"), KEPT.as_bytes()).expect("the kept record")
    }

    #[test]
    fn the_first_run_is_compared_with_the_kept_record_and_the_next_with_the_last() {
        let folder = tempfile::TempDir::new().expect("a folder");
        let before = Before::take(folder.path()).expect("the kept record");
        assert!(!before.of_this_folder);
        let since = before.judge(&kept());
        assert_eq!(since.comparison().verdict(), Verdict::Fine);
        let mut told = vec![];
        before.tell(&since, Paint::NONE, &mut told).expect("told");
        let told = String::from_utf8(told).expect("text");
        assert!(told.contains("since the kept record: FINE: "), "{told}");
        // A number that is half as large again in the next run.
        kept()
            .write(&folder.path().join("record.json"))
            .expect("written");
        let before = Before::take(folder.path()).expect("the last record");
        assert!(before.of_this_folder && folder.path().join(LAST).exists());
        assert!(!folder.path().join("record.json").exists());
        let mut worse = kept();
        let row = worse
            .rows
            .iter_mut()
            .find(|row| row.counters.contains_key("error_l2_u"));
        let error = row
            .and_then(|row| row.counters.get_mut("error_l2_u"))
            .expect("an error");
        *error *= 1.5;
        let since = before.judge(&worse);
        assert_eq!(since.comparison().verdict(), Verdict::Worse);
        let changes = since
            .comparison()
            .findings
            .iter()
            .flat_map(|finding| &finding.changes);
        assert_eq!(
            changes
                .filter(|change| change.moved == Direction::Worse)
                .count(),
            1
        );
    }

    #[test]
    fn an_interrupted_record_is_not_kept() {
        let folder = tempfile::TempDir::new().expect("a folder");
        let mut record = kept();
        record.set_incomplete(true);
        record
            .write(&folder.path().join("record.json"))
            .expect("written");
        let before = Before::take(folder.path()).expect("the kept record");
        assert!(!before.of_this_folder && !folder.path().join(LAST).exists());
    }
}
