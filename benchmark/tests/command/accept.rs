//! `proctor accept`, and `proctor compare` with a ledger.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// A record of one case with an error and a figure.
fn record(error: f64, figure: f64) -> Value {
    json!({
        "context": {
            "schema_version": 1, "library_build_type": "release", "ladders": "quick",
            "commit": "0123456789abcdef", "dirty": true
        },
        "benchmarks": [{
            "name": "bar/h=1", "run_name": "bar/h=1", "run_type": "iteration", "repetition_index": 0,
            "iterations": 0, "error_l2": error, "value_force": figure
        }]
    })
}

const BECAUSE: &str = "the weights are exact at the walls now";

/// Accepts what moved from one record to the other.
fn accept(desk: &Desk, base: &Value, head: &Value, more: &[&str]) -> (i32, String) {
    let (base, head) = (desk.scene("base.json", base), desk.scene("head.json", head));
    let ledger = desk.name("accepted.csv");
    let mut arguments = vec!["accept", &base, &head, "--ledger", &ledger];
    arguments.extend(["--because", BECAUSE]);
    arguments.extend(more);
    let output = proctor(&arguments);
    (code(&output), stdout(&output) + &stderr(&output))
}

/// Compares the two records that were accepted last.
fn compare(desk: &Desk, more: &[&str]) -> (i32, String) {
    let (base, head) = (desk.name("base.json"), desk.name("head.json"));
    let ledger = desk.name("accepted.csv");
    let mut arguments = vec![
        "compare",
        &base,
        &head,
        "--ignore-time",
        "--ledger",
        &ledger,
    ];
    arguments.extend(more);
    let output = proctor(&arguments);
    (code(&output), stdout(&output) + &stderr(&output))
}

#[test]
fn a_gain_is_taken_with_its_reason() {
    let desk = Desk::new();
    let (status, said) = accept(&desk, &record(0.1, 5.0), &record(0.05, 5.0), &[]);
    assert_eq!(status, 0, "{said}");
    assert!(said.contains("1 changes taken into"), "{said}");
    let ledger = fs::read_to_string(desk.path("accepted.csv")).expect("a ledger");
    assert_eq!(
        ledger,
        format!(
            "ladder,case,number,from,to,what,reason,commit\n\
             quick,bar/h=1,error_l2,0.1,0.05,better,{BECAUSE},0123456789+\n"
        )
    );
    let (status, said) = compare(&desk, &["--strict"]);
    assert_eq!(status, 0, "{said}");
    assert!(said.contains("accepted: error_l2 0.1 -> 0.05"), "{said}");
    assert!(said.contains("1 accepted change"), "{said}");
    assert!(!said.contains("no change"), "{said}");
}

#[test]
fn accepted_changes_are_counted() {
    let desk = Desk::new();
    let (status, said) = accept(&desk, &record(0.1, 5.0), &record(0.2, 6.0), &["--worse"]);
    assert_eq!(status, 0, "{said}");
    let (status, said) = compare(&desk, &[]);
    assert_eq!(status, 0, "{said}");
    assert!(said.contains("2 accepted changes"), "{said}");
}

#[test]
fn what_is_worse_is_taken_only_where_it_is_asked_for() {
    let desk = Desk::new();
    // By half a per cent; and a figure, of which neither side is better.
    for head in [record(0.1005, 5.0), record(0.1, 5.1)] {
        let (status, said) = accept(&desk, &record(0.1, 5.0), &head, &[]);
        assert_eq!(status, 1, "{said}");
        assert!(
            said.contains("WORSE bar/h=1") && said.contains("--worse takes"),
            "{said}"
        );
        assert!(!desk.path("accepted.csv").exists(), "nothing is written");
    }
    let head = record(0.1005, 5.1);
    let (status, said) = accept(&desk, &record(0.1, 5.0), &head, &["--worse"]);
    assert_eq!(status, 0, "{said}");
    assert_eq!(compare(&desk, &["--strict"]).0, 0);
    // Without the ledger it is worse.
    let output = proctor(&[
        "compare",
        &desk.name("base.json"),
        &desk.name("head.json"),
        "--ignore-time",
    ]);
    assert_eq!(code(&output), 1, "{}", stdout(&output));
}

#[test]
fn small_steps_add_up() {
    let desk = Desk::new();
    let step = 1.0 + 0.9e-6;
    let (one, two) = (0.1 * step, 0.1 * step * step);
    assert_eq!(
        accept(&desk, &record(0.1, 5.0), &record(one, 5.0), &[]).0,
        0
    );
    let (status, said) = accept(&desk, &record(one, 5.0), &record(two, 5.0), &[]);
    assert_eq!(status, 1, "{said}");
}

#[test]
fn lines_of_the_ledger_are_not_taken_back() {
    let desk = Desk::new();
    assert_eq!(
        accept(&desk, &record(0.1, 5.0), &record(0.05, 5.0), &[]).0,
        0
    );
    let before = desk.name("before.csv");
    fs::copy(desk.path("accepted.csv"), &before).expect("copied");
    assert_eq!(
        accept(&desk, &record(0.05, 5.0), &record(0.04, 5.0), &[]).0,
        0
    );
    assert_eq!(compare(&desk, &["--continues", &before]).0, 0);
    let text = fs::read_to_string(&before).expect("a ledger");
    fs::write(&before, text.replace("walls", "floors")).expect("written");
    let (status, said) = compare(&desk, &["--continues", &before]);
    assert_eq!(status, 2, "{said}");
    assert!(said.contains("it may only grow at its end"), "{said}");
}

#[test]
fn a_reason_has_words_and_a_ledger_has_lines() {
    let desk = Desk::new();
    let base = desk.scene("base.json", &record(0.1, 5.0));
    let ledger = desk.name("accepted.csv");
    let output = proctor(&[
        "accept",
        &base,
        &base,
        "--ledger",
        &ledger,
        "--because",
        "so",
    ]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("accepted: a sentence"),
        "{}",
        stderr(&output)
    );
    fs::write(&ledger, "what,is,this\n1,2,3\n").expect("written");
    let output = proctor(&["compare", &base, &base, "--ledger", &ledger]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("accepted.csv"),
        "{}",
        stderr(&output)
    );
}
