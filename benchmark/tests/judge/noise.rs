//! Bands of noise.

use crate::judge::synthetic::{record, sample, steady};
use proctor_benchmark::judge::noise::{band, bands};
use proctor_benchmark::record::{Cases, Record};
use serde_json::json;

/// A record with one run per pass.
fn passes(seconds: &[f64]) -> Record {
    let rows = seconds.iter().enumerate();
    record(rows.map(|(pass, &s)| sample("a", pass as u64, 0, s)))
}

#[test]
fn the_band_is_the_largest_change_between_passes() {
    // Changes of 1, 2, 3, 4 and 5 %, whichever side is slower.
    let first = passes(&[1.0, 1.02, 1.0, 1.04, 1.0]);
    let second = passes(&[1.01, 1.0, 1.03, 1.0, 1.05]);
    let rows = bands(&[first.clone(), second], 12).expect("bands");
    let noise = record(rows);
    let cases = Cases::of(&first);
    let found = band(&noise, &cases.list[0].0).expect("a band");
    assert!((found - 0.05).abs() < 1e-9, "{found}");
    let counters = &noise.rows[0].counters;
    assert!((counters["noise_median"] - 0.03).abs() < 1e-9);
    assert_eq!(counters["noise_pairs"], 5.0);
}

#[test]
fn three_records_make_three_pairs() {
    let one = passes(&[1.0, 1.0, 1.0]);
    let rows = bands(&[one.clone(), one.clone(), one], 12).expect("bands");
    assert_eq!(rows[0].counters["noise_pairs"], 9.0);
    assert_eq!(rows[0].counters["noise_band"], 0.0);
}

#[test]
fn what_gives_no_band_is_refused() {
    let good = record(steady("a", 1.0));
    let refused = |records: &[Record], words: &str| {
        let reason = bands(records, 12).expect_err("refused");
        assert!(reason.contains(words), "{reason}");
    };
    refused(&[], "two or more");
    refused(std::slice::from_ref(&good), "two or more");
    refused(
        &[passes(&[1.0, 1.0]), passes(&[1.0, 1.0])],
        "2 pairs of passes",
    );
    refused(&[record([]), record([])], "no times");
    let mut other = good.clone();
    other.context["commit"] = json!("another");
    refused(&[good.clone(), other], "different programs");
    let mut other = good.clone();
    other.context["cpu_model"] = json!("another");
    refused(&[good.clone(), other], "another machine");
    let mut other = good.clone();
    other.set_incomplete(true);
    refused(&[good, other], "incomplete");
}
