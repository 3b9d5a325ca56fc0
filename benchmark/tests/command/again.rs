//! `proctor verify --resume` and `--failed`: what an earlier record lacks, or what failed in it.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;
use std::process::Output;

fn read(desk: &Desk, name: &str) -> Value {
    let text = fs::read_to_string(desk.path(name)).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

fn is_of(row: &Value, case: &str) -> bool {
    let name = row["name"].as_str().expect("a name");
    name.starts_with(case)
}

/// A desk with a record of three short cases.
fn with_record() -> Desk {
    let desk = Desk::new();
    let record = desk.name("whole.json");
    let output = proctor(&[
        "verify",
        "bar",
        "self-weight",
        "rotation",
        "--quick",
        "--json",
        &record,
    ]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    desk
}

/// The same as it would be after an interrupt in the case: half of its rows, and the mark of an incomplete record.
fn cut(desk: &Desk, case: &str) -> String {
    let mut record = read(desk, "whole.json");
    record["context"]["incomplete"] = json!(true);
    let rows = record["benchmarks"].as_array_mut().expect("rows");
    let first = rows.iter().position(|row| is_of(row, case)).expect("rows");
    rows.remove(first);
    desk.scene("cut.json", &record)
}

/// The same as a run leaves it that was killed in its first case.
fn empty(desk: &Desk) -> String {
    let mut record = read(desk, "whole.json");
    record["context"]["incomplete"] = json!(true);
    record["benchmarks"] = json!([]);
    record["details"] = json!({});
    desk.scene("empty.json", &record)
}

/// The same with a gate of the case that failed.
fn failed(desk: &Desk, case: &str) -> String {
    let mut record = read(desk, "whole.json");
    let rows = record["benchmarks"].as_array_mut().expect("rows");
    let verdict = |row: &&mut Value| is_of(row, case) && row["aggregate_name"] == "verdict";
    let row = rows.iter_mut().find(verdict).expect("a verdict");
    row["error_occurred"] = json!(true);
    row["error_message"] = json!("gates failed: one");
    desk.scene("failed.json", &record)
}

/// Names of the cases that were run, by their lines.
fn run(output: &Output) -> Vec<String> {
    let text = stdout(output);
    let lines = text
        .lines()
        .filter(|line| line.starts_with("✓ ") && !line.contains("PASS"));
    let name = |line: &str| {
        line.split_whitespace()
            .nth(1)
            .unwrap_or_default()
            .to_owned()
    };
    lines.map(name).collect()
}

/// Of a record that holds nothing yet all cases that were asked for are missing, and nothing has failed.
#[test]
fn of_an_empty_record_everything_is_run() {
    let desk = with_record();
    let record = empty(&desk);
    let failed = proctor(&["verify", "--failed", &record]);
    assert_eq!(code(&failed), 2, "{}", stdout(&failed));
    assert!(stderr(&failed).contains("found no case that was run to its end"));
    let output = proctor(&["verify", "--resume", &record]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("holds no case that held; all 3 are run"),
        "{}",
        stderr(&output)
    );
    assert!(stdout(&output).contains("PASS: 8 of 8 gates in 3 cases"));
    let compared = proctor(&["compare", &desk.name("whole.json"), &record]);
    assert_eq!(code(&compared), 0, "{}", stdout(&compared));
}

#[test]
fn what_is_missing_or_failed_is_run_and_the_record_is_whole() {
    let desk = with_record();
    for record in [cut(&desk, "self-weight"), failed(&desk, "self-weight")] {
        let output = proctor(&["verify", "--resume", &record]);
        let text = stdout(&output);
        assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
        // Not the other cases of the suite either: nobody had asked for them.
        assert_eq!(run(&output), ["self-weight"], "{text}");
        assert!(
            text.contains("PASS: 8 of 8 gates in 3 cases; 2 of them held before"),
            "{text}"
        );
        let compared = proctor(&["compare", &desk.name("whole.json"), &record]);
        assert_eq!(code(&compared), 0, "{}", stdout(&compared));
        let name = if record.contains("cut") {
            "cut.json"
        } else {
            "failed.json"
        };
        let (whole, again) = (read(&desk, "whole.json"), read(&desk, name));
        assert_eq!(again["context"]["incomplete"], Value::Null);
        let names = |record: &Value| -> Vec<String> {
            let rows = record["benchmarks"].as_array().expect("rows");
            rows.iter().map(|row| row["name"].to_string()).collect()
        };
        assert_eq!(names(&whole), names(&again));
        assert_eq!(
            whole["details"]["cases"].as_array().map(Vec::len),
            again["details"]["cases"].as_array().map(Vec::len)
        );
        // Nothing is left to do.
        let output = proctor(&["verify", "--resume", &record]);
        assert_eq!(code(&output), 0);
        assert_eq!(run(&output), [""; 0]);
        assert!(stdout(&output).contains("PASS: 8 of 8 gates in 3 cases; 3 of them held before"));
    }
}

#[test]
fn a_copy_is_completed_where_a_file_is_named() {
    let desk = with_record();
    let record = cut(&desk, "bar");
    let before = read(&desk, "cut.json");
    let output = proctor(&[
        "verify",
        "--resume",
        &record,
        "--json",
        &desk.name("new.json"),
    ]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(read(&desk, "cut.json"), before);
    assert_eq!(
        read(&desk, "new.json")["context"]["incomplete"],
        Value::Null
    );
}

#[test]
fn only_what_failed_is_run() {
    let desk = with_record();
    let record = failed(&desk, "rotation");
    let before = read(&desk, "failed.json");
    let output = proctor(&["verify", "--failed", &record]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(run(&output), ["rotation"]);
    assert!(stdout(&output).contains("PASS: 2 of 2 gates in 1 case"));
    // It is a run of its own.
    assert_eq!(read(&desk, "failed.json"), before);
    let output = proctor(&["verify", "--failed", &desk.name("whole.json")]);
    assert_eq!(code(&output), 0);
    assert!(
        stdout(&output).contains("no case failed in"),
        "{}",
        stdout(&output)
    );
    // What is missing did not fail.
    let output = proctor(&["verify", "--failed", &cut(&desk, "bar")]);
    assert!(
        stdout(&output).contains("no case failed in"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn a_record_of_another_program_or_of_something_else_is_refused() {
    let desk = with_record();
    let record = cut(&desk, "bar");
    let mut other = read(&desk, "cut.json");
    other["context"]["commit"] = json!("0123");
    let other = desk.scene("other.json", &other);
    let output = proctor(&["verify", "--resume", &other]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    assert!(
        message.contains("`commit` is \"0123\"") && message.contains("--failed"),
        "{message}"
    );
    let mut more = read(&desk, "cut.json");
    let mut row = more["benchmarks"][0].clone();
    for key in ["name", "run_name"] {
        row[key] = json!("moving-3d/threads:1");
    }
    more["benchmarks"].as_array_mut().expect("rows").push(row);
    let output = proctor(&["verify", "--resume", &desk.scene("more.json", &more)]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("holds more than cases"),
        "{}",
        stderr(&output)
    );
    let mut nameless = read(&desk, "cut.json");
    nameless["context"]
        .as_object_mut()
        .expect("an object")
        .remove("ladders");
    let nameless = desk.scene("nameless.json", &nameless);
    for option in ["--resume", "--failed"] {
        let output = proctor(&["verify", option, &nameless]);
        assert_eq!(code(&output), 2);
        assert!(
            stderr(&output).contains("context.ladders: found nothing"),
            "{}",
            stderr(&output)
        );
        let output = proctor(&["verify", option, &desk.name("not_there.json")]);
        assert_eq!(code(&output), 2);
    }
    for more in [&["--quick"][..], &["--list"], &["--failed"]] {
        let output = proctor(&[&["verify", "--resume", &record], more].concat());
        assert_eq!(code(&output), 2, "{more:?}");
    }
}
