//! Judges two records: accuracy exactly, counts nearly exactly, time by interleaved passes.
//!
//! What cannot be compared is never green: it outranks everything else in the verdict.

mod case;
pub mod counters;
pub mod equal_error;
mod machine;
pub mod noise;
pub mod time;

pub use case::{CaseVerdict, Finding};

use crate::record::{Cases, Record};

/// What decides how records are judged.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules<'a> {
    /// Leave times out: judge errors, orders and counts alone.
    pub ignore_time: bool,
    /// Measured noise by case, as `proctor noise` writes it.
    pub noise: Option<&'a Record>,
}

/// What is said of two records as a whole.
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
    /// What stands in the way of a comparison of the whole.
    pub obstacles: Vec<String>,
    /// What differs and may explain a change.
    pub notes: Vec<String>,
    /// Case by case, in the order of HEAD, then those that HEAD lacks.
    pub findings: Vec<Finding>,
}

impl Comparison {
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
    let mut notes = machine::notes(base, head);
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
    let (base, head) = (Cases::of(base), Cases::of(head));
    let mut findings: Vec<Finding> = head
        .list
        .iter()
        .map(|(key, series)| case::judge(key, series, &base, rules))
        .collect();
    for (key, _) in &base.list {
        if head.get(key).is_none() {
            findings.push(Finding::missing(key));
        }
    }
    let judged = findings.iter().filter(|finding| finding.judged()).count();
    if judged == 0 {
        obstacles.push("nothing to compare: no error, count or time is in both records".to_owned());
    }
    let hashes = findings.iter().filter_map(|finding| finding.same_bits);
    let (mut kept, mut all) = (0, 0);
    for same in hashes {
        all += 1;
        kept += usize::from(same);
    }
    if kept < all {
        notes.push(format!(
            "note: the final state differs in its bits in {} of {all} cases",
            all - kept
        ));
    }
    Comparison {
        obstacles,
        notes,
        findings,
    }
}
