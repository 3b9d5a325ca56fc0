//! The list of steps that CI left out, and the history of the kept numbers.

use crate::command::support::{Desk, fixture};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

#[test]
fn a_step_that_is_left_out_fails_in_ci_unless_it_may_be() {
    let desk = Desk::new();
    let (left, allowed) = (desk.name("left"), desk.name("allowed"));
    let judged = |lines: &str, list: &str, ci: bool| {
        fs::write(&left, lines).expect("written");
        fs::write(&allowed, list).expect("written");
        let mut command = Command::new("bash");
        command.args([&fixture("scripts/left-out"), &left, &allowed]);
        if ci {
            command.env("CI", "true");
        } else {
            command.env_remove("CI");
        }
        let output = command.output().expect("bash runs");
        (output.status.code().expect("an end"), said(&output))
    };
    assert_eq!(judged("", "", true), (0, "left out: nothing\n".to_owned()));
    let (status, text) = judged("vtk: not there\n", "# vtk: no\n", true);
    assert_eq!(status, 1, "{text}");
    assert!(text.contains("LEFT OUT: vtk: not there"), "{text}");
    // A name without a reason is none.
    assert_eq!(judged("vtk: not there\n", "vtk:\n", true).0, 1);
    let (status, text) = judged("vtk: not there\n", "vtk: no wheels for it\n", true);
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("(allowed: no wheels for it)"), "{text}");
    let (status, text) = judged("vtk: not there\n", "", false);
    assert_eq!((status, text.as_str()), (0, "left out: vtk: not there\n"));
    let (status, text) = judged("vtk: a\nnm: b\n", "vtk: no wheels\n", true);
    assert_eq!(status, 1, "{text}");
}

/// A repository with what is kept, and the script that goes through its history.
struct Project {
    desk: Desk,
}

impl Project {
    fn new() -> Self {
        let project = Self { desk: Desk::new() };
        for folder in ["scripts", "fixtures/expected"] {
            fs::create_dir_all(project.desk.path(folder)).expect("a folder");
        }
        let script = fixture("scripts/check-history");
        fs::copy(script, project.desk.path("scripts/check-history")).expect("copied");
        project.git(&["init", "--quiet"]);
        project
    }

    fn git(&self, arguments: &[&str]) {
        let output = Command::new("git")
            .args(["-c", "user.name=a", "-c", "user.email=a@b", "-C"])
            .arg(self.desk.path("."))
            .args(arguments)
            .output();
        let output = output.expect("git runs");
        assert!(output.status.success(), "{}", said(&output));
    }

    /// Keeps a record with this error, and these lines of the ledger.
    fn keep(&self, error: f64, lines: &[&str]) {
        let folder = Path::new("fixtures/expected");
        let record: Value = json!({
            "context": { "schema_version": 1, "library_build_type": "release", "ladders": "quick" },
            "benchmarks": [{
                "name": "bar", "run_type": "iteration", "repetition_index": 0, "iterations": 0,
                "error_l2": error, "gate_bound": 0.5
            }]
        });
        let write = |name: &str, text: String| {
            fs::write(self.desk.path(".").join(folder).join(name), text).expect("written");
        };
        write("errors.json", record.to_string());
        let head = "ladder,case,number,from,to,what,reason,commit\n";
        let lines: Vec<String> = lines.iter().map(|line| format!("{line}\n")).collect();
        write("accepted.csv", format!("{head}{}", lines.concat()));
    }

    fn commit(&self) {
        self.git(&["add", "--all"]);
        self.git(&["commit", "--quiet", "--message", "a change"]);
    }

    fn check(&self) -> (i32, String) {
        let output = Command::new("bash")
            .arg(self.desk.path("scripts/check-history"))
            .arg(env!("CARGO_BIN_EXE_proctor"))
            .output()
            .expect("bash runs");
        (output.status.code().expect("an end"), said(&output))
    }
}

#[test]
fn every_commit_that_moved_a_number_says_why() {
    let better = "quick,bar,error_l2,0.2,0.1,better,a better rule,0123456789";
    let worse = "quick,bar,error_l2,0.1,0.15,worse,it was wrong,0123456789";
    let project = Project::new();
    project.keep(0.2, &[]);
    project.commit();
    assert_eq!(project.check().0, 0, "{}", project.check().1);
    project.keep(0.1, &[better]);
    project.commit();
    project.keep(0.15, &[better, worse]);
    project.commit();
    let (status, text) = project.check();
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("3 comparisons"), "{text}");
    // A new baseline without a line, not committed yet, then committed, and then with another commit after it.
    project.keep(0.151, &[better, worse]);
    let (status, text) = project.check();
    assert_eq!(status, 1, "{text}");
    assert!(text.contains("without a line in the ledger"), "{text}");
    project.commit();
    assert_eq!(project.check().0, 1);
    fs::write(project.desk.path("other"), "").expect("written");
    project.commit();
    assert_eq!(project.check().0, 1);
}

#[test]
fn a_ledger_that_lost_a_line_is_seen() {
    let better = "quick,bar,error_l2,0.2,0.1,better,a better rule,0123456789";
    let project = Project::new();
    project.keep(0.2, &[]);
    project.commit();
    project.keep(0.1, &[better]);
    project.commit();
    project.keep(0.1, &[]);
    project.commit();
    let (status, text) = project.check();
    assert_eq!(status, 1, "{text}");
    assert!(text.contains("it may only grow at its end"), "{text}");
}
