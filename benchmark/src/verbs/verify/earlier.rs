//! The cases that are run again: those that an earlier record lacks, or that failed in it.

use crate::exit::Failure;
use crate::record::{CaseState, Record};
use proctor_verification::case::{self, Case, Size};
use std::path::Path;

/// A record of an earlier `proctor verify`, or of the main job.
pub struct Earlier {
    record: Record,
    size: Size,
}

/// Names of all cases, in their order.
pub fn names() -> Vec<&'static str> {
    case::all().iter().map(|case| case.name()).collect()
}

impl Earlier {
    /// Reads it.
    ///
    /// # Errors
    /// [`Failure::BadInput`] if it is no record, or does not say which ladders were run.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let record = Record::read_any(path).map_err(Failure::bad_input)?;
        let size = match record.ladder() {
            Some("quick") => Size::Quick,
            Some("full") => Size::Full,
            found => {
                return Err(Failure::BadInput(format!(
                    "{}: context.ladders: found {}; accepted: \"quick\" or \"full\", as `proctor verify` and the main job \
                     write it",
                    path.display(),
                    found.map_or_else(|| "nothing".to_owned(), |word| format!("{word:?}"))
                )));
            }
        };
        Ok(Self { record, size })
    }

    /// Size of the ladders that were run.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Checks that it holds any case: of one that holds none nobody may conclude that nothing failed.
    ///
    /// # Errors
    /// [`Failure::BadInput`] if it holds none.
    pub fn holds_cases(&self, path: &Path) -> Result<(), Failure> {
        let done = [CaseState::Held, CaseState::Failed];
        if self.those(case::all(), &done).is_empty() {
            return Err(Failure::BadInput(format!(
                "{}: found no case that was run to its end; accepted: a record of `proctor verify` or the main job",
                path.display()
            )));
        }
        Ok(())
    }

    /// Some cases that were asked for then, as far as the record knows, and ended in one of these ways.
    pub fn those(&self, cases: &[&'static Case], states: &[CaseState]) -> Vec<&'static Case> {
        let asked = self.record.cases_asked();
        let cases = cases.iter().copied();
        cases
            .filter(|case| {
                asked
                    .as_ref()
                    .is_none_or(|names| names.contains(&case.name()))
            })
            .filter(|case| states.contains(&self.record.case_state(case, self.size)))
            .collect()
    }

    /// The record without the cases that are run again, to go on with: of this program, on this machine, with cases alone.
    ///
    /// # Errors
    /// [`Failure::BadInput`] if it is of another program or machine, or holds more than cases and `in_place` says that it
    /// would be written over.
    pub fn without(
        &self,
        again: &[&'static Case],
        now: &Record,
        path: &Path,
        in_place: bool,
    ) -> Result<Record, Failure> {
        let path = path.display();
        if let Some([key, then, now]) = self.record.differs_from(now) {
            return Err(Failure::BadInput(format!(
                "{path}: `{key}` is {then}, but {now} here, and one record is of one program on one machine; \
                 `--failed {path}` runs what failed in it as a record of its own"
            )));
        }
        let names = names();
        if in_place && self.record.holds_more_than(&names) {
            return Err(Failure::BadInput(format!(
                "{path}: holds more than cases, which would be lost; --json FILE says where the record of the cases goes"
            )));
        }
        let mut kept = self.record.clone();
        let again: Vec<&str> = again.iter().map(|case| case.name()).collect();
        let others: Vec<&str> = names
            .into_iter()
            .filter(|name| !again.contains(name))
            .collect();
        kept.keep_cases(&others);
        Ok(kept)
    }
}
