//! The parts below the first screen: what is folded, what is open, titles, links, reasons.

use super::made_up::{MadeUp, between};
use std::collections::BTreeSet;

fn whole() -> MadeUp {
    MadeUp::new()
        .with_case("bar", 0.004, 0.01)
        .with_case("beam", 0.02, 0.01)
        .with_failed_study("bar", "no equilibrium in 1600 steps")
}

#[test]
fn a_case_that_fails_is_open_and_named_and_the_others_are_folded() {
    let page = whole().page();
    assert!(page.contains("<strong>FAIL</strong> 1 of 2 gates hold"));
    assert!(page.contains("Failed: <a href=\"#case-beam\">beam</a>."));
    assert!(page.contains("<details class=\"case failed\" id=\"case-beam\" open>"));
    assert!(page.contains("<details class=\"case\" id=\"case-bar\"><summary>"));
}

#[test]
fn every_link_of_the_page_leads_somewhere() {
    let page = whole().page();
    let links = between(&page, "href=\"#", "\"");
    assert!(links.len() > 8);
    for link in links {
        assert!(page.contains(&format!("id=\"{link}\"")), "{link}");
    }
    let ids = between(&page, " id=\"", "\"");
    let once: BTreeSet<&&str> = ids.iter().collect();
    assert_eq!(once.len(), ids.len(), "{ids:?}");
}

#[test]
fn no_two_charts_have_one_title_and_each_names_its_case() {
    let page = whole().page();
    let titles: Vec<&str> = between(&page, "<svg", "</svg>")
        .into_iter()
        .filter_map(|svg| between(svg, "<title>", "</title>").first().copied())
        .collect();
    assert_eq!(titles.len(), 5, "{titles:?}");
    let once: BTreeSet<&&str> = titles.iter().collect();
    assert_eq!(once.len(), titles.len(), "{titles:?}");
    for title in titles {
        assert!(title.contains("bar") || title.contains("beam"), "{title}");
    }
}

#[test]
fn errors_are_in_per_cent_wherever_they_stand() {
    let page = whole().page();
    for raw in ["0.004", "0.009", "0.02<", "2e-"] {
        assert!(!page.contains(raw), "{raw}");
    }
    let numbers = between(&page, "<details class=\"numbers\">", "</details>");
    assert!(numbers[0].contains(">2.00 %<"), "{}", numbers[0]);
}

#[test]
fn a_method_that_failed_has_its_reason_in_its_row() {
    let page = whole().page();
    let rows = between(&page, "<tr>", "</tr>");
    let row = rows.iter().find(|row| row.contains("linear USL FLIP !"));
    let row = row.expect("the row");
    assert!(
        row.contains(">failed<") && row.contains("no equilibrium in 1600 steps"),
        "{row}"
    );
    let sound = rows.iter().find(|row| row.contains("uGIMP USL FLIP<"));
    assert!(!sound.expect("the row").contains("no equilibrium"));
    assert!(page.contains("no time step is safe for every body"));
}

#[test]
fn reasons_are_for_people() {
    let reason = "step 285, time 0.6449955376776585 s: strained by 1.808";
    let page = MadeUp::new()
        .with_case("bar", 0.004, 0.01)
        .with_failed_study("bar", reason)
        .page();
    assert!(page.contains("time 0.645 s: strained by 1.808"));
}

#[test]
fn cells_carry_their_headings_for_narrow_pages() {
    let page = whole().page();
    let row = between(&page, "error of L2(u)</th>", "</tr>");
    assert!(
        row[0].contains("data-label=\"found\">0.400 %"),
        "{}",
        row[0]
    );
}

#[test]
fn a_record_without_gates_does_not_pass() {
    let page = MadeUp::new().with_step(100.0, 0.5, 0.25).page();
    assert!(
        page.contains("<div class=\"verdict plain\" role=\"status\"><strong>MEASURED</strong>")
    );
    assert!(!page.contains("PASS"));
}

#[test]
fn a_cell_of_the_map_without_a_safe_step_is_not_green() {
    let mut record = whole().record();
    let cell = |scheme: &str, warned: bool, passed: bool| {
        serde_json::json!({
            "weighting": "linear", "scheme": scheme, "transfer": "FLIP", "particles_per_cell": 2, "axes": [2],
            "safe": 0.002, "kernel": 0.5, "warned": warned, "passed": passed, "ruled_by": "a wall",
        })
    };
    let detail = serde_json::json!({
        "cells": [cell("USF", true, true), cell("USL", false, true), cell("MUSL", false, false)],
        "nonlinear": [], "gates": [], "failures": [],
    });
    record.details.stability = serde_json::from_value(detail).expect("a map");
    let page = proctor_benchmark::report::page(&record, None);
    for (class, count) in [("warned", 1), ("good", 1), ("bad", 1)] {
        let cells = page
            .matches(&format!("<td class=\"{class}\">.002</td>"))
            .count()
            + page
                .matches(&format!("<td class=\"{class}\">0.002</td>"))
                .count();
        assert_eq!(cells, count, "{class}");
    }
}

/// The kept record of the long ladders is the largest one that there is.
#[test]
fn the_page_of_the_largest_record_is_not_larger_than_three_megabytes() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/expected");
    let largest = std::fs::read_dir(path)
        .expect("kept records")
        .flatten()
        .filter(|entry| entry.path().extension().is_some_and(|e| e == "json"))
        .max_by_key(|entry| entry.metadata().map_or(0, |data| data.len()))
        .expect("a record");
    let record = proctor_benchmark::record::Record::read(&largest.path()).expect("a record");
    let page = proctor_benchmark::report::page(&record, None);
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
}
