//! The differences between two rows of the same case, number by number and word by word.
//!
//! The kernel promises the same bits on every machine, so that nothing here knows of noise: two records of one program are
//! equal, and what is not equal was changed.

use crate::record::row::{GATE_BOUND, GATE_SIDE, GATE_VALUE};
use crate::record::{Meaning, Series};
use std::collections::BTreeSet;
use std::fmt;

/// Relative change that sums in another order make. What is worse by more has got worse.
pub const SUMS_IN_ANOTHER_ORDER: f64 = 1e-6;
/// Relative change of a count that is one: compilers move instructions about.
pub const COUNT_CHANGE: f64 = 0.01;

/// Name under which a case as a whole stands among its numbers.
pub const CASE: &str = "case";
/// Name under which the failures of a case stand among its numbers.
pub const FAILURE: &str = "failure";
/// Word for a case that is there.
const PRESENT: &str = "present";

/// Value in a record.
#[derive(Clone, Debug, PartialEq)]
pub enum RecordedValue {
    /// Nothing.
    Nothing,
    /// A number.
    Number(f64),
    /// A word.
    Word(String),
}

impl RecordedValue {
    /// The number, if it is one.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// The same bits, the same word, or nothing twice.
    #[must_use]
    pub fn equals(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            _ => self == other,
        }
    }
}

/// A number as the shortest text that reads as the same bits.
impl fmt::Display for RecordedValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => write!(f, "none"),
            Self::Number(value) => write!(f, "{value:?}"),
            Self::Word(word) => write!(f, "{word}"),
        }
    }
}

/// Better side of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// The smaller magnitude.
    Less,
    /// The larger value.
    More,
    /// The smaller value.
    Lower,
    /// Neither: it should stay where it is.
    Neither,
}

impl Better {
    /// Better side of numbers of a meaning; for a gate its side decides, `at most` or `at least`.
    #[must_use]
    pub fn of(meaning: Meaning, side: Option<&str>) -> Self {
        match (meaning, side) {
            (Meaning::Error | Meaning::Uncertainty | Meaning::Balance | Meaning::Count, _) => {
                Self::Less
            }
            // A tighter bound lies where better values lie.
            (Meaning::GateValue | Meaning::GateBound, Some("at most")) => Self::Lower,
            (Meaning::Order, _) | (Meaning::GateValue | Meaning::GateBound, Some("at least")) => {
                Self::More
            }
            _ => Self::Neither,
        }
    }

    /// The worst of several values; NaN where there are none.
    #[must_use]
    pub fn worst(self, values: &[f64]) -> f64 {
        let worse = |a: f64, b: f64| if self.loss(a, b) > 0.0 { b } else { a };
        values.iter().copied().reduce(worse).unwrap_or(f64::NAN)
    }

    /// Loss of `head` against `base`, over the magnitude of `base`; negative where it is better. Where neither is better, any
    /// distance is worse.
    #[must_use]
    pub fn loss(self, base: f64, head: f64) -> f64 {
        let loss = match self {
            Self::Less => head.abs() - base.abs(),
            Self::More => base - head,
            Self::Lower => head - base,
            Self::Neither => (head - base).abs(),
        };
        if loss == 0.0 { 0.0 } else { loss / base.abs() }
    }
}

/// The direction of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Not at all, bit by bit.
    Same,
    /// Not for the worse, or by so little that sums in another order (or another compiler, for counts) may have done it.
    Close,
    /// Better by more than that.
    Better,
    /// Worse by more than that, or where neither is better.
    Worse,
    /// HEAD does not have it.
    Missing,
    /// BASE did not have it.
    Appeared,
    /// It is another problem.
    Other,
    /// Accepted by a line of the ledger.
    Accepted,
}

/// Something in one or both records.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Its key: that of a counter or label, [`CASE`] or [`FAILURE`].
    pub number: String,
    /// Its meaning.
    pub meaning: Meaning,
    /// Better side of the number.
    pub better: Better,
    /// Value in BASE; of several samples the worst.
    pub base: RecordedValue,
    /// Value in HEAD; of several samples the worst.
    pub head: RecordedValue,
    /// Direction in which it moved.
    pub moved: Direction,
}

impl Change {
    /// HEAD over BASE, where both are numbers.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        let (base, head) = (self.base.number()?, self.head.number()?);
        Some(if base == head { 1.0 } else { head / base })
    }

    /// A case that only one of the records has.
    pub(super) fn of_case(in_base: bool, in_head: bool) -> Self {
        let found = |there: bool| {
            if there {
                RecordedValue::Word(PRESENT.to_owned())
            } else {
                RecordedValue::Nothing
            }
        };
        Self {
            number: CASE.to_owned(),
            meaning: Meaning::Information,
            better: Better::Neither,
            base: found(in_base),
            head: found(in_head),
            moved: match (in_base, in_head) {
                (true, false) => Direction::Missing,
                (false, true) => Direction::Appeared,
                _ => Direction::Same,
            },
        }
    }

    /// The failures of a case; `None` where there are none.
    pub(super) fn of_failures(base: Option<&Series>, head: &Series) -> Option<Self> {
        let found =
            |failure: Option<String>| failure.map_or(RecordedValue::Nothing, RecordedValue::Word);
        let (before, after) = (base.and_then(Series::failure), head.failure());
        let moved = match (&before, &after) {
            (None, None) => return None,
            (Some(_), None) => Direction::Better,
            (Some(before), Some(after)) if before == after => Direction::Same,
            _ => Direction::Worse,
        };
        Some(Self {
            number: FAILURE.to_owned(),
            meaning: Meaning::Information,
            better: Better::Neither,
            base: found(before),
            head: found(after),
            moved,
        })
    }
}

/// Compares all that is judged in a case. What a failed run did not come to give is no loss of its own.
#[must_use]
pub fn compare(base: &Series, head: &Series) -> Vec<Change> {
    let mut changes = vec![];
    let keys: BTreeSet<&String> = base.counters.keys().chain(head.counters.keys()).collect();
    for key in keys {
        let meaning = Meaning::of(key);
        if meaning == Meaning::Information {
            continue;
        }
        let better = better(meaning, base, head);
        let of = |series: &Series| {
            let values = series.counters.get(key);
            values.map_or(RecordedValue::Nothing, |values| {
                RecordedValue::Number(better.worst(values))
            })
        };
        let (before, after) = (of(base), of(head));
        // A value whose error is there too is judged by that, and listed.
        let told = tells_error(key, base) && tells_error(key, head);
        let moved = if repeats(meaning, head.counters.get(key)) {
            moved(meaning, better, told, &before, &after)
        } else {
            Direction::Worse
        };
        let meaning = if told { Meaning::Information } else { meaning };
        changes.push(Change {
            number: key.clone(),
            meaning,
            better,
            base: before,
            head: after,
            moved,
        });
    }
    let keys: BTreeSet<&String> = base.labels.keys().chain(head.labels.keys()).collect();
    for key in keys {
        let of = |series: &Series| {
            let words = series.labels.get(key);
            words.map_or(RecordedValue::Nothing, |words| {
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                RecordedValue::Word(words.join("; "))
            })
        };
        let (before, after) = (of(base), of(head));
        let one = head.labels.get(key).is_none_or(|words| words.len() == 1);
        changes.push(Change {
            number: key.clone(),
            meaning: Meaning::of_label(key),
            better: Better::Neither,
            moved: match (&before, &after) {
                (_, RecordedValue::Nothing) => Direction::Missing,
                (RecordedValue::Nothing, _) => Direction::Appeared,
                _ if one && before.equals(&after) => Direction::Same,
                (RecordedValue::Word(before), RecordedValue::Word(after))
                    if one && Meaning::of_label(key) == Meaning::Settling =>
                {
                    settled(before, after)
                }
                _ => Direction::Worse,
            },
            base: before,
            head: after,
        });
    }
    changes
}

/// Change of the verdict of a bar: to `asymptotic` is better, from it worse, all else neither.
fn settled(before: &str, after: &str) -> Direction {
    let asymptotic = proctor_verification::refine::Verdict::Asymptotic.word();
    match (before == asymptotic, after == asymptotic) {
        (true, false) => Direction::Worse,
        (false, true) => Direction::Better,
        _ => Direction::Close,
    }
}

/// Number of half-widths of its bar in BASE by which a value moved; `None` for what has no bar.
#[must_use]
pub fn in_bars(change: &Change, base: &Series) -> Option<f64> {
    let name = change.number.strip_prefix("value_")?;
    let bars = base.counters.get(&format!("uncertainty_{name}"))?;
    let bar = Better::Less.worst(bars);
    let (from, to) = (change.base.number()?, change.head.number()?);
    (bar > 0.0 && from != to).then(|| (to - from).abs() / bar)
}

/// True if a gate lies on the right side of its bound; `None` for a row that is no gate. A gate without a value does not.
#[must_use]
pub fn gate_holds(series: &Series) -> Option<bool> {
    let bound = Better::Neither.worst(series.counters.get(GATE_BOUND)?);
    let Some(values) = series.counters.get(GATE_VALUE) else {
        return Some(false);
    };
    Some(match Better::of(Meaning::GateValue, side(series)) {
        Better::Lower => values.iter().all(|value| *value <= bound),
        Better::More => values.iter().all(|value| *value >= bound),
        _ => false,
    })
}

/// The word for the side of a gate that is right.
fn side(series: &Series) -> Option<&str> {
    let words = series.labels.get(GATE_SIDE)?;
    words.first().map(String::as_str)
}

fn better(meaning: Meaning, base: &Series, head: &Series) -> Better {
    let side = side(base).filter(|word| side(head) == Some(*word));
    Better::of(meaning, side)
}

/// True if the error of a value is there too, and judges it.
fn tells_error(key: &str, series: &Series) -> bool {
    let name = key.strip_prefix("value_");
    name.is_some_and(|name| series.counters.contains_key(&format!("error_{name}")))
}

/// True if all samples agree. Counts of instructions may differ a little.
fn repeats(meaning: Meaning, values: Option<&Vec<f64>>) -> bool {
    let Some((first, others)) = values.and_then(|values| values.split_first()) else {
        return true;
    };
    meaning == Meaning::Count || others.iter().all(|v| v.to_bits() == first.to_bits())
}

fn moved(
    meaning: Meaning,
    better: Better,
    told_by_error: bool,
    base: &RecordedValue,
    head: &RecordedValue,
) -> Direction {
    let (base, head) = match (base, head) {
        (_, RecordedValue::Nothing) => return Direction::Missing,
        (RecordedValue::Nothing, _) => return Direction::Appeared,
        _ if base.equals(head) => return Direction::Same,
        (RecordedValue::Number(base), RecordedValue::Number(head)) => (*base, *head),
        _ => return Direction::Other,
    };
    if meaning == Meaning::Setting {
        return Direction::Other;
    }
    let tolerance = tolerance(meaning);
    let loss = better.loss(base, head);
    if told_by_error || loss.abs() <= tolerance {
        Direction::Close
    } else if loss < 0.0 {
        Direction::Better
    } else {
        Direction::Worse
    }
}

/// Relative change that is none yet.
#[must_use]
pub fn tolerance(meaning: Meaning) -> f64 {
    match meaning {
        Meaning::Count => COUNT_CHANGE,
        // Nobody sums up a bound.
        Meaning::GateBound => 0.0,
        _ => SUMS_IN_ANOTHER_ORDER,
    }
}
