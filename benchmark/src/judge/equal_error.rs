//! The cost of an accuracy, from the ladder of a record: time against error, both by their logarithms.

use crate::record::{CaseKey, Cases};
use crate::statistics::median;

/// Ratio of BASE's time for the error it has in this case to its time for an error of `error`, by the ladder of the case:
/// log-linear between its points, and by the outer two beyond them.
///
/// `None` where there is no ladder: fewer than two points, or more time does not buy less error.
#[must_use]
pub fn cost(base: &Cases, case: &CaseKey, key: &str, error: f64) -> Option<f64> {
    let own = base.get(case)?;
    let ladder = own.ladder.as_ref()?;
    let mut points: Vec<(f64, f64)> = base
        .list
        .iter()
        .filter(|(other, series)| {
            let kind = other.aggregate.is_none() && series.threads == own.threads;
            kind && series.ladder.as_ref() == Some(ladder) && series.errors.is_empty()
        })
        .filter_map(|(_, series)| {
            let error = series.counters.get(key)?.first()?;
            Some((error.ln(), median(&series.all_wall())?.ln()))
        })
        .filter(|(error, time)| error.is_finite() && time.is_finite())
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let from = own.counters.get(key)?.first()?.ln();
    let cost = time_at(&points, from)? - time_at(&points, error.ln())?;
    (cost.is_finite()).then(|| cost.exp())
}

/// Logarithm of the time at a logarithm of the error; points in order of their error.
fn time_at(points: &[(f64, f64)], error: f64) -> Option<f64> {
    let last = points.len().checked_sub(2)?;
    let above = points.partition_point(|point| point.0 < error);
    let at = above.saturating_sub(1).min(last);
    let ((e0, t0), (e1, t1)) = (points[at], points[at + 1]);
    let slope = (t1 - t0) / (e1 - e0);
    (slope < 0.0).then_some(t0 + slope * (error - e0))
}
