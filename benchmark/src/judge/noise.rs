//! The noise of each case: how far two measurements of the same program lie apart.

use super::machine;
use super::time::{PASSES, ratios};
use crate::record::{BY_SCENE, CaseKey, Cases, Kind, Record, Row};
use crate::statistics::Summary;

/// Name of the aggregate that holds a band.
const AGGREGATE: &str = "noise";
/// Counter of the band.
const BAND: &str = "noise_band";

/// Bands of all timed cases of two or more records of the same program, as rows of a record.
///
/// The band of a case is the largest relative change of time, pass by pass, between any two of the records. By its
/// double, which `compare` judges by, on a machine whose runs scatter by 4 % and are disturbed once in ten, about 3 cases
/// in 4000 without a change are called slower if three pairs of passes were measured, and none if nine were; by 3 % alone
/// it would be 65 (simulated, 400 000 cases).
///
/// # Errors
/// Says why there is no band: too few records or passes, other programs, other machines.
pub fn bands(records: &[Record]) -> Result<Vec<Row>, String> {
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
        let mut changes = vec![];
        for (index, first) in cases.iter().enumerate() {
            for second in &cases[index + 1..] {
                if let (Some(first), Some(second)) = (first.get(key), second.get(key)) {
                    let ratios = ratios(first, second);
                    changes.extend(ratios.iter().map(|ratio| ratio.ln().abs().exp_m1()));
                }
            }
        }
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

/// Whether a record holds bands at all.
#[must_use]
pub fn holds_bands(noise: &Record) -> bool {
    noise.rows.iter().any(|row| row.counters.contains_key(BAND))
}
