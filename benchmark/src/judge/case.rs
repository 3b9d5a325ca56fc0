//! One case, judged.

use super::counters::{self, Changed, Moved, Quantity};
use super::equal_error;
use super::time::{self, Pace, Time};
use super::{Rules, noise};
use crate::record::{CaseKey, Cases, Series};

/// What is said of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseVerdict {
    /// It cannot be compared, or not in full.
    CannotCompare,
    /// It got worse.
    Worse,
    /// It got better, and in nothing worse.
    Better,
    /// Nothing changed that is judged.
    Same,
    /// HEAD alone has it.
    New,
}

/// A case in both records.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Which case.
    pub case: CaseKey,
    /// Its errors, orders and counts.
    pub counters: Vec<Changed>,
    /// Its time, where it was judged.
    pub time: Option<Time>,
    /// Whether the final states agree bit by bit, where both are known.
    pub same_bits: Option<bool>,
    /// The verdict.
    pub verdict: CaseVerdict,
    /// Why, line by line.
    pub reasons: Vec<String>,
}

impl Finding {
    fn new(case: &CaseKey, verdict: CaseVerdict, reason: Option<String>) -> Self {
        Self {
            case: case.clone(),
            counters: vec![],
            time: None,
            same_bits: None,
            verdict,
            reasons: reason.into_iter().collect(),
        }
    }

    /// A case that HEAD lacks.
    pub(super) fn missing(case: &CaseKey) -> Self {
        let reason = "missing in HEAD".to_owned();
        Self::new(case, CaseVerdict::CannotCompare, Some(reason))
    }

    /// Whether anything of the case was compared.
    #[must_use]
    pub fn judged(&self) -> bool {
        self.time.is_some()
            || self.verdict == CaseVerdict::Worse
            || self
                .counters
                .iter()
                .any(|c| c.quantity != Quantity::Problem)
    }

    /// Largest ratio of errors, HEAD over BASE.
    #[must_use]
    pub fn error_ratio(&self) -> Option<f64> {
        self.largest(Quantity::Error)
    }

    /// Largest ratio of counts, HEAD over BASE.
    #[must_use]
    pub fn count_ratio(&self) -> Option<f64> {
        self.largest(Quantity::Count)
    }

    fn largest(&self, quantity: Quantity) -> Option<f64> {
        let of_it = self.counters.iter().filter(|c| c.quantity == quantity);
        of_it.map(Changed::ratio).reduce(f64::max)
    }
}

/// Judges a case of HEAD.
pub(super) fn judge(case: &CaseKey, head: &Series, base: &Cases, rules: &Rules<'_>) -> Finding {
    let Some(own) = base.get(case) else {
        return Finding::new(case, CaseVerdict::New, head.error.clone());
    };
    match (&own.error, &head.error) {
        (None, Some(error)) => {
            let reason = format!("fails in HEAD only: {error}");
            return Finding::new(case, CaseVerdict::Worse, Some(reason));
        }
        (Some(error), None) => {
            let reason = format!("failed in BASE only: {error}");
            return Finding::new(case, CaseVerdict::Better, Some(reason));
        }
        (Some(_), Some(error)) => {
            let reason = format!("fails in both: {error}");
            return Finding::new(case, CaseVerdict::Same, Some(reason));
        }
        (None, None) => {}
    }
    let mut marks = Marks::default();
    let mut reasons = vec![];
    let counters = counters::compare(own, head);
    for changed in &counters {
        marks.add(changed.moved);
        reasons.extend(reason(changed));
    }
    let untimed = own.wall.is_empty() && head.wall.is_empty();
    let mut time = None;
    if !rules.ignore_time && !untimed {
        let band = rules.noise.and_then(|noise| noise::band(noise, case));
        match time::compare(own, head, band) {
            Ok(found) => {
                let paid = paid(base, case, &counters);
                let (moved, reason) = judge_time(&found, &paid);
                marks.add(moved);
                reasons.extend(reason);
                time = Some(found);
            }
            Err(reason) => {
                marks.cannot = true;
                reasons.push(reason);
            }
        }
    }
    let hashes = own.state_hash.as_ref().zip(head.state_hash.as_ref());
    Finding {
        case: case.clone(),
        counters,
        time,
        same_bits: hashes.map(|(base, head)| base == head),
        verdict: marks.verdict(),
        reasons,
    }
}

/// What was found in a case so far.
#[derive(Default)]
struct Marks {
    cannot: bool,
    worse: bool,
    better: bool,
}

impl Marks {
    fn add(&mut self, moved: Moved) {
        match moved {
            Moved::Same => {}
            Moved::Better => self.better = true,
            Moved::Worse => self.worse = true,
            Moved::Missing | Moved::Other => self.cannot = true,
        }
    }

    fn verdict(&self) -> CaseVerdict {
        if self.cannot {
            CaseVerdict::CannotCompare
        } else if self.worse {
            CaseVerdict::Worse
        } else if self.better {
            CaseVerdict::Better
        } else {
            CaseVerdict::Same
        }
    }
}

/// What to say of a counter; nothing where it is the same.
fn reason(changed: &Changed) -> Option<String> {
    let Changed {
        key, base, head, ..
    } = changed;
    let number = crate::show::number;
    let values = format!("{} -> {}", number(*base), number(*head));
    match changed.moved {
        Moved::Same => None,
        Moved::Missing => Some(format!("{key} is missing in HEAD")),
        Moved::Other => Some(format!("another problem: {key} {values}")),
        Moved::Better | Moved::Worse => Some(match changed.quantity {
            Quantity::Order => format!("{key} {values} ({:+.2})", head - base),
            _ => format!("{key} {values} ({})", change(changed.ratio())),
        }),
    }
}

/// A ratio as a change in per cent, or as a factor where that reads better.
fn change(ratio: f64) -> String {
    if (0.5..2.0).contains(&ratio) {
        format!("{:+.1} %", 100.0 * (ratio - 1.0))
    } else {
        format!("x{}", crate::show::number(ratio))
    }
}

/// What a gain in time cost in accuracy.
enum Paid {
    /// Nothing: no error rose.
    Nothing,
    /// The error that cost most, and how many times longer BASE takes for its own error than for that of HEAD.
    Factor(String, f64),
    /// An error rose, and no ladder says what that is worth.
    Unknown(String),
}

fn paid(base: &Cases, case: &CaseKey, counters: &[Changed]) -> Paid {
    let mut paid = Paid::Nothing;
    let rose = |c: &&Changed| c.quantity == Quantity::Error && c.ratio() > 1.0 + 1e-9;
    for changed in counters.iter().filter(rose) {
        match equal_error::cost(base, case, &changed.key, changed.head) {
            None => return Paid::Unknown(changed.key.clone()),
            Some(factor) => match &paid {
                Paid::Factor(_, known) if *known >= factor => {}
                _ => paid = Paid::Factor(changed.key.clone(), factor),
            },
        }
    }
    paid
}

/// Which way the time went, at equal error where a gain was paid for in accuracy.
fn judge_time(time: &Time, paid: &Paid) -> (Moved, Option<String>) {
    match (time.pace, paid) {
        (Pace::Same, _) => (Moved::Same, None),
        (Pace::Slower, _) => {
            let least = time.ratios.iter().copied().fold(f64::INFINITY, f64::min);
            let text = format!(
                "slower in every pass, by {:.1} % or more (tolerance {:.1} %)",
                100.0 * (least - 1.0),
                100.0 * time.tolerance
            );
            (Moved::Worse, Some(text))
        }
        (Pace::Faster, Paid::Nothing) => {
            let most = time.ratios.iter().copied().fold(0.0, f64::max);
            let gain = 100.0 * (1.0 - most);
            let text = format!("faster in every pass, by {gain:.1} % or more");
            (Moved::Better, Some(text))
        }
        (Pace::Faster, Paid::Unknown(key)) => (
            Moved::Same,
            Some(format!(
                "faster, but {key} rose, and no ladder tells what that is worth: no gain"
            )),
        ),
        (Pace::Faster, Paid::Factor(key, factor)) => {
            let equal: Vec<f64> = time.ratios.iter().map(|ratio| ratio * factor).collect();
            let (moved, word) = match time::pace(&equal, time.tolerance) {
                Pace::Same => (Moved::Same, "no change"),
                Pace::Faster => (Moved::Better, "still faster"),
                Pace::Slower => (Moved::Worse, "slower"),
            };
            let text = format!(
                "time {} was paid for in accuracy ({key}); at equal error {}: {word}",
                change(time.median),
                change(time.median * factor)
            );
            (moved, Some(text))
        }
    }
}
