//! Time, by interleaved passes.

use crate::record::Series;
use crate::statistics::{mann_whitney, median, ratio_interval};

/// Passes without which time is not judged.
pub const PASSES: usize = 3;
/// Smallest relative change of time that is one.
pub const TOLERANCE: f64 = 0.03;
/// Tolerance above which a time is not judged: to find nothing among such noise is no finding.
const USELESS: f64 = 0.5;
/// Seed of the bootstrap.
const SEED: u64 = 1;

/// What became of a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// No change that every pass shows.
    Same,
    /// Faster in every pass by more than the tolerance.
    Faster,
    /// Slower in every pass by more than the tolerance.
    Slower,
}

/// The times of a case in both records.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// HEAD over BASE, pass by pass.
    pub ratios: Vec<f64>,
    /// Ratio of the medians of all samples.
    pub median: f64,
    /// The same for CPU time.
    pub cpu: Option<f64>,
    /// 95 % interval of that ratio.
    pub interval: (f64, f64),
    /// Probability of such an order of the samples by chance (Mann-Whitney).
    pub chance: f64,
    /// Relative change below which nothing is said.
    pub tolerance: f64,
    /// What the passes say.
    pub pace: Pace,
}

/// Compares the times of a case.
///
/// `band` is the measured noise of the case, as a relative change.
///
/// # Errors
/// Says why there is no answer, such as fewer than three passes in common, or noise that would hide anything.
pub fn compare(base: &Series, head: &Series, band: Option<f64>) -> Result<Time, String> {
    let ratios = ratios(base, head);
    if !base.wall.is_empty() && !head.wall.is_empty() && base.threads != head.threads {
        let said = |series: &Series| {
            let numbers: Vec<String> = series.threads.iter().map(u64::to_string).collect();
            numbers.join(", ")
        };
        return Err(format!(
            "time: another number of threads, {} in BASE, {} in HEAD",
            said(base),
            said(head)
        ));
    }
    if ratios.len() < PASSES {
        return Err(match (base.wall.is_empty(), head.wall.is_empty()) {
            (true, _) => "BASE has no time".to_owned(),
            (_, true) => "HEAD has no time".to_owned(),
            _ => format!(
                "time: {} in common, at least {PASSES} are needed",
                match ratios.len() {
                    1 => "1 pass".to_owned(),
                    n => format!("{n} passes"),
                }
            ),
        });
    }
    let (base_all, head_all) = (base.all_wall(), head.all_wall());
    let none = || "a time of zero".to_owned();
    let ratio = |head: &[f64], base: &[f64]| Some(median(head)? / median(base)?);
    let tolerance = TOLERANCE.max(2.0 * band.unwrap_or(0.0));
    if tolerance > USELESS {
        return Err(format!(
            "time: the noise hides every change below {:.0} %; measure on a quiet machine, or leave times out",
            100.0 * tolerance
        ));
    }
    let pace = pace(&ratios, tolerance);
    Ok(Time {
        median: ratio(&head_all, &base_all)
            .filter(|r| r.is_finite())
            .ok_or_else(none)?,
        cpu: ratio(&head.cpu, &base.cpu).filter(|r| r.is_finite()),
        interval: ratio_interval(&base_all, &head_all, SEED).ok_or_else(none)?,
        chance: mann_whitney(&base_all, &head_all).ok_or_else(none)?,
        ratios,
        tolerance,
        pace,
    })
}

/// HEAD over BASE, pass by pass, of the fastest run of each: whatever else goes on in a machine only adds time.
#[must_use]
pub fn ratios(base: &Series, head: &Series) -> Vec<f64> {
    let fastest = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    base.wall
        .iter()
        .filter_map(|(pass, times)| Some(fastest(head.wall.get(pass)?) / fastest(times)))
        .filter(|ratio| ratio.is_finite() && *ratio > 0.0)
        .collect()
}

/// What the passes agree on.
#[must_use]
pub fn pace(ratios: &[f64], tolerance: f64) -> Pace {
    let limit = 1.0 + tolerance;
    if ratios.iter().all(|ratio| *ratio > limit) {
        Pace::Slower
    } else if ratios.iter().all(|ratio| *ratio < 1.0 / limit) {
        Pace::Faster
    } else {
        Pace::Same
    }
}
