//! Whatever is handed to the command: exit code 0, 1 or 2, and a message where it is not 0.

use crate::command::support::{Desk, flying_block, stderr};
use serde_json::{Value, json};
use std::fs;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Longer than any of these takes.
const PATIENCE: Duration = Duration::from_secs(100);

/// Runs the command with little address space, and ends it where it does not end.
fn outcome(arguments: &[&str]) -> Output {
    let mut child = Command::new("sh")
        .arg("-c")
        .arg("ulimit -v 2000000 2>/dev/null; exec \"$@\"")
        .arg("sh")
        .arg(env!("CARGO_BIN_EXE_proctor"))
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let begun = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if begun.elapsed() > PATIENCE {
            child.kill().expect("it runs");
            panic!("{arguments:?} does not end");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().expect("it has ended")
}

fn is_kept(arguments: &[&str], what: &str) {
    let output = outcome(arguments);
    let message = stderr(&output);
    let code = output.status.code();
    assert!(
        matches!(code, Some(0..=2)),
        "{what}: {:?}, {message}",
        output.status
    );
    assert!(
        code == Some(0) || !message.trim().is_empty(),
        "{what}: {code:?} without a message"
    );
    assert!(!message.contains("panicked"), "{what}: {message}");
}

/// Values that are wrong nearly everywhere.
fn extremes() -> Vec<Value> {
    vec![
        json!(null),
        json!(true),
        json!("x"),
        json!([]),
        json!({}),
        json!(0),
        json!(-1),
        json!(1e308),
        json!(5e-324),
        json!(u64::MAX),
        json!([[[[]]]]),
        json!([1e308, 1e308]),
        json!([u64::MAX, u64::MAX]),
    ]
}

/// Pointers to all values of a text.
fn pointers(value: &Value, at: &str, all: &mut Vec<String>) {
    all.push(at.to_owned());
    match value {
        Value::Array(list) => {
            for (i, entry) in list.iter().enumerate() {
                pointers(entry, &format!("{at}/{i}"), all);
            }
        }
        Value::Object(map) => {
            for (key, entry) in map {
                pointers(entry, &format!("{at}/{key}"), all);
            }
        }
        _ => {}
    }
}

#[test]
fn a_scene_with_any_value_anywhere_is_planned_or_refused() {
    let desk = Desk::new();
    let base = flying_block();
    let mut all = vec![];
    pointers(&base, "", &mut all);
    let extremes = extremes();
    // Every place with one of the values, every value at some place.
    for (i, pointer) in all.iter().enumerate() {
        for extreme in [
            &extremes[i % extremes.len()],
            &extremes[(5 * i + 7) % extremes.len()],
        ] {
            let mut scene = base.clone();
            *scene.pointer_mut(pointer).expect("it is there") = extreme.clone();
            let scene = desk.scene("scene.json", &scene);
            is_kept(&["plan", &scene], &format!("{extreme} at {pointer}"));
        }
    }
}

#[test]
fn a_file_of_any_bytes_is_refused_by_every_verb_that_reads_one() {
    let desk = Desk::new();
    let sound = serde_json::to_vec(&flying_block()).expect("JSON");
    let files: Vec<Vec<u8>> = vec![
        vec![],
        vec![0; 1000],
        vec![0xff; 1000],
        b"[".repeat(100_000),
        b"{\"a\":".repeat(100_000),
        b"\"".to_vec(),
        b"null".to_vec(),
        b"1e999999999".to_vec(),
        sound[..sound.len() / 2].to_vec(),
        [b"\xef\xbb\xbf".as_slice(), &sound[..sound.len() - 1]].concat(),
    ];
    let name = desk.name("file");
    for (i, bytes) in files.iter().enumerate() {
        fs::write(&name, bytes).expect("written");
        for verb in [
            vec!["run", &name],
            vec!["plan", &name],
            vec!["bench", &name],
            vec!["report", &name],
            vec!["compare", &name, &name],
            vec!["export", &name],
        ] {
            let output = outcome(&verb);
            assert_eq!(
                output.status.code(),
                Some(2),
                "file {i}, {verb:?}: {}",
                stderr(&output)
            );
            assert!(!stderr(&output).trim().is_empty(), "file {i}, {verb:?}");
        }
    }
}

#[test]
fn a_configuration_with_any_value_anywhere_is_measured_or_refused() {
    let desk = Desk::new();
    let base = json!({
        "scenes": ["rest-2d"], "particles": [64], "threads": [1], "repetitions": 3, "warm_up": 0,
        "particle_steps": 100, "stages": [], "shape_function": "uGIMP", "stress_scheme_update": ["USL"],
        "transfer": "FLIP", "executables": { "x": { "command": ["true", "{scene}"], "folder": ".", "timeout": 9 } }
    });
    let mut all = vec![];
    pointers(&base, "", &mut all);
    let extremes = extremes();
    for (i, pointer) in all.iter().enumerate() {
        let extreme = &extremes[(3 * i + 1) % extremes.len()];
        let mut config = base.clone();
        *config.pointer_mut(pointer).expect("it is there") = extreme.clone();
        // Without a number of particles there are many, and it takes its time.
        if config.get("particles").is_some() {
            config["particle_steps"] = json!(100);
            let config = desk.scene("bench.json", &config);
            let output = outcome(&["bench", &config, "--quick"]);
            assert!(
                matches!(output.status.code(), Some(0..=2)),
                "{extreme} at {pointer}: {:?}, {}",
                output.status,
                stderr(&output)
            );
        }
    }
}
