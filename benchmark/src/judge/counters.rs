//! Errors, observed orders and counts: they do not depend on the machine's mood, and are judged without tolerance for it.

use crate::record::Series;

/// Ratio of errors above which accuracy is lost. Results are the same bit by bit for every number of threads and lanes,
/// so that only a change of the method, or of the order of sums, moves an error at all.
const ERROR_RATIO: f64 = 1.01;
/// Loss of observed order that fails.
const ORDER_LOST: f64 = 0.1;
/// Relative change of a count that is one.
const COUNT_CHANGE: f64 = 0.01;
/// Errors below it are round-off, which no ratio can be taken of.
const ROUND_OFF: f64 = 1e-12;

/// What a counter stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Relative error (`error_...`): less is better.
    Error,
    /// Observed order of convergence (`observed_order...`): more is better.
    Order,
    /// Count of work or bytes (`instructions...`, `steps`, `bytes_per_...`): less is better.
    Count,
    /// What is solved (`particles`, `cell_size`): neither is better, and another value is another case.
    Problem,
}

impl Quantity {
    /// What a key stands for; `None` for keys that are not judged, such as rates, which are times once more.
    #[must_use]
    pub fn of(key: &str) -> Option<Self> {
        match key {
            _ if key.starts_with("error_") => Some(Self::Error),
            _ if key.starts_with("observed_order") => Some(Self::Order),
            "steps" => Some(Self::Count),
            _ if key.starts_with("instructions") || key.starts_with("bytes_per_") => {
                Some(Self::Count)
            }
            "particles" | "cell_size" => Some(Self::Problem),
            _ => None,
        }
    }
}

/// How a counter moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    /// Less than what is judged.
    Same,
    /// For the better.
    Better,
    /// For the worse.
    Worse,
    /// HEAD does not have it.
    Missing,
    /// It is another problem.
    Other,
}

/// A counter in both records.
#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    /// Its key.
    pub key: String,
    /// What it stands for.
    pub quantity: Quantity,
    /// In BASE; the worst of its samples.
    pub base: f64,
    /// In HEAD; the worst of its samples. NaN where it is missing.
    pub head: f64,
    /// Which way it went.
    pub moved: Moved,
}

impl Changed {
    /// HEAD over BASE; 1 where both are round-off.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        if self.base == self.head || self.base.abs().max(self.head.abs()) <= ROUND_OFF {
            1.0
        } else {
            self.head / self.base
        }
    }
}

/// Compares all counters of a case that are judged and that BASE has.
#[must_use]
pub fn compare(base: &Series, head: &Series) -> Vec<Changed> {
    let judged = base
        .counters
        .iter()
        .filter_map(|(key, values)| Some((key, values, Quantity::of(key)?)));
    judged
        .map(|(key, values, quantity)| {
            let base = worst(quantity, values);
            let head = head.counters.get(key).map(|values| worst(quantity, values));
            Changed {
                key: key.clone(),
                quantity,
                base,
                head: head.unwrap_or(f64::NAN),
                moved: head.map_or(Moved::Missing, |head| moved(quantity, base, head)),
            }
        })
        .collect()
}

/// The worst of the samples of one record.
fn worst(quantity: Quantity, values: &[f64]) -> f64 {
    let order = quantity == Quantity::Order;
    let worst = if order { f64::min } else { f64::max };
    values.iter().copied().reduce(worst).unwrap_or(f64::NAN)
}

fn moved(quantity: Quantity, base: f64, head: f64) -> Moved {
    let by = |worse: bool, better: bool| match (worse, better) {
        (true, _) => Moved::Worse,
        (_, true) => Moved::Better,
        _ => Moved::Same,
    };
    match quantity {
        Quantity::Error => by(
            head > ROUND_OFF && head > base * ERROR_RATIO,
            base > ROUND_OFF && base > head * ERROR_RATIO,
        ),
        Quantity::Order => by(base - head >= ORDER_LOST, head - base >= ORDER_LOST),
        Quantity::Count => by(
            head > base * (1.0 + COUNT_CHANGE),
            head < base * (1.0 - COUNT_CHANGE),
        ),
        Quantity::Problem if (head - base).abs() > COUNT_CHANGE * base.abs() => Moved::Other,
        Quantity::Problem => Moved::Same,
    }
}
