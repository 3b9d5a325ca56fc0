//! Copies of the kept record that somebody tampered with: none of them is fine.

use crate::judge::synthetic::record;
use proctor_benchmark::judge::{self, CaseVerdict, Comparison, Rules, Verdict};
use proctor_benchmark::record::{Kind, Meaning, Record, Row};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::OnceLock;

/// The record that CI compares with.
fn kept() -> &'static Record {
    static KEPT: OnceLock<Record> = OnceLock::new();
    KEPT.get_or_init(|| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        Record::read(&root.join("fixtures/expected/errors.json")).expect("the kept record")
    })
}

fn compared(base: &Record, head: &Record) -> Comparison {
    let rules = Rules {
        ignore_time: true,
        ..Rules::default()
    };
    judge::compare(base, head, &rules)
}

/// A copy with rows changed.
fn with(mut change: impl FnMut(&mut Row)) -> Record {
    let mut copy = kept().clone();
    copy.rows.iter_mut().for_each(&mut change);
    assert_ne!(copy.rows, kept().rows, "nothing was changed");
    copy
}

fn is_gate(row: &Row) -> bool {
    matches!(&row.kind, Kind::Aggregate { name } if name == "gate")
}

/// Checks that a copy is not fine, with these words.
fn not_fine(head: &Record, verdict: Verdict, words: &str) {
    not_fine_against(kept(), head, verdict, words);
}

fn not_fine_against(base: &Record, head: &Record, verdict: Verdict, words: &str) {
    let comparison = compared(base, head);
    assert_eq!(comparison.verdict(), verdict, "{words}");
    let mut reasons = comparison.findings.iter().flat_map(|f| &f.reasons);
    assert!(reasons.any(|line| line.contains(words)), "{words}");
}

#[test]
fn the_kept_record_against_itself_is_fine_and_complete() {
    let comparison = compared(kept(), kept());
    assert_eq!(comparison.verdict(), Verdict::Fine);
    let tallies = comparison.tallies();
    for meaning in [
        Meaning::Error,
        Meaning::Order,
        Meaning::Balance,
        Meaning::Figure,
        Meaning::GateValue,
        Meaning::GateBound,
        Meaning::GateSide,
        Meaning::Count,
    ] {
        let tally = tallies.iter().find(|tally| tally.meaning == meaning);
        let tally = tally.unwrap_or_else(|| panic!("no {}", meaning.plural()));
        assert!(tally.compared > 0 && tally.alone == 0, "{tally:?}");
        assert_eq!(tally.equal, tally.compared, "{tally:?}");
    }
}

#[test]
fn the_number_of_threads_does_not_part_cases() {
    for threads in [2, 4, 64] {
        let head = with(|row| row.threads = threads);
        let comparison = compared(kept(), &head);
        assert_eq!(comparison.verdict(), Verdict::Fine, "{threads} threads");
        assert_eq!(comparison.tallies(), compared(kept(), kept()).tallies());
    }
}

#[test]
fn all_gates_but_one_per_case_are_gone() {
    let mut seen: Vec<String> = vec![];
    let mut head = kept().clone();
    head.rows.retain(|row| {
        let case = case_of(row).to_owned();
        if !is_gate(row) || !seen.contains(&case) {
            seen.push(case);
            return true;
        }
        false
    });
    assert!(head.rows.len() < kept().rows.len());
    not_fine(&head, Verdict::CannotCompare, "missing in HEAD");
}

/// The kept rows of one case.
fn kept_of(case: &str) -> Record {
    let mut record = kept().clone();
    record.rows.retain(|row| case_of(row) == case);
    record
}

/// The case that a row is of.
fn case_of(row: &Row) -> &str {
    row.name.split(':').next().unwrap_or_default()
}

/// Each gate, beside the rows of its case alone.
#[test]
fn a_gate_that_is_loosened() {
    let cases: BTreeSet<&str> = kept().rows.iter().map(case_of).collect();
    for base in cases.into_iter().map(kept_of) {
        for (place, row) in base.rows.iter().enumerate().filter(|(_, row)| is_gate(row)) {
            let sign = if row.labels["gate_side"] == "at most" {
                1.0
            } else {
                -1.0
            };
            let bound = row.counters["gate_bound"];
            let mut looser = base.clone();
            looser.rows[place].count("gate_bound", bound + sign * bound.abs().max(1e-9) * 1e-9);
            not_fine_against(&base, &looser, Verdict::Worse, "looser: gate_bound");
        }
    }
}

#[test]
fn a_gate_with_another_side_or_none() {
    let gates = |row: &Row| is_gate(row);
    let turned = with(|row| {
        if gates(row) && row.labels["gate_side"] == "at most" {
            row.label("gate_side", "at least");
        }
    });
    not_fine(&turned, Verdict::Worse, "gate_side at most -> at least");
    let none = with(|row| {
        if gates(row) {
            row.labels.remove("gate_side");
        }
    });
    not_fine(&none, Verdict::CannotCompare, "gate_side is missing");
}

#[test]
fn every_figure_of_grains_a_thousandfold() {
    let head = with(|row| {
        if row.name.starts_with("grains/") {
            for (key, value) in &mut row.counters {
                if matches!(Meaning::of(key), Meaning::Figure | Meaning::Balance) {
                    *value *= 1000.0;
                }
            }
        }
    });
    not_fine(&head, Verdict::Worse, "x1000");
}

#[test]
fn a_balance_of_one_half() {
    let head = with(|row| {
        if row.name.starts_with("rings/") {
            for (key, value) in &mut row.counters {
                if Meaning::of(key) == Meaning::Balance {
                    *value = 0.5;
                }
            }
        }
    });
    not_fine(&head, Verdict::Worse, "balance_");
}

#[test]
fn a_new_rung_that_fails_and_one_that_holds() {
    let mut row = Row::sample("bar/new", 0, 1);
    row.count("error_l2_u", 0.1);
    let mut head = kept().clone();
    head.push(row.clone());
    let comparison = compared(kept(), &head);
    assert_eq!(comparison.verdict(), Verdict::Fine);
    let mut findings = comparison.findings.iter();
    assert!(findings.any(|f| f.case.name == "bar/new" && f.verdict == CaseVerdict::New));
    row.fail("volume inverted");
    let mut head = kept().clone();
    head.push(row);
    not_fine(&head, Verdict::Worse, "fails in HEAD only: volume inverted");
}

#[test]
fn a_new_gate_that_does_not_hold() {
    let mut gate = Row::aggregate("bar: new", "gate", 0);
    gate.count("gate_value", 2.0);
    gate.count("gate_bound", 1.0);
    gate.label("gate_side", "at most");
    let mut head = kept().clone();
    head.push(gate);
    not_fine(&head, Verdict::Worse, "a new gate that does not hold");
}

#[test]
fn a_gate_that_no_longer_holds() {
    let head = with(|row| {
        if is_gate(row) && row.name.starts_with("bar:") {
            let bound = row.counters["gate_bound"];
            let beyond = if row.labels["gate_side"] == "at most" {
                2.0
            } else {
                0.5
            };
            row.count("gate_value", bound * beyond);
        }
    });
    not_fine(&head, Verdict::Worse, "does not hold in HEAD");
    let unknown = with(|row| {
        if is_gate(row) && row.name.starts_with("bar:") {
            row.counters.remove("gate_value");
        }
    });
    not_fine(&unknown, Verdict::CannotCompare, "gate_value is missing");
}

/// The kept record with the verdict of a case failed.
fn failed(message: &str) -> Record {
    with(|row| {
        if row.name == "bar" {
            row.fail(message);
        }
    })
}

#[test]
fn three_failed_gates_where_there_was_one() {
    not_fine_against(
        &failed("gates failed: a"),
        &failed("gates failed: a; b; c"),
        Verdict::Worse,
        "fails for another reason",
    );
}

#[test]
fn a_rung_that_fails_in_both_for_another_reason() {
    let failed = |message: &str| {
        with(|row| {
            if row.name.starts_with("boussinesq/") {
                row.fail(message);
            }
        })
    };
    let (base, head) = (
        failed("volume inverted"),
        failed("a particle left the mesh"),
    );
    not_fine_against(
        &base,
        &head,
        Verdict::Worse,
        "volume inverted -> a particle left the mesh",
    );
    assert_eq!(compared(&base, &base).verdict(), Verdict::Fine);
}

#[test]
fn an_error_that_was_no_number_and_is_a_billion() {
    let base = with(|row| {
        row.counters.remove("error_l2_stress");
    });
    let head = with(|row| {
        if let Some(error) = row.counters.get_mut("error_l2_stress") {
            *error = 1e9;
        }
    });
    not_fine_against(
        &base,
        &head,
        Verdict::CannotCompare,
        "error_l2_stress is 1000000000.0 in HEAD, and not in BASE",
    );
    // Nor is one that vanished.
    not_fine_against(
        kept(),
        &base,
        Verdict::CannotCompare,
        "error_l2_stress is missing in HEAD",
    );
}

#[test]
fn every_error_a_little_worse() {
    for factor in [1.0099, 1.005, 1.000_002] {
        let head = with(|row| {
            for (key, value) in &mut row.counters {
                if Meaning::of(key) == Meaning::Error {
                    *value *= factor;
                }
            }
        });
        not_fine(&head, Verdict::Worse, "error_l2_stress");
    }
}

#[test]
fn a_reference_that_moved_with_the_result() {
    let head = with(|row| {
        for (key, value) in &mut row.counters {
            if matches!(Meaning::of(key), Meaning::Reference | Meaning::Figure) {
                *value *= 1.0 + 1e-5;
            }
        }
    });
    not_fine(&head, Verdict::Worse, "exact_u_z_at_5_5_5");
}

#[test]
fn a_case_that_is_dropped() {
    let mut head = kept().clone();
    head.rows.retain(|row| !row.name.starts_with("boussinesq"));
    not_fine(&head, Verdict::CannotCompare, "missing in HEAD");
}

#[test]
fn sums_in_another_order_are_listed_and_fine() {
    let head = with(|row| {
        for (key, value) in &mut row.counters {
            if Meaning::of(key) == Meaning::Error {
                *value *= 1.0 + 1e-9;
            }
        }
    });
    let comparison = compared(kept(), &head);
    assert_eq!(comparison.verdict(), Verdict::Fine);
    let told: usize = comparison.findings.iter().map(|f| f.told.len()).sum();
    let tallies = comparison.tallies();
    let errors = tallies.iter().find(|t| t.meaning == Meaning::Error);
    let errors = errors.expect("errors");
    assert_eq!(told, errors.compared - errors.equal);
    assert!(told > 100, "{told}");
}

#[test]
fn a_result_that_does_not_repeat() {
    let row = |repetition: u64, error: f64| {
        let mut row = Row::sample("a", repetition, 1);
        row.count("error_l2", error);
        row.label("state_hash", if error > 0.1 { "12" } else { "34" });
        row
    };
    let base = record([row(0, 0.1), row(1, 0.1)]);
    let head = record([row(0, 0.1), row(1, 0.1 + 1e-17 + f64::EPSILON)]);
    not_fine_against(&base, &head, Verdict::Worse, "state_hash 34 -> 12; 34");
    not_fine_against(&base, &head, Verdict::Worse, "error_l2");
}

#[test]
fn a_short_ladder_against_a_full_one() {
    let mut full = kept().clone();
    full.context["ladders"] = "full".into();
    let comparison = compared(kept(), &full);
    assert_eq!(comparison.verdict(), Verdict::CannotCompare);
    assert!(
        comparison
            .obstacles
            .iter()
            .any(|o| o.contains("another ladder")),
        "{:?}",
        comparison.obstacles
    );
}
