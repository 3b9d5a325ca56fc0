//! A number that a row reports beside its reference. It is no error: no comparison of records calls it worse.

use super::Row;
use proctor_verification::guest::ReadValue;

/// Labels of such a row: the name of the number, and the source of its reference.
const REPORTED: &str = "reported";
const SOURCE: &str = "reference_source";

impl Row {
    /// Adds a number that is reported, by the word of its measure.
    pub fn report(&mut self, word: &str, reported: &ReadValue) {
        self.label(REPORTED, reported.name.clone());
        self.label(SOURCE, reported.source.clone());
        self.count(format!("value_{word}"), reported.value);
        self.count(format!("exact_{word}"), reported.reference);
    }

    /// The number that it reports, if it does.
    #[must_use]
    pub fn reported(&self) -> Option<ReadValue> {
        let count = |of: &str| {
            let mut counters = self.counters.iter();
            counters.find_map(|(key, value)| key.starts_with(of).then_some(*value))
        };
        Some(ReadValue {
            name: self.labels.get(REPORTED)?.clone(),
            value: count("value_")?,
            reference: count("exact_")?,
            source: self.labels.get(SOURCE).cloned().unwrap_or_default(),
        })
    }
}
