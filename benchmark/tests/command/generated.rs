//! `proctor verify --generated`.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::Value;

/// A few scenes: a table with every question, a verdict, a result; the scene of each violation is one that runs.
#[test]
fn generated_scenes_are_judged_and_violations_are_scenes_that_run() {
    let desk = Desk::new();
    let (result, folder) = (desk.name("result.json"), desk.name("violations"));
    let output = proctor(&[
        "verify",
        "--generated",
        "40",
        "--seed",
        "3",
        "--json",
        &result,
        "--out",
        &folder,
    ]);
    let text = std::fs::read_to_string(result).expect("a result");
    let result: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(result["scenes"], 40);
    let questions = result["questions"].as_array().expect("questions");
    let total: u64 = questions.iter().filter_map(|q| q["scenes"].as_u64()).sum();
    assert_eq!(total, 40);
    for question in questions {
        let name = question["question"].as_str().expect("a name");
        assert!(stdout(&output).contains(name), "{name}");
    }
    let violations = result["violations"].as_array().expect("violations");
    assert_eq!(
        code(&output),
        i32::from(!violations.is_empty()),
        "{}",
        stderr(&output)
    );
    for (k, violation) in violations.iter().enumerate() {
        let scene = violation["scene"].as_str().expect("a scene file");
        assert!(stdout(&output).contains(scene), "{}", stdout(&output));
        let run = desk.run(scene, &format!("run {k}"), &[]);
        assert_eq!(code(&run), 0, "{scene}: {}", stderr(&run));
    }
}

#[test]
fn the_same_seed_gives_the_same_verdict() {
    let run = |threads| {
        let output = proctor(&[
            "verify",
            "--generated",
            "11",
            "--seed",
            "5",
            "--threads",
            threads,
        ]);
        stdout(&output)
    };
    assert_eq!(run("1"), run("2"));
}

#[test]
fn cases_and_generated_scenes_do_not_mix() {
    for arguments in [
        &["verify", "boussinesq", "--generated", "5"][..],
        &["verify", "--generated", "0"],
        &["verify", "--seed", "5"],
    ] {
        assert_eq!(code(&proctor(arguments)), 2, "{arguments:?}");
    }
}
