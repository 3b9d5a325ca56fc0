//! A scene from standard input.

use crate::command::support::{Desk, code, command, fixture, flying_block, stderr, stdout};
use serde_json::json;
use std::io::Write;
use std::process::{Output, Stdio};

/// The command in the folder of the desk, with a text on standard input.
fn piped(desk: &Desk, arguments: &[&str], text: &[u8]) -> Output {
    let mut child = command(arguments)
        .current_dir(desk.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    // A command that refuses its arguments reads nothing: the pipe is then closed.
    let _ = child.stdin.take().expect("a pipe").write_all(text);
    child.wait_with_output().expect("it ends")
}

#[test]
fn a_scene_is_planned_run_and_asked_for_its_step_from_standard_input() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["results"]["print"] = json!(2);
    let scene = scene.to_string();
    for arguments in [
        vec!["plan", "-"],
        vec!["run", "-", "--out", "out"],
        vec!["stability", "-"],
    ] {
        let output = piped(&desk, &arguments, scene.as_bytes());
        assert_eq!(code(&output), 0, "{arguments:?}: {}", stderr(&output));
        assert!(stdout(&output).contains("stdin"), "{}", stdout(&output));
    }
    assert_eq!(desk.summary("out")["scene"], "stdin");
}

/// Files that it names are looked for in the folder in which the command is run.
#[test]
fn its_files_are_relative_to_the_current_folder() {
    let desk = Desk::new();
    let text = std::fs::read(fixture("fixtures/scenes/shaken_base_2d.json")).expect("a fixture");
    let output = piped(&desk, &["plan", "-"], &text);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("shaken_base_2d.csv"),
        "{}",
        stderr(&output)
    );
    let record = "shaken_base_2d.csv";
    let from = fixture(&format!("fixtures/scenes/{record}"));
    std::fs::copy(from, desk.path(record)).expect("a fixture");
    let output = piped(&desk, &["plan", "-"], &text);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

#[test]
fn its_faults_have_line_and_column() {
    let desk = Desk::new();
    let wrong = format!("{:#}", flying_block()).replace("\"young\"", "\"yung\"");
    let line = wrong
        .lines()
        .position(|line| line.contains("yung"))
        .expect("it is there")
        + 1;
    let output = piped(&desk, &["run", "-"], wrong.as_bytes());
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(said.starts_with(&format!("<stdin>:{line}:")), "{said}");
    assert!(said.contains("`young`"), "{said}");
    let output = piped(&desk, &["plan", "-"], b"");
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).starts_with("<stdin>:1:1: found the end of the text"),
        "{}",
        stderr(&output)
    );
}
