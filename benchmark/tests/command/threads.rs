//! The number of threads that a user may ask for.

use crate::command::support::{Desk, code, flying_block, proctor, stderr};
use serde_json::json;

fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

#[test]
fn more_than_four_threads_for_each_processor_are_refused() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &flying_block());
    let most = 4 * processors();
    let (many, out) = ((most + 1).to_string(), desk.name("out"));
    let attempts: [&[&str]; 4] = [
        &["run", &scene, "--out", &out, "--threads", &many],
        &["verify", "bar", "--quick", "--threads", &many],
        &["precision", "bar", "--quick", "--threads", &many],
        &["bench", "--quick", "--threads", &many],
    ];
    for arguments in attempts {
        let output = proctor(arguments);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{arguments:?}: {message}");
        assert!(
            message.contains(&format!(
                "--threads: found {many} threads; accepted: at most {most}"
            )),
            "{message}"
        );
    }
    assert!(!desk.path("out").exists());
    // What the scene asks for, unless the command line says otherwise.
    let mut greedy = flying_block();
    greedy["n_threads"] = json!(most + 1);
    let greedy = desk.scene("greedy.json", &greedy);
    let output = proctor(&["run", &greedy]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("greedy.json: n_threads: found"),
        "{}",
        stderr(&output)
    );
    let output = proctor(&["run", &greedy, "--threads", "1", "--out", &desk.name("out")]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn more_threads_than_processors_are_told() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &flying_block());
    let more = (processors() + 1).to_string();
    let output = proctor(&["run", &scene, "--threads", &more]);
    let message = stderr(&output);
    assert_eq!(code(&output), 0, "{message}");
    assert!(
        message.contains(&format!(
            "warning: --threads: {more} threads on a machine that runs"
        )),
        "{message}"
    );
    let output = proctor(&[
        "run",
        &scene,
        "--threads",
        &processors().to_string(),
        "--out",
        &desk.name("out"),
    ]);
    assert_eq!(stderr(&output), "");
}
