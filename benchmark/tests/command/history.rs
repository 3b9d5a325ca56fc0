//! `proctor history` and `export` for what comes after it: records over commits.

use crate::command::support::{Desk, code, command, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;
use std::io::Read as _;
use std::path::Path;
use std::process::{Command, Stdio};
use wait4::Wait4;

/// A record of one case with an error and a time.
fn record(commit: usize, error: f64, seconds: f64) -> Value {
    json!({
        "context": {
            "schema_version": 1, "cpu_model": "one", "commit": format!("{commit:040x}"),
            "date": format!("2026-01-{:02}T{:02}:00:00+00:00", 1 + commit / 24, commit % 24),
        },
        "benchmarks": [{
            "name": "bar/h=1", "run_name": "bar/h=1", "run_type": "iteration", "repetition_index": 0, "iterations": 1,
            "threads": 1, "real_time": seconds, "cpu_time": seconds, "time_unit": "s", "error_l2_u": error, "steps": 10.0,
        }],
    })
}

/// Forty records: the error falls at the eleventh and grows at the thirty-first, the time grows at the twenty-first.
fn forty(desk: &Desk) -> String {
    fs::create_dir(desk.path("records")).expect("a folder");
    for commit in 0..40 {
        let error = match commit {
            0..10 => 0.02,
            10..30 => 0.01,
            _ => 0.015,
        };
        let noise = 0.01 * ((commit * 7) % 5) as f64;
        let seconds = noise + if commit < 20 { 1.0 } else { 1.2 };
        // Names that do not say the order.
        let name = format!("records/{:02}.json", (commit * 17) % 40);
        desk.scene(&name, &record(commit, error, seconds));
    }
    desk.name("records")
}

#[test]
fn records_are_ordered_by_date_and_changes_are_told_with_their_size() {
    let desk = Desk::new();
    let folder = forty(&desk);
    let output = proctor(&["history", &folder, "--all", "--svg", &desk.name("charts")]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let tidy: Vec<String> = text
        .lines()
        .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect();
    for line in [
        "40 records, 2 numbers that are exact, 1 times (change points at p < 0.001),",
        "better bar/h=1: error_l2_u -50.0 %",
        "2.00 % -> 1.00 %",
        "worse bar/h=1: cpu_seconds +19.6 %",
        "worse bar/h=1: error_l2_u +50.0 %",
        "37 of 40 records change nothing",
    ] {
        assert!(
            tidy.iter().any(|found| found.contains(line)),
            "{line} is not in {text}"
        );
    }
    let places = ["-50.0 %", "+19.6 %", "+50.0 %"].map(|change| text.find(change));
    assert!(places.is_sorted(), "{text}");
    assert!(
        text.lines()
            .all(|line| line.chars().count() <= 80 || line.starts_with("chart")),
        "{text}"
    );
    let charts: Vec<_> = fs::read_dir(desk.path("charts"))
        .expect("charts")
        .flatten()
        .collect();
    assert_eq!(charts.len(), 3);
    let overview = fs::read_to_string(desk.path("charts/changes.svg")).expect("a chart");
    assert!(overview.contains("1 better") && overview.contains("1 worse"));
}

#[test]
fn numbers_are_chosen_by_their_names() {
    let desk = Desk::new();
    let folder = forty(&desk);
    let output = proctor(&["history", &folder, "--number", "bar", "--number", "cpu"]);
    let text = stdout(&output);
    assert!(text.contains("0 numbers that are exact, 1 times"), "{text}");
    assert!(!text.contains("error_l2_u"), "{text}");
    let output = proctor(&["history", &folder, "--number", "barr"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("--number barr: no number has this in its name"));
}

#[test]
fn what_is_no_record_of_this_version_is_refused_with_both_versions() {
    let desk = Desk::new();
    let mut other = record(0, 0.1, 1.0);
    other["context"]["schema_version"] = json!(2);
    let other = desk.scene("other.json", &other);
    for (arguments, words) in [
        (
            vec!["history", other.as_str()],
            "found schema version 2; this program reads version 1",
        ),
        (vec!["history", "none.json"], "none.json: cannot be read"),
        (vec!["history"], "found no record; accepted: "),
        (vec!["history", "--git", "/proc/none.json"], "git: "),
    ] {
        let output = proctor(&arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    fs::create_dir(desk.path("empty")).expect("a folder");
    let output = proctor(&["history", &desk.name("empty")]);
    assert!(stderr(&output).contains("empty: no record; accepted: records, or folders of them"));
}

fn git(folder: &Path, arguments: &[&str]) {
    let mut git = Command::new("git");
    git.args([
        "-c",
        "user.name=a",
        "-c",
        "user.email=a@b",
        "-c",
        "commit.gpgsign=false",
        "-C",
    ])
    .arg(folder);
    let output = git.args(arguments).output().expect("git starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn git_has_a_record_per_commit_that_changed_it_and_what_is_none_is_left_out() {
    let desk = Desk::new();
    let folder = desk.path("repository");
    fs::create_dir(&folder).expect("a folder");
    git(&folder, &["init", "--quiet"]);
    for (error, subject) in [
        (Some(0.02), "one"),
        (Some(0.01), "a finer mesh"),
        (None, "broken"),
        (Some(0.03), "a bug"),
    ] {
        let text = error.map_or_else(|| "{".to_owned(), |error| record(0, error, 1.0).to_string());
        fs::write(folder.join("kept.json"), text).expect("a file");
        fs::write(folder.join("other"), subject).expect("a file");
        git(&folder, &["add", "."]);
        git(&folder, &["commit", "--quiet", "-m", subject]);
    }
    fs::write(folder.join("other"), "again").expect("a file");
    git(
        &folder,
        &["commit", "--quiet", "-am", "nothing of the record"],
    );
    let kept = folder.join("kept.json").display().to_string();
    let output = proctor(&["history", "--git", &kept]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for words in [
        "3 records",
        "left out: ",
        "truncated",
        "a finer mesh",
        "a bug",
        "+200.0 %",
        "-50.0 %",
    ] {
        assert!(text.contains(words), "{words} is not in {text}");
    }
    assert!(!text.contains("nothing of the record"), "{text}");
    // A folder has no history of its own.
    let output = proctor(&["history", "--git", &folder.display().to_string()]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("accepted: a record"),
        "{}",
        stderr(&output)
    );
    // The same on a page.
    let out = desk.name("page.html");
    let output = proctor(&["report", &kept, "--history-of", &kept, "--out", &out]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let page = fs::read_to_string(&out).expect("a page");
    assert!(page.contains("<h2 id=\"history\">History</h2>") && page.contains("a finer mesh"));
}

#[test]
fn otava_gets_a_line_per_record_and_the_names_of_the_columns() {
    let desk = Desk::new();
    let folder = forty(&desk);
    let table = desk.name("table.csv");
    let output = proctor(&["export", "--format", "otava", &folder, "--out", &table]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(desk.path("table.csv")).expect("a table");
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("time,commit,bar/h=1: error_l2_u,bar/h=1: steps,bar/h=1: cpu_seconds")
    );
    assert_eq!(
        lines.next(),
        Some(&*format!("2026-01-01T00:00:00+00:00,{:040x},0.02,10,1", 0))
    );
    assert_eq!(text.lines().count(), 41);
    let yaml = fs::read_to_string(desk.path("table.yaml")).expect("a configuration");
    for words in [
        "time_column: time",
        "attributes: [commit]",
        "column: \"bar/h=1: steps\"",
        "direction: -1",
    ] {
        assert!(yaml.contains(words), "{yaml}");
    }
    let output = proctor(&["export", "--format", "csv", &table, &table]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("found 2 records; accepted: one"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_hundred_records_of_twelve_thousand_numbers_take_little_time() {
    let desk = Desk::new();
    fs::create_dir(desk.path("records")).expect("a folder");
    // More numbers than the kept errors have.
    for commit in 0..100 {
        let mut large = record(commit, 0.1, 1.0);
        let row = |number: usize| {
            let mut row =
                json!({ "run_name": format!("case-{number}/h=1"), "name": "a", "threads": 1 });
            for counter in 0..12 {
                let error = 0.1 + (number * 13 + counter) as f64 / 3e3 + (commit / 90) as f64;
                row[format!("error_quantity_{counter}")] = json!(error);
            }
            row
        };
        large["benchmarks"] = (0..1000).map(row).collect();
        let path = desk.path(&format!("records/{commit:03}.json"));
        fs::write(path, large.to_string()).expect("a record");
    }
    let mut child = command(&["history", &desk.name("records")])
        .stdout(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut text = String::new();
    let output = child.stdout.as_mut().expect("a pipe");
    output.read_to_string(&mut text).expect("text");
    let used = child.wait4().expect("it ends").rusage;
    assert!(text.contains("100 records, 12000 numbers"), "{text}");
    // The clock says little beside other tests. Seven hundred take seven times as much, shared by the processors.
    let took = (used.utime + used.stime).as_secs_f64();
    assert!(took < 6.0, "{took} s");
    println!("100 records: {took:.2} s of processor time");
}
