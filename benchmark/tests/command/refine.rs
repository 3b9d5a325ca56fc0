//! `proctor refine`, and `proctor verify refine` that judges its bars.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};

#[test]
fn the_rule_keeps_its_bounds_on_the_kept_ladders() {
    let ladders = fixture("fixtures/expected/full.json");
    let output = proctor(&["verify", "refine", "--ladders", &ladders]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    for word in ["held out", "by case", "PASS: 0 of 4 gates miss"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
}

#[test]
fn a_record_without_ladders_is_refused() {
    let desk = Desk::new();
    let missing = desk.name("none.json");
    let output = proctor(&["verify", "refine", "--ladders", &missing]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("--ladders FILE"),
        "{}",
        stderr(&output)
    );
    let output = proctor(&["verify", "--ladders", &missing]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("without `refine`"),
        "{}",
        stderr(&output)
    );
}
