//! The script of the action that a foreign project has in its CI, and a warm-up for solvers that compile their kernels.

use crate::command::guests::found;
use crate::command::support::{Desk, code, command, fixture, proctor, stderr, stdout};
use serde_json::json;
use std::fs;
use std::process::{Command, Output};

/// `scripts/judge-solver` on one case in a folder of its own.
fn judged(desk: &Desk, arguments: &[&str]) -> Output {
    let mut all = vec![
        "--proctor",
        env!("CARGO_BIN_EXE_proctor"),
        "--cases",
        "sudden-weight",
    ];
    all.extend(arguments);
    let out = desk.name("ci");
    let mut command = Command::new("bash");
    command.arg(fixture("scripts/judge-solver"));
    command
        .arg(desk.name("proctor.json"))
        .args(all)
        .args(["--out", &out]);
    command.env("GITHUB_STEP_SUMMARY", desk.name("step-summary.md"));
    command.output().expect("bash runs")
}

/// One run of a case by the executables of a configuration, whose name follows.
const STEP_BAR: [&str; 6] = [
    "precision",
    "step-bar",
    "--quick",
    "--repetitions",
    "1",
    "--executables",
];

/// A solver that takes another Young's modulus in all but the free fall.
fn softer(desk: &Desk, young: &str) {
    let script = format!(
        "case $1 in *calibration*) $0 run $1 --out $2;; *) sed 's/\"young\": 10000000.0/\"young\": {young}/' $1 > $2/s.json; \
         $0 run $2/s.json --out $2;; esac"
    );
    let config = json!({ "executables": { "toy": {
        "command": ["sh", "-c", script, env!("CARGO_BIN_EXE_proctor"), "{scene}", "{out}"],
    }}});
    desk.scene("proctor.json", &config);
}

#[test]
fn the_script_of_the_action_leaves_summary_junit_badge_and_page_and_sees_a_thousandth() {
    let desk = Desk::new();
    softer(&desk, "10000000.0");
    let output = judged(&desk, &["--bounds", "sudden-weight=1%"]);
    let said = format!("{}{}", stdout(&output), stderr(&output));
    assert_eq!(code(&output), 0, "{said}");
    let read =
        |name: &str| fs::read_to_string(desk.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    for (file, words) in [
        ("ci/summary.md", "### Proctor: PASS, 1 of 1 gates hold"),
        (
            "ci/junit.xml",
            "<testsuite name=\"toy/sudden-weight\" tests=\"1\" failures=\"0\"",
        ),
        ("ci/badge.json", "1 of 1 gates hold"),
        ("ci/report.html", "toy"),
        ("step-summary.md", "sudden-weight"),
    ] {
        assert!(read(file).contains(words), "{file}: {}", read(file));
    }
    // A loss of a thousandth is seen: with Young's modulus so much smaller the error is twice and a half as large.
    fs::copy(desk.path("ci/record.json"), desk.path("base.json")).expect("a base");
    let base = desk.name("base.json");
    let output = judged(&desk, &["--bounds", "sudden-weight=1%", "--base", &base]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    softer(&desk, "9990000.0");
    let output = judged(&desk, &["--bounds", "sudden-weight=1%", "--base", &base]);
    let said = format!("{}{}", stdout(&output), stderr(&output));
    assert_eq!(code(&output), 1, "{said}");
    assert!(read("ci/comparison.md").contains("WORSE"), "{said}");
    // A bound that does not hold fails the job, and its test.
    let output = judged(&desk, &["--bounds", "sudden-weight=0.1%"]);
    assert_eq!(code(&output), 1, "{}", stdout(&output));
    assert!(read("ci/junit.xml").contains("failures=\"1\""));
    let output = judged(&desk, &["--base", "/none.json"]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
}

/// Kernels are compiled in a run that is not timed.
#[test]
fn a_warm_up_is_a_run_of_each_scene_more() {
    let desk = Desk::new();
    let log = desk.name("runs");
    let script = format!("echo $1 >> {log}; exec $0 run $1 --out $2");
    let runs = |warm_up: bool| {
        let _ = fs::remove_file(&log);
        let command = json!([
            "sh",
            "-c",
            script,
            env!("CARGO_BIN_EXE_proctor"),
            "{scene}",
            "{out}"
        ]);
        let guest = json!({ "command": command, "warm_up": warm_up });
        let config = desk.scene("guests.json", &json!({ "executables": { "jit": guest } }));
        let output = proctor(&[&STEP_BAR[..], &[&config]].concat());
        assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
        let log = fs::read_to_string(&log).expect("runs");
        log.lines()
            .filter(|line| !line.contains("calibration"))
            .count()
    };
    assert_eq!((runs(false), runs(true)), (3, 6));
}

#[test]
fn a_format_that_there_is_not_is_refused_with_the_list() {
    let output = proctor(&["export", "--format", "junitt", "record.json"]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    let formats = [
        "bmf", "github", "critcmp", "csv", "gates", "junit", "summary", "badge", "problems",
        "book", "otava",
    ];
    for format in formats {
        assert!(said.contains(format), "{format}: {said}");
    }
    assert_eq!(stdout(&output), "");
}

/// Two programs that are built, fewer pairs than are judged, and a name that is neither.
#[test]
fn commits_are_compared_in_no_fewer_pairs_than_are_judged() {
    let script = fixture("scripts/compare-commits");
    let said = |arguments: &[&str]| {
        let output = Command::new("bash").arg(&script).args(arguments).output();
        let output = output.expect("bash runs");
        (code(&output), stderr(&output))
    };
    let program = env!("CARGO_BIN_EXE_proctor");
    let (exit, text) = said(&["--pairs", "3", program, program]);
    assert_eq!(exit, 2, "{text}");
    assert!(
        text.contains("found 3 pairs; accepted: a number from 10 to 999"),
        "{text}"
    );
    let (exit, text) = said(&[program, program]);
    assert_eq!(exit, 2, "{text}");
    assert!(text.contains("are the same"), "{text}");
    let (exit, text) = said(&[program, "/none/proctor"]);
    assert_eq!(exit, 2, "{text}");
    assert!(
        text.contains("neither a commit of this repository nor a program"),
        "{text}"
    );
}

#[test]
fn runs_are_told_in_eighty_columns_and_tractions_lie_beside_loads_on_nodes() {
    let desk = Desk::new();
    let config = desk.scene(
        "guests.json",
        &json!({ "executables": { "same": env!("CARGO_BIN_EXE_proctor") } }),
    );
    let keep = desk.name("kept");
    let output = proctor(&[&STEP_BAR[..], &[&config, "--keep", &keep]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let tractions = found(&desk.path("kept/step-bar"), "tractions.csv");
    assert_eq!(tractions.len(), 3);
    let text = fs::read_to_string(&tractions[0]).expect("a table");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0].len(), 9, "{text}");
    // The end of the bar, along which it is pressed alone.
    assert_eq!(
        (rows[1][0], rows[1][3], rows[1][7]),
        ("1", "1", "0"),
        "{text}"
    );
    let scene = found(&desk.path("kept/step-bar"), "scene.json");
    let out = desk.name("out");
    let mut run = command(&["run", &scene[0].display().to_string(), "--out", &out]);
    let output = run.output().expect("it runs");
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output).replace(&out, "out");
    assert!(text.contains("time step"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}
