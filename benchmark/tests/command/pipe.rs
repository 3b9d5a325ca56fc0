//! A reader that goes away is no failure, and a message that nobody can read changes no exit code.

use crate::command::support::{Desk, command, fixture, flying_block, leaving_block};
use serde_json::json;
use std::fs::File;
use std::io::Read;
use std::process::Stdio;

#[test]
fn a_closed_pipe_is_no_failure() {
    let scene = fixture("fixtures/scenes/manual/boussinesq.json");
    for arguments in [vec!["schema"], vec!["plan", &scene], vec!["run", &scene]] {
        let mut child = command(&arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        // Closed before anything is read.
        drop(child.stdout.take());
        let mut complaint = String::new();
        let stderr = child.stderr.as_mut().expect("piped");
        stderr.read_to_string(&mut complaint).expect("text");
        assert_eq!(child.wait().expect("ends").code(), Some(0), "{arguments:?}");
        // What a run without a folder says before it starts is no complaint.
        let complaint = complaint
            .lines()
            .find(|line| !line.starts_with("nothing will be written"));
        assert_eq!(complaint, None, "{arguments:?}");
    }
}

/// Verbs with something to say on standard error, and the exit code of each.
fn verdicts(desk: &Desk) -> Vec<(Vec<String>, i32)> {
    let fine = desk.scene("fine.json", &flying_block());
    let failing = desk.scene("failing.json", &leaving_block());
    let mut warned = flying_block();
    warned["stress_scheme_update"] = json!("USL");
    warned["shape_function"] = json!("linear");
    let warned = desk.scene("warned.json", &warned);
    let bench = desk.scene(
        "bench.json",
        &json!({ "scenes": "rest-2d", "particles": 100, "threads": 1, "particle_steps": 300, "stages": [] }),
    );
    let run = |scene: &str| vec!["run".to_owned(), scene.to_owned()];
    vec![
        (run(&fine), 0),
        (run(&warned), 0),
        (run(&failing), 1),
        (run("no/such/scene.json"), 2),
        (vec!["plan".into(), "no/such/scene.json".into()], 2),
        (vec!["bench".into(), bench, "--log".into()], 0),
        (
            vec!["compare".into(), "no.json".into(), "no.json".into()],
            2,
        ),
        (vec!["--no-such-option".into()], 2),
    ]
}

#[test]
fn the_exit_code_is_that_of_the_verdict_when_nobody_reads_standard_error() {
    let desk = Desk::new();
    for (arguments, code) in verdicts(&desk) {
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let mut child = command(&words)
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        drop(child.stderr.take());
        assert_eq!(child.wait().expect("ends").code(), Some(code), "{words:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_error_changes_no_exit_code() {
    let desk = Desk::new();
    for (arguments, code) in verdicts(&desk) {
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let full = File::options()
            .write(true)
            .open("/dev/full")
            .expect("Linux has it");
        let status = command(&words)
            .stdout(Stdio::null())
            .stderr(full)
            .status()
            .expect("starts");
        assert_eq!(status.code(), Some(code), "{words:?}");
    }
}

#[cfg(unix)]
#[test]
fn closed_streams_change_no_exit_code() {
    let desk = Desk::new();
    for (arguments, code) in verdicts(&desk) {
        for closed in ["2>&-", ">&-", "<&- >&- 2>&-"] {
            let status = std::process::Command::new("sh")
                .arg("-c")
                .arg(format!("exec \"$@\" {closed}"))
                .arg("sh")
                .arg(env!("CARGO_BIN_EXE_proctor"))
                .args(&arguments)
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status()
                .expect("starts");
            assert_eq!(status.code(), Some(code), "{arguments:?} {closed}");
        }
    }
}

/// The output is lost, which is a failure of its own; but no panic.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_said_and_ends_with_1() {
    let full = || {
        File::options()
            .write(true)
            .open("/dev/full")
            .expect("Linux has it")
    };
    let output = command(&["schema"])
        .stdout(full())
        .output()
        .expect("starts");
    assert_eq!(output.status.code(), Some(1));
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(complaint.contains("standard output"), "{complaint}");
    let status = command(&["schema"])
        .stdout(full())
        .stderr(full())
        .status()
        .expect("starts");
    assert_eq!(status.code(), Some(1));
}
