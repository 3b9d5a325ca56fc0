//! `proctor compare` and `proctor report` on the folders of runs.

use super::picture::falling;
use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::json;
use std::fs;

/// A desk with two equal runs, one with half the stiffness, and one of another scene.
fn with_runs() -> Desk {
    let desk = Desk::new();
    let scene = desk.scene("fall.json", &falling(2));
    for out in ["a", "b"] {
        assert_eq!(code(&desk.run(&scene, out, &[])), 0);
    }
    let mut soft = falling(2);
    soft["material"][0]["young"] = json!(5e4);
    soft["results"]["print"] = json!(5);
    let soft = desk.scene("soft.json", &soft);
    assert_eq!(code(&desk.run(&soft, "soft", &[])), 0);
    let other = desk.scene("solid.json", &falling(3));
    assert_eq!(code(&desk.run(&other, "solid", &[])), 0);
    desk
}

#[test]
fn equal_runs_are_the_same_bit_by_bit() {
    let desk = with_runs();
    let output = proctor(&["compare", &desk.name("a"), &desk.name("b")]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    assert!(
        text.contains("the states at the end are the same bit by bit; all"),
        "{text}"
    );
    assert!(!text.contains("differs"), "{text}");
}

#[test]
fn runs_that_differ_are_shown_with_the_largest_differences() {
    let desk = with_runs();
    let [a, soft] = ["a", "soft"].map(|name| desk.name(name));
    let output = proctor(&["compare", &a, &soft]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("\"soft\", not \"fall\""),
        "{}",
        stderr(&output)
    );
    assert!(
        stderr(&output).contains("--any-scene"),
        "{}",
        stderr(&output)
    );
    let output = proctor(&["compare", &a, &soft, "--any-scene"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in [
        "largest difference",
        "corner_syy",
        "strain_energy",
        "linear between its rows",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let page = desk.name("both.html");
    let output = proctor(&["report", &a, &soft, "--any-scene", "--out", &page]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let page = fs::read_to_string(page).expect("a page");
    for words in [
        "How they ended",
        "Differences from a",
        "corner: displacement",
        "strain energy (J)",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let output = proctor(&["report", &a]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(desk.path("a/report.html").is_file());
}

#[test]
fn runs_that_cannot_be_compared_are_refused_by_name() {
    let desk = with_runs();
    let a = desk.name("a");
    fs::remove_file(desk.path("b/summary.json")).expect("a summary");
    let mut stopped = desk.summary("soft");
    stopped["status"] = json!("interrupted");
    fs::write(desk.path("soft/summary.json"), stopped.to_string()).expect("a summary");
    fs::create_dir(desk.path("empty")).expect("a folder");
    for (other, words) in [
        ("b", "no summary.json, which a run writes when it ends"),
        ("soft", "a run that was interrupted at 0.05 s"),
        ("solid", "in 3 dimensions, not 2"),
        ("empty", "no other file of a run"),
        ("none", "no other file of a run"),
    ] {
        for verb in ["compare", "report"] {
            let output = proctor(&[verb, &a, &desk.name(other), "--any-scene"]);
            assert_eq!(code(&output), 2, "{verb} {other}");
            let text = stderr(&output);
            assert!(
                text.contains(words) && text.contains(&desk.name(other)),
                "{text}"
            );
        }
    }
    fs::remove_file(desk.path("solid/history.csv")).expect("a history");
    let output = proctor(&["report", &desk.name("solid")]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("no history.csv"),
        "{}",
        stderr(&output)
    );
    let output = proctor(&["report", &a, "--mill", "mill.json"]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("for records"),
        "{}",
        stderr(&output)
    );
}
