//! Recorded run times of the ladders of the cases, for the first estimate of progress.

use proctor_verification::case::Size;

const SHORT: &str = include_str!("../../../fixtures/expected/short-ladders.csv");
const FULL: &str = include_str!("../../../fixtures/expected/full-ladders.csv");

/// Time of a case that was never kept \[s\].
pub const UNKNOWN: f64 = 2.0;
/// Least time of any \[s\].
const LEAST: f64 = 0.05;

/// CPU time of the ladder of a case \[s\], on the machine on which it was kept.
#[must_use]
pub fn seconds(case: &str, size: Size) -> f64 {
    let table = match size {
        Size::Quick => SHORT,
        Size::Full => FULL,
    };
    let found = table.lines().find_map(|line| {
        let (name, seconds) = line.split_once(',')?;
        (name == case).then(|| seconds.trim().parse::<f64>().ok())?
    });
    found.unwrap_or(UNKNOWN).max(LEAST)
}
