//! The noise of each case: how far two measurements of the same program lie apart.

use super::machine;
use super::time::{Clock, PASSES, ratios, seen_by};
use crate::record::{BY_SCENE, CaseKey, Cases, Kind, Record, Row};
use crate::statistics::Summary;

/// Name of the aggregate that holds a band.
const AGGREGATE: &str = "noise";
/// Counter of the band.
const BAND: &str = "noise_band";
/// Counter of the change that a comparison sees.
pub const SEES: &str = "noise_sees";

/// Bands of all timed cases of two or more records of the same program, as rows of a record.
///
/// The band of a case is the largest relative change of time, pass by pass, between any two of the records: of the time
/// that decides, on the processors for one thread and by the clock for more. Beside it stands the least change that
/// `pairs` pairs would show in nine of ten comparisons, where there is one; it comes from resamples of these passes.
///
/// # Errors
/// Says why there is no band: too few records or passes, other programs, other machines.
pub fn bands(records: &[Record], pairs: usize) -> Result<Vec<Row>, String> {
    let (Some(first), true) = (records.first(), records.len() >= 2) else {
        return Err("found one record; accepted: two or more of the same program".to_owned());
    };
    for other in &records[1..] {
        if let Some(obstacle) = machine::obstacles(first, other, true).first() {
            return Err(obstacle.clone());
        }
        for key in ["commit", "dirty"] {
            if first.context[key] != other.context[key] {
                return Err(format!(
                    "the records are of different programs: {key} {} and {}",
                    first.context[key], other.context[key]
                ));
            }
        }
    }
    let cases: Vec<Cases> = records.iter().map(Cases::of).collect();
    let mut rows = vec![];
    for (key, series) in &cases[0].list {
        if key.aggregate.is_some() || series.wall.is_empty() {
            continue;
        }
        let mut clock = Clock::Wall;
        let mut all = vec![];
        for (index, first) in cases.iter().enumerate() {
            for second in &cases[index + 1..] {
                if let (Some(first), Some(second)) = (first.get(key), second.get(key)) {
                    let (of, found) = ratios(first, second);
                    clock = of;
                    all.extend(found);
                }
            }
        }
        let changes = all.iter().map(|ratio| ratio.ln().abs().exp_m1());
        let changes: Vec<f64> = changes.collect();
        if changes.len() < PASSES {
            return Err(format!(
                "{key}: {} pairs of passes; at least {PASSES} are needed",
                changes.len()
            ));
        }
        let mut row = Row::aggregate(key.name.clone(), AGGREGATE, BY_SCENE);
        if let Some(summary) = Summary::of(&changes) {
            row.count(BAND, summary.maximum);
            row.count("noise_median", summary.median);
            row.count("noise_pairs", summary.count as f64);
            if let Some(change) = seen_by(pairs, clock, &all) {
                row.count(SEES, change);
            }
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Err("the records hold no times".to_owned());
    }
    Ok(rows)
}

/// The band of a case in a record of bands.
#[must_use]
pub fn band(noise: &Record, case: &CaseKey) -> Option<f64> {
    let row = noise.rows.iter().find(|row| {
        let is_band = matches!(&row.kind, Kind::Aggregate { name } if name == AGGREGATE);
        is_band && row.name == case.name
    })?;
    row.counters.get(BAND).copied()
}

/// True if a record holds bands at all.
#[must_use]
pub fn holds_bands(noise: &Record) -> bool {
    noise.rows.iter().any(|row| row.counters.contains_key(BAND))
}
