//! Errors, orders and counts.

use crate::judge::synthetic::{compare, of, record, steady, steady_with};
use proctor_benchmark::judge::{CaseVerdict, Verdict};
use proctor_benchmark::record::{Record, Row};

fn with(counters: &[(&str, f64)]) -> Record {
    record(steady_with("a", 1.0, counters))
}

fn verdict(base: &[(&str, f64)], head: &[(&str, f64)]) -> CaseVerdict {
    of(&compare(&with(base), &with(head)), "a").0
}

#[test]
fn an_error_may_rise_as_sums_in_another_order_make_it() {
    let error = |value| [("error_l2", value)];
    let judged = |head| verdict(&error(0.02), &error(head));
    assert_eq!(judged(0.02), CaseVerdict::Same);
    assert_eq!(judged(0.02 * (1.0 + 9e-7)), CaseVerdict::Same);
    assert_eq!(judged(0.02 * (1.0 + 1.1e-6)), CaseVerdict::Worse);
    assert_eq!(judged(0.02 * 1.005), CaseVerdict::Worse);
    assert_eq!(judged(0.02 * (1.0 - 9e-7)), CaseVerdict::Same);
    assert_eq!(judged(0.01), CaseVerdict::Better);
    // No error at all, then one.
    assert_eq!(verdict(&error(0.0), &error(1e-300)), CaseVerdict::Worse);
    assert_eq!(verdict(&error(1e-16), &error(9e-16)), CaseVerdict::Worse);
    assert_eq!(verdict(&error(9e-16), &error(1e-16)), CaseVerdict::Better);
}

#[test]
fn a_figure_should_stay_where_it_is() {
    let figure = |value| [("value_force", value), ("error_other", 0.1)];
    let judged = |head| verdict(&figure(474.0), &figure(head));
    assert_eq!(judged(474.0 * (1.0 + 9e-7)), CaseVerdict::Same);
    assert_eq!(judged(474.1), CaseVerdict::Worse);
    assert_eq!(judged(473.9), CaseVerdict::Worse);
    // Where its error is known, that one judges.
    let known = |value, error| [("value_force", value), ("error_force", error)];
    assert_eq!(
        verdict(&known(474.0, 0.01), &known(473.0, 0.005)),
        CaseVerdict::Better
    );
}

#[test]
fn a_balance_is_better_the_nearer_to_zero() {
    let balance = |value| [("balance_momentum", value)];
    let judged = |base, head| verdict(&balance(base), &balance(head));
    assert_eq!(judged(1e-14, -1e-14), CaseVerdict::Same);
    assert_eq!(judged(1e-14, -2e-14), CaseVerdict::Worse);
    assert_eq!(judged(-1e-14, 1e-15), CaseVerdict::Better);
    assert_eq!(judged(0.0, 1e-17), CaseVerdict::Worse);
}

#[test]
fn lost_accuracy_fails_however_fast() {
    let base = record(steady_with("a", 1.0, &[("error_l2", 0.01)]));
    let head = record(steady_with("a", 0.1, &[("error_l2", 0.02)]));
    let comparison = compare(&base, &head);
    assert_eq!(comparison.verdict(), Verdict::Worse);
    assert!(of(&comparison, "a").1.contains("error_l2 0.01 -> 0.02"));
}

#[test]
fn an_order_is_lost_accuracy() {
    let order = |value: f64| {
        let mut row = Row::aggregate("a", "verdict", 1);
        row.count("observed_order_l2", value);
        record([row])
    };
    let judged = |head| of(&compare(&order(1.9), &order(head)), "a").0;
    assert_eq!(judged(1.9 * (1.0 - 9e-7)), CaseVerdict::Same);
    assert_eq!(judged(1.89), CaseVerdict::Worse);
    assert_eq!(judged(2.1), CaseVerdict::Better);
}

#[test]
fn counts_may_rise_by_one_per_cent() {
    for key in [
        "instructions",
        "instructions_per_particle_step",
        "steps",
        "bytes_per_particle",
    ] {
        let count = |value| [(key, value)];
        assert_eq!(
            verdict(&count(1000.0), &count(1010.0)),
            CaseVerdict::Same,
            "{key}"
        );
        assert_eq!(
            verdict(&count(1000.0), &count(1011.0)),
            CaseVerdict::Worse,
            "{key}"
        );
        assert_eq!(
            verdict(&count(1000.0), &count(980.0)),
            CaseVerdict::Better,
            "{key}"
        );
    }
    // A rate is a time once more, and judged there.
    assert_eq!(
        verdict(&[("a_per_second", 1.0)], &[("a_per_second", 0.1)]),
        CaseVerdict::Same
    );
}

#[test]
fn the_worst_sample_counts() {
    let mut rows = steady_with("a", 1.0, &[("error_l2", 0.01)]);
    let base = record(rows.clone());
    rows[7].count("error_l2", 0.03);
    assert_eq!(
        of(&compare(&base, &record(rows)), "a").0,
        CaseVerdict::Worse
    );
}

#[test]
fn a_case_that_fails_in_head_only_is_worse_and_one_repaired_is_better() {
    let good = steady("a", 1.0);
    let mut bad = good.clone();
    bad[5].fail("step 3: volume inverted");
    let others = steady("b", 1.0);
    let both = |rows: &[Row]| record(rows.iter().chain(&others).cloned());
    let comparison = compare(&both(&good), &both(&bad));
    assert_eq!(comparison.verdict(), Verdict::Worse);
    assert!(of(&comparison, "a").1.contains("volume inverted"));
    assert_eq!(
        of(&compare(&both(&bad), &both(&good)), "a").0,
        CaseVerdict::Better
    );
    assert_eq!(compare(&both(&bad), &both(&bad)).verdict(), Verdict::Fine);
}

#[test]
fn a_new_case_is_listed_and_fine() {
    let base = record(steady("a", 1.0));
    let head = record(steady("a", 1.0).into_iter().chain(steady("b", 9.0)));
    let comparison = compare(&base, &head);
    assert_eq!(of(&comparison, "b").0, CaseVerdict::New);
    assert_eq!(comparison.verdict(), Verdict::Fine);
}

#[test]
fn other_bits_of_the_state_are_worse() {
    let hashed = |hash: &str| {
        let mut rows = steady("a", 1.0);
        for row in &mut rows {
            row.label("state_hash", hash);
        }
        record(rows)
    };
    let judged = |head| of(&compare(&hashed("12"), &hashed(head)), "a");
    assert_eq!(judged("12").0, CaseVerdict::Same);
    let (verdict, reason) = judged("34");
    assert_eq!(verdict, CaseVerdict::Worse);
    assert!(reason.contains("state_hash 12 -> 34"), "{reason}");
}
