//! The first screen answers in a line each, from the numbers of the record.

use super::made_up::{MadeUp, between};

const DEFAULT: [&str; 3] = ["uGIMP", "USL", "FLIP"];
const OTHER: [&str; 3] = ["cpGIMP", "MUSL", "APIC"];

fn whole() -> MadeUp {
    MadeUp::new()
        .with_case("bar", 0.004, 0.01)
        .with_case("beam", 0.009, 0.01)
        .with_cost("bar", DEFAULT, Some(2.0), Some(0.004))
        .with_cost("bar", OTHER, Some(0.5), Some(0.003))
        .with_cost("beam", DEFAULT, Some(2.0), Some(0.009))
        .with_cost("beam", OTHER, Some(0.25), Some(0.008))
        .with_cost("pile", OTHER, None, Some(0.034))
        .with_cost("pile", DEFAULT, None, Some(0.056))
        .with_cost("wall", OTHER, Some(0.1), Some(0.001))
        .with_cost("wall", DEFAULT, None, Some(0.02))
        .with_cost("weir", DEFAULT, Some(1.0), Some(0.002))
        .with_cost("weir", ["linear", "USL", "FLIP"], Some(0.5), Some(0.002))
        .with_cost("well", DEFAULT, None, None)
        .with_step(200.0, 0.25, 0.125)
}

/// All that stands before the parts that are folded.
fn first(page: &str) -> &str {
    page.split("<main").next().unwrap_or_default()
}

/// Text without markup.
fn text(html: &str) -> String {
    let mut text = String::new();
    for part in html.split('<') {
        text.push_str(part.split_once('>').map_or(part, |(_, after)| after));
        text.push(' ');
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The panel with that anchor.
fn panel(page: &str, id: &str) -> String {
    let open = format!("<h2 id=\"{id}\">");
    let panels = between(first(page), &open, "</section>");
    assert_eq!(panels.len(), 1, "{id}");
    text(panels[0])
}

#[test]
fn every_question_has_its_answer_and_its_panel() {
    let page = whole().page();
    let first = first(&page);
    assert!(first.contains("<strong>PASS</strong> 2 of 2 gates hold"));
    let answers = text(between(first, "<dl class=\"answers\">", "</dl>")[0]);
    for answer in [
        "Nearest gate 90 % of its bound",
        "Cheapest method 4.0×",
        "Speed 200.0 ns",
        "Changes –",
    ] {
        assert!(answers.contains(answer), "{answer} is not in {answers}");
    }
    for id in ["nearest", "cheapest", "fast", "since"] {
        panel(&page, id);
        assert!(first.contains(&format!("href=\"#{id}\"")), "{id}");
    }
}

#[test]
fn the_nearest_gate_comes_first_and_in_per_cent() {
    let panel = panel(&whole().page(), "nearest");
    let beam = "beam: error of L2(u) 90 % 0.900 %, at most 1.00 %";
    let bar = "bar: error of L2(u) 40 % 0.400 %, at most 1.00 %";
    let places = [beam, bar].map(|line| {
        panel
            .find(line)
            .unwrap_or_else(|| panic!("{line}: {panel}"))
    });
    assert!(places[0] < places[1]);
}

#[test]
fn the_cheapest_method_is_told_by_case_with_its_gain_the_largest_first() {
    let panel = panel(&whole().page(), "cheapest");
    let lines = [
        "beam cpGIMP MUSL APIC, 8.0×",
        "bar cpGIMP MUSL APIC, 4.0×",
        "weir linear USL FLIP !, 2.0×",
        "wall cpGIMP MUSL APIC, default misses it",
        "2 cases stay above 1 %",
        "pile 3.40 %, cpGIMP MUSL APIC",
        "well no run succeeded",
    ];
    let places = lines.map(|line| {
        panel
            .find(line)
            .unwrap_or_else(|| panic!("{line}: {panel}"))
    });
    assert!(places.is_sorted(), "{panel}");
    // Whoever sees the words of a method for the first time finds what they mean.
    for word in [
        "linear", "uGIMP", "cpGIMP", "B-spline", "USL", "MUSL", "USF", "FLIP", "APIC", "TPIC",
    ] {
        let (_, meaning) = panel
            .split_once("A method is three choices")
            .expect("what they mean");
        assert!(meaning.contains(word), "{word}");
    }
}

/// Both take their names, counts and times from the same rows, which are those of the processors.
#[test]
fn ties_are_told_alike_on_page_and_terminal() {
    let methods = [
        ["uGIMP", "USL", "FLIP"],
        ["cpGIMP", "MUSL", "APIC"],
        ["linear", "USF", "TPIC"],
    ];
    let mut made = MadeUp::new();
    for (case, seconds) in [
        ("even", [1.0, 1.05, 1.2]),
        ("three", [1.05, 1.0, 1.09]),
        ("one", [2.0, 1.0, 3.0]),
    ] {
        for (method, seconds) in methods.into_iter().zip(seconds) {
            made = made.with_cost(case, method, Some(seconds), Some(1e-3));
        }
    }
    let page = made.page();
    let panel = panel(&page, "cheapest");
    for line in [
        "even uGIMP USL FLIP = cpGIMP MUSL APIC, the default among them",
        "three cpGIMP MUSL APIC = uGIMP USL FLIP = linear USF TPIC !, the default among them",
        "one cpGIMP MUSL APIC, 2.0×",
    ] {
        assert!(panel.contains(line), "{line}: {panel}");
    }
    let headline = "most often cpGIMP MUSL APIC for 3 of 3 errors (within 10 %: a tie, all count)";
    let answers = text(between(first(&page), "<dl class=\"answers\">", "</dl>")[0]);
    assert!(
        answers.contains(headline) && answers.contains("processor time"),
        "{answers}"
    );
    let mut told = vec![];
    let costs = proctor_benchmark::precision::costs::Costs::all(&made.record());
    proctor_benchmark::show::short::studies(&costs, 3, 9, &mut told).expect("told");
    let told = String::from_utf8(told).expect("text");
    assert!(
        told.contains("CPU s") && told.contains("ties: within 10 %"),
        "{told}"
    );
    let line = "1 %:   cpGIMP MUSL APIC 3×, uGIMP USL FLIP 2×, linear USF TPIC ! 1×; none for 0";
    assert!(told.contains(line), "{told}");
}

#[test]
fn the_first_scene_of_the_record_stands_for_the_speed_and_the_others_have_a_line_each() {
    let several = whole()
        .with_step_of("air", 900.0, 0.5, 0.25)
        .with_step_of("clay", 300.0, 0.5, 0.25);
    let page = several.page();
    let answers = text(between(first(&page), "<dl class=\"answers\">", "</dl>")[0]);
    let headline = "Speed 200.0 ns of processor time per particle and step on 1 thread, block";
    assert!(answers.contains(headline), "{answers}");
    let panel = panel(&page, "fast");
    for line in [
        "1 thread 200 5.0 million particle steps/s arithmetic alone 50 25 % of the time",
        "The other scenes ns particles air 900 64 clay 300 64",
    ] {
        assert!(panel.contains(line), "{panel}");
    }
    assert_eq!(panel.matches("arithmetic alone").count(), 1, "{panel}");
}

#[test]
fn floors_of_the_speed_come_from_the_peaks_of_the_same_run() {
    let panel = panel(&whole().page(), "fast");
    for line in [
        "1 thread 200 5.0 million particle steps/s arithmetic alone 50 25 % of the time",
        "memory alone 25 12 % of the time",
    ] {
        assert!(panel.contains(line), "{panel}");
    }
    // Twice the speed at the same peaks: twice the shares, and the same floors.
    let mut faster = whole();
    faster.rows.pop();
    let faster = faster.with_step(100.0, 0.5, 0.25).page();
    let charts = |page: &str| text(between(page, "<h2 id=\"speed\">", "</svg>")[0]);
    for (page, measured) in [(whole().page(), "200 ns"), (faster, "100 ns")] {
        let chart = charts(&page);
        assert!(
            chart.contains(&format!("block, 1 thread: {measured}")),
            "{chart}"
        );
        assert!(
            chart.contains("arithmetic alone, 1 thread: 50 ns"),
            "{chart}"
        );
        assert!(chart.contains("memory alone, 1 thread: 25 ns"), "{chart}");
    }
}

#[test]
fn a_map_has_the_time_to_one_per_cent_of_each_case_and_method() {
    let page = whole().page();
    let map = text(between(first(&page), "<table class=\"map heat\">", "</table>")[0]);
    // Milliseconds, the least case first; a case that no method brings so far has no row.
    for line in [
        "wall – 100",
        "beam 2000 250",
        "bar 2000 500",
        "weir 1000 – 500",
    ] {
        assert!(map.contains(line), "{line} is not in {map}");
    }
    assert!(!map.contains("pile") && !map.contains("well"), "{map}");
}

#[test]
fn a_gate_is_judged_from_its_row_and_amber_near_its_bound() {
    let near = MadeUp::new().with_case("bar", 0.0097, 0.01);
    let page = near.page();
    assert!(
        first(&page).contains("<div class=\"near\"><dt><a href=\"#nearest\">"),
        "{}",
        first(&page)
    );
    assert!(first(&page).contains("<tr class=\"passed near\">"));
    assert!(first(&page).contains("<strong>PASS</strong> 1 of 1 gates hold"));
    // A row above its bound fails whatever is stored beside it.
    let mut edited = near;
    edited.rows[1]["gate_value"] = serde_json::json!(0.02);
    let page = edited.page();
    assert!(
        first(&page).contains("<strong>FAIL</strong> 0 of 1 gates hold"),
        "{}",
        first(&page)
    );
}

#[test]
fn a_record_of_rows_alone_is_whole() {
    let mut rows = MadeUp::new().with_case("bar", 0.004, 0.01);
    rows.cases.clear();
    let page = rows.page();
    assert!(
        first(&page).contains("<strong>PASS</strong> 1 of 1 gates hold, of 1 case"),
        "{}",
        first(&page)
    );
    assert!(page.contains("<details class=\"case\" id=\"case-bar\">"));
    // No column is empty.
    assert!(first(&page).contains("<div class=\"panels columns-1\">"));
}
