//! A folder of results belongs to one run at a time, and holds the frames of one run.

use crate::command::support::{Desk, code, column, command, flying_block, stderr};
use serde_json::{Value, json};
use std::fs;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// The flying block with so many outputs.
fn with_outputs(outputs: u32) -> Value {
    let mut scene = flying_block();
    scene["results"]["print"] = json!(outputs);
    scene
}

/// Names of the frames in a folder, and those that its list names.
fn frames(desk: &Desk, out: &str) -> [Vec<String>; 2] {
    let entries = fs::read_dir(desk.path(out)).expect("a folder");
    let names = entries.map(|entry| {
        entry
            .expect("an entry")
            .file_name()
            .into_string()
            .expect("text")
    });
    let mut there: Vec<String> = names
        .filter(|name| name.starts_with("particles_"))
        .collect();
    there.sort();
    let list = fs::read_to_string(desk.path(out).join("particles.pvd")).expect("a list");
    let listed = list.split("file=\"").skip(1);
    let listed = listed.map(|rest| rest.split('"').next().unwrap_or_default().to_owned());
    [there, listed.collect()]
}

/// A run that ends with its test, however that ends.
struct AtWork(Child);

impl Drop for AtWork {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A run for minutes, at work.
fn at_work(desk: &Desk, out: &str) -> AtWork {
    let mut scene = column(&json!({}));
    scene["time"] = json!(4000.0);
    scene["results"]["print"] = json!(999_999);
    let scene = desk.scene("endless.json", &scene);
    let child = command(&["run", &scene, "--out", &desk.name(out)])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("starts");
    let child = AtWork(child);
    let start = Instant::now();
    while !desk.path(out).join("particles_000002.vtu").exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no frame");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

#[test]
fn a_second_run_into_the_same_folder_is_refused() {
    let desk = Desk::new();
    let mut first = at_work(&desk, "out");
    let scene = desk.scene("scene.json", &flying_block());
    let output = desk.run(&scene, "out", &[]);
    let message = stderr(&output);
    assert_eq!(code(&output), 2, "{message}");
    assert!(
        message.contains("is in use") && message.contains("out"),
        "{message}"
    );
    assert!(
        first.0.try_wait().expect("asked").is_none(),
        "the first goes on"
    );
    // The system lets go of the folder when the process ends, however it ends.
    drop(first);
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let [there, listed] = frames(&desk, "out");
    assert_eq!(there, listed);
    assert_eq!(there.len(), 9);
}

#[test]
fn frames_of_an_earlier_run_do_not_stay_among_the_new_ones() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &with_outputs(40));
    assert_eq!(code(&desk.run(&scene, "out", &[])), 0);
    assert_eq!(frames(&desk, "out")[0].len(), 41);
    fs::write(desk.path("out").join("notes.txt"), "mine").expect("written");
    let scene = desk.scene("scene.json", &with_outputs(5));
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let [there, listed] = frames(&desk, "out");
    assert_eq!(there, listed);
    assert_eq!(there.len(), 6);
    assert!(desk.path("out").join("notes.txt").exists());
}

#[test]
fn frames_that_no_list_names_are_refused_and_stay() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &with_outputs(5));
    assert_eq!(code(&desk.run(&scene, "out", &[])), 0);
    let stray = desk.path("out").join("particles_000240.vtu");
    fs::write(&stray, "somebody's").expect("written");
    let before = frames(&desk, "out");
    let output = desk.run(&scene, "out", &[]);
    let message = stderr(&output);
    assert_eq!(code(&output), 2, "{message}");
    assert!(message.contains("particles_000240.vtu"), "{message}");
    assert_eq!(frames(&desk, "out"), before);
    // A restart goes on with what is there, and leaves alone what is not its own.
    let checkpoint = desk
        .path("out")
        .join("checkpoint.bin")
        .display()
        .to_string();
    let output = desk.run(&scene, "out", &["--restart", &checkpoint]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stray.exists());
}
