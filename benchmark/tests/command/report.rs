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
    // One verdict: the banner is that of the card.
    let (_, banner) = page.split_once("role=\"status\">").expect("a banner");
    assert!(
        banner.starts_with("<strong>WORSE</strong>"),
        "{}",
        &banner[..80]
    );
}

/// Both name the time on the processors, and have one number of it.
#[test]
fn page_and_terminal_tell_one_time_and_name_its_kind() {
    let desk = Desk::new();
    let config = json!({
        "scenes": "rest-2d", "particles": 400, "threads": 1, "stages": [], "repetitions": 3,
        "particle_steps": 4000,
    });
    let (config, json) = (desk.scene("bench.json", &config), desk.name("b.json"));
    let output = proctor(&["bench", &config, "--json", &json]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let terminal = stdout(&output);
    let record = fs::read_to_string(&json).expect("a record");
    let record: serde_json::Value = serde_json::from_str(&record).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows");
    let steps = rows.iter().filter(|row| row["stage"] == "step");
    let mut times: Vec<f64> = steps
        .filter_map(|row| row["cpu_ns_per_particle_step"].as_f64())
        .collect();
    times.sort_by(f64::total_cmp);
    assert_eq!(times.len(), 3, "{terminal}");
    let line = terminal.lines().find(|line| line.contains("CPU ns"));
    let heads: Vec<&str> = line
        .expect("a head")
        .split("  ")
        .map(str::trim)
        .filter(|w| !w.is_empty())
        .collect();
    let place = heads
        .iter()
        .position(|head| *head == "CPU ns")
        .expect("a column");
    let line = terminal
        .lines()
        .find(|line| line.trim().starts_with("rest-2d"));
    let cells: Vec<&str> = line
        .expect("a line")
        .split("  ")
        .map(str::trim)
        .filter(|w| !w.is_empty())
        .collect();
    let told: f64 = cells[place].parse().expect("a number");
    assert!((told / times[1] - 1.0).abs() < 0.05, "{told} {times:?}");
    let page = desk.name("b.html");
    assert_eq!(code(&proctor(&["report", &json, "--out", &page])), 0);
    let page = fs::read_to_string(page).expect("a page");
    let (_, speed) = page
        .split_once(">Speed</a></dt><dd><strong>")
        .expect("a speed");
    let (number, words) = speed.split_once("</strong>").expect("a number");
    let number: f64 = number
        .split(' ')
        .next()
        .and_then(|n| n.parse().ok())
        .expect("a number");
    assert!((number / times[1] - 1.0).abs() < 0.05, "{number} {times:?}");
    assert!(words.starts_with(" of processor time"), "{}", &words[..60]);
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
