//! `proctor report`: the page of a record, and of two.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// A desk with a short record of the bar, and one in which an error has grown by half.
fn with_records() -> Desk {
    let desk = Desk::new();
    let base = desk.name("base.json");
    let output = proctor(&["verify", "bar", "--quick", "--json", &base]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(desk.path("base.json")).expect("a record");
    let mut head: Value = serde_json::from_str(&text).expect("JSON");
    let rows = head["benchmarks"].as_array_mut().expect("rows");
    let row = rows.iter_mut().find(|row| row["error_l2_u"].is_number());
    let row = row.expect("a row with an error");
    row["error_l2_u"] = json!(1.5 * row["error_l2_u"].as_f64().expect("a number"));
    desk.scene("head.json", &head);
    desk
}

#[test]
fn a_base_shows_what_got_worse_in_the_words_of_compare() {
    let desk = with_records();
    let [base, head] = ["base.json", "head.json"].map(|name| desk.name(name));
    let output = proctor(&["report", &head, "--base", &base]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let compared = stdout(&proctor(&["compare", &base, &head]));
    let verdict = compared.lines().last().expect("a verdict");
    assert!(verdict.starts_with("WORSE"), "{verdict}");
    assert!(stdout(&output).contains(verdict), "{}", stdout(&output));
    let page = fs::read_to_string(desk.path("head.html")).expect("a page");
    assert!(page.contains(verdict) && page.contains(">+50.0 %<"));
}

#[test]
fn a_base_that_is_none_and_a_page_over_a_record_are_refused() {
    let desk = with_records();
    let [base, head] = ["base.json", "head.json"].map(|name| desk.name(name));
    let output = proctor(&["report", &head, "--base", &desk.name("none.json")]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("none.json"));
    assert!(!desk.path("head.html").exists());
    let before = fs::read(desk.path("base.json")).expect("a record");
    let output = proctor(&["report", &head, "--base", &base, "--out", &base]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("the page would replace a record"));
    assert_eq!(fs::read(desk.path("base.json")).expect("a record"), before);
}
