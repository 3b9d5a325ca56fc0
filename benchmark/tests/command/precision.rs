//! `proctor precision`.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::Value;

#[test]
fn an_unknown_case_is_bad_input_with_the_nearest_name() {
    let output = proctor(&["precision", "axis-alined"]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    assert!(
        message.contains("did you mean `axis-aligned`?"),
        "{message}"
    );
    assert_eq!(stdout(&output), "");
}

#[test]
fn files_that_cannot_be_written_are_found_before_the_work() {
    let desk = Desk::new();
    for option in ["--json", "--csv"] {
        let path = desk.name("no/such/folder/file");
        let output = proctor(&["precision", "bar", "--quick", option, &path]);
        assert_eq!(code(&output), 2, "{option}");
        assert_eq!(stdout(&output), "");
    }
}

/// Linear functions and USL cannot carry the column under its own weight: such runs must stay in sight.
#[test]
fn failed_runs_are_rows_lines_and_open_marks() {
    let desk = Desk::new();
    let [json, csv, svg] = ["p.json", "p.csv", "charts"].map(|name| desk.name(name));
    let output = proctor(&[
        "precision",
        "self-weight",
        "--quick",
        "--repetitions",
        "2",
        "--json",
        &json,
        "--csv",
        &csv,
        "--svg",
        &svg,
    ]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let text = stdout(&output);
    for word in [
        "failed",
        "for 0.1 %",
        "best with",
        "runs failed",
        "not to be trusted",
    ] {
        assert!(text.contains(word), "{word}: {text}");
    }
    let table = text
        .lines()
        .filter(|line| line.contains(" FLIP ") || line.contains("order"));
    for line in table {
        assert!(line.chars().count() <= 110, "{line}");
    }

    let record: Value =
        serde_json::from_str(&std::fs::read_to_string(json).expect("a record")).expect("JSON");
    assert!(record["context"].get("incomplete").is_none());
    let rows = record["benchmarks"].as_array().expect("rows");
    let samples: Vec<&Value> = rows
        .iter()
        .filter(|r| r["run_type"] == "iteration")
        .collect();
    let failed: Vec<&&Value> = samples
        .iter()
        .filter(|r| r["error_occurred"] == true)
        .collect();
    assert!(!failed.is_empty() && failed.len() < samples.len());
    for row in &failed {
        assert!(row["error_message"].as_str().is_some_and(|m| !m.is_empty()));
        assert!(row["cell_size"].is_number() && row["scheme"].is_string());
    }
    for row in samples.iter().filter(|r| r.get("error_occurred").is_none()) {
        for key in [
            "error_displacement",
            "error_stress",
            "steps",
            "particles",
            "dt_over_critical",
            "real_time",
            "cpu_time",
            "courant",
            "particles_per_cell",
        ] {
            assert!(row[key].as_f64().is_some_and(|v| v > 0.0), "{key}: {row}");
        }
        // A gain that accuracy paid for is judged at equal error, along runs that differ in resolution alone.
        let ladder = row["ladder"].as_str().expect("a ladder");
        assert!(!ladder.contains("h="), "{ladder}");
    }
    assert!(
        rows.iter()
            .any(|r| r["aggregate_name"] == "cost_displacement"
                && r["seconds_for_error_0.01"].is_number())
    );

    let csv = std::fs::read_to_string(csv).expect("values");
    let choices: std::collections::BTreeSet<&str> = samples
        .iter()
        .filter_map(|r| r["run_name"].as_str())
        .collect();
    // One line per choice and measure, and a heading.
    assert_eq!(csv.lines().count(), 2 * choices.len() + 1);
    assert!(csv.contains("not to be trusted"));

    for measure in ["displacement", "stress"] {
        let chart = std::fs::read_to_string(format!("{svg}/self-weight-{measure}.svg"));
        let chart = chart.expect("a chart");
        assert!(
            chart.contains(" open\"") && chart.contains("failed after"),
            "{measure}"
        );
    }
}

/// With `--own` a case has one line, that of its own method, and what two cases both study is in one table and one chart.
#[test]
fn own_methods_of_two_cases_stand_beside_each_other() {
    let desk = Desk::new();
    let svg = desk.name("beside");
    let output = proctor(&[
        "precision",
        "bar",
        "self-weight",
        "--own",
        "--quick",
        "--repetitions",
        "1",
        "--svg",
        &svg,
    ]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let text = stdout(&output);
    let (each, beside) = text.split_once("beside each other").expect("a table");
    assert_eq!(each.matches("\n  combination ").count(), 4, "{text}");
    for case in ["bar", "self-weight"] {
        let lines = beside
            .lines()
            .filter(|line| line.contains(&format!(" {case} ")));
        assert!(lines.count() >= 2, "{case}: {text}");
    }
    let chart = std::fs::read_to_string(desk.path("beside/bar-self-weight-displacement.svg"));
    let chart = chart.expect("a chart of both");
    for case in ["bar, ", "self-weight, "] {
        assert!(chart.contains(case), "{case}");
    }
}
