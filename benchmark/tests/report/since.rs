//! The changes since a base: regressions and gains that were made up, by the judge of `compare`.

use super::made_up::{MadeUp, between};
use proctor_benchmark::judge::{Rules, Verdict, compare_as_measured};
use proctor_benchmark::report::{Since, page};

/// A bar, a beam and a pile with these errors.
fn with(errors: [f64; 3]) -> MadeUp {
    let made = MadeUp::new().with_case("bar", errors[0], 0.01);
    made.with_case("beam", errors[1], 0.01)
        .with_case("pile", errors[2], 0.01)
}

fn changed(base: &MadeUp, head: &MadeUp) -> (Verdict, String) {
    let (base, head) = (base.record(), head.record());
    let since = Since::new(&base, &head);
    let judged = compare_as_measured(&base, &head, &Rules::default());
    assert_eq!(since.comparison().verdict(), judged.verdict());
    (judged.verdict(), page(&head, Some(&since)))
}

/// A table by the beginning of its caption.
fn table<'a>(page: &'a str, caption: &str) -> &'a str {
    let tables = between(page, "<table>\n<caption>", "</table>");
    let found = tables.into_iter().find(|table| table.starts_with(caption));
    found.unwrap_or_else(|| panic!("no table {caption}"))
}

fn titles(page: &str) -> Vec<&str> {
    let charts = between(page, "<svg", "</svg>").into_iter();
    charts
        .filter_map(|svg| between(svg, "<title>", "</title>").first().copied())
        .collect()
}

#[test]
fn a_regression_and_a_gain_are_told_as_tables_and_pictures() {
    let (verdict, page) = changed(&with([0.002, 0.006, 0.005]), &with([0.003, 0.002, 0.005]));
    assert_eq!(verdict, Verdict::Worse);
    let worse = table(&page, "Regressions");
    assert!(
        worse.contains("bar/h=1") && worse.contains("error of L2(u)"),
        "{worse}"
    );
    assert!(
        worse.contains(">0.200 %<") && worse.contains(">0.300 %<"),
        "{worse}"
    );
    assert!(worse.contains(">+50.0 %<"), "{worse}");
    assert!(
        !worse.contains("beam") && !worse.contains("pile"),
        "{worse}"
    );
    assert!(
        worse.contains("found by the gate") && !worse.contains("0.002"),
        "{worse}"
    );
    let better = table(&page, "Gains");
    assert!(
        better.contains("beam/h=1") && better.contains("×0.3333"),
        "{better}"
    );
    assert!(
        !better.contains(">bar") && !better.contains("pile"),
        "{better}"
    );
    let titles = titles(&page);
    for title in ["What got worse", "What got better"] {
        assert!(titles.contains(&title), "{titles:?}");
    }
    let first = page.split("<main").next().unwrap_or_default();
    // One verdict: all gates hold, and the first line is as red as the card.
    let banner =
        "<div class=\"verdict fail\" role=\"status\"><strong>WORSE</strong> 3 of 3 gates hold";
    assert!(
        first.contains(banner) && !first.contains("PASS</strong>"),
        "{first}"
    );
    assert!(first.contains("<strong>WORSE</strong> since commit 0123456789: 2 worse, 2 better"));
    assert!(first.contains("Largest losses") && first.contains("Largest gains"));
}

#[test]
fn the_largest_change_comes_first() {
    let (_, page) = changed(&with([0.002, 0.002, 0.002]), &with([0.003, 0.008, 0.004]));
    let worse = table(&page, "Regressions");
    let places = ["beam/h=1", "pile/h=1", "bar/h=1"].map(|case| worse.find(case));
    assert!(places.is_sorted() && places[0].is_some(), "{worse}");
}

#[test]
fn a_record_beside_itself_has_no_change() {
    let (verdict, page) = changed(&with([0.002; 3]), &with([0.002; 3]));
    assert_eq!(verdict, Verdict::Fine);
    assert!(page.contains("<strong>FINE</strong> since commit 0123456789: no change in any of 6"));
    assert!(
        page.contains("What got worse: nothing.") && !titles(&page).contains(&"What got worse")
    );
}

#[test]
fn a_case_that_is_gone_cannot_be_compared_and_is_said_to_be() {
    let (verdict, page) = changed(
        &with([0.002; 3]),
        &MadeUp::new().with_case("bar", 0.002, 0.01),
    );
    assert_eq!(verdict, Verdict::CannotCompare);
    assert!(page.contains("<strong>CANNOT COMPARE</strong>"));
    assert!(page.contains("missing in HEAD"));
}

#[test]
fn a_new_failure_stands_in_a_table_of_its_own_with_its_reason() {
    let mut head = with([0.002; 3]);
    head.rows[0]["error_occurred"] = true.into();
    head.rows[0]["error_message"] = "the beam broke".into();
    let (verdict, page) = changed(&with([0.002; 3]), &head);
    assert_ne!(verdict, Verdict::Fine);
    let failures = table(&page, "What got worse, and has no size");
    assert!(
        failures.contains("bar/h=1") && failures.contains("the beam broke"),
        "{failures}"
    );
}

#[test]
fn without_a_base_the_page_says_how_to_give_one() {
    let page = with([0.002; 3]).page();
    assert!(page.contains("<code>proctor report HEAD --base BASE</code>"));
    assert!(!page.contains("id=\"changes\""));
}
