//! Histograms of observed orders: panels one below the other, with bars of counts and a line at the expected order.

use crate::report::escape;
use std::fmt::Write as _;

/// Width of the picture, in its own units.
const WIDTH: f64 = 640.0;
/// Space to the left of the bars and to the right of them.
const MARGINS: [f64; 2] = [52.0, 14.0];
/// Heights of the title of a panel, of its bars, and of what stands below them.
const TITLE: f64 = 46.0;
const BARS: f64 = 170.0;
const BELOW: f64 = 62.0;
/// Orders from the first bar to the last; what lies beyond counts there.
const RANGE: [f64; 2] = [0.0, 3.5];
/// Bars in a unit of the order.
const PER_UNIT: f64 = 10.0;

const STYLE: &str = "\
.orders{--p:var(--chart-paper,#fff);--i:var(--chart-ink,#1b1f24);--g:var(--chart-grid,#d5d9de);\
--a:var(--chart-0,#0072b2);--b:var(--chart-1,#d55e00)}\
@media(prefers-color-scheme:dark){.orders{--p:var(--chart-paper,#14171b);--i:var(--chart-ink,#e6e8eb);\
--g:var(--chart-grid,#363c44);--a:var(--chart-0,#5ab4f0);--b:var(--chart-1,#ff9147)}}\
.orders text{fill:var(--i)}.orders .paper{fill:var(--p)}.orders .held{fill:var(--a)}.orders .missed{fill:var(--b)}\
.orders .grid{stroke:var(--g)}.orders .expected{stroke:var(--i);stroke-dasharray:5 4}";

/// Orders of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// Title.
    pub title: String,
    /// Order by theory.
    pub expected: f64,
    /// Orders that hold their gate.
    pub held: Vec<f64>,
    /// Orders that miss it.
    pub missed: Vec<f64>,
}

/// Number of bars.
fn count() -> usize {
    ((RANGE[1] - RANGE[0]) * PER_UNIT).round() as usize
}

/// Number of orders in each bar.
#[must_use]
pub fn counts(orders: &[f64]) -> Vec<usize> {
    let mut counts = vec![0; count()];
    for order in orders.iter().filter(|order| !order.is_nan()) {
        let bar = ((order - RANGE[0]) * PER_UNIT).floor();
        counts[bar.clamp(0.0, (count() - 1) as f64) as usize] += 1;
    }
    counts
}

/// The panels as an SVG document that is also fit to stand inside a page.
#[must_use]
pub fn svg(panels: &[Bars]) -> String {
    let each = TITLE + BARS + BELOW;
    let height = each * panels.len() as f64;
    let described: Vec<String> = panels.iter().map(description).collect();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"orders\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
         aria-label=\"{}\" font-family=\"system-ui, 'Liberation Sans', sans-serif\" font-size=\"16\">\n\
         <title>Histogram of observed orders</title>\n<style>{STYLE}</style>\n\
         <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escape(&described.join(" "))
    );
    for (number, panel) in panels.iter().enumerate() {
        draw(&mut text, panel, each * number as f64);
    }
    text.push_str("</svg>\n");
    text
}

/// A panel in words.
fn description(panel: &Bars) -> String {
    let mut all = [&panel.held[..], &panel.missed[..]].concat();
    all.sort_by(f64::total_cmp);
    match all[..] {
        [] => format!("{}: no problem.", panel.title),
        [least, ..] => format!(
            "{}: {} problems, least {least:.2}, median {:.2}; theory expects {}.",
            panel.title,
            all.len(),
            all[all.len() / 2],
            panel.expected
        ),
    }
}

/// Draws a panel below that height.
fn draw(text: &mut String, panel: &Bars, top: f64) {
    let wide = (WIDTH - MARGINS[0] - MARGINS[1]) / (RANGE[1] - RANGE[0]);
    let x = |order: f64| MARGINS[0] + wide * (order - RANGE[0]);
    let (held, missed) = (counts(&panel.held), counts(&panel.missed));
    let sums = held.iter().zip(&missed).map(|(a, b)| a + b);
    let most = sums.max().unwrap_or(0).max(1);
    let foot = top + TITLE + BARS;
    let y = |count: usize| foot - BARS * count as f64 / most as f64;
    let label = |text: &mut String, x: f64, y: f64, anchor: &str, words: &str| {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>",
            escape(words)
        );
    };
    let line = |text: &mut String, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]| {
        let _ = writeln!(
            text,
            "<line class=\"{class}\" stroke=\"#888888\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        );
    };
    label(text, 8.0, top + 24.0, "start", &panel.title);
    for count in [0, most.div_ceil(2), most] {
        line(
            text,
            "grid",
            [MARGINS[0], y(count)],
            [WIDTH - MARGINS[1], y(count)],
        );
        label(
            text,
            MARGINS[0] - 6.0,
            y(count) + 5.0,
            "end",
            &count.to_string(),
        );
    }
    for (bar, (&held, &missed)) in held.iter().zip(&missed).enumerate() {
        let low = RANGE[0] + bar as f64 / PER_UNIT;
        for (class, fill, from, to) in [
            ("held", "#0072b2", 0, held),
            ("missed", "#d55e00", held, held + missed),
        ] {
            if from < to {
                let high = low + 1.0 / PER_UNIT;
                let _ = writeln!(
                    text,
                    "<g class=\"point\"><title>{low:.1} to {high:.1}: {} {}</title><rect class=\"{class}\" fill=\"{fill}\" \
                     x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"/></g>",
                    to - from,
                    if class == "held" { "hold" } else { "miss" },
                    x(low) + 1.0,
                    y(to),
                    x(high) - x(low) - 2.0,
                    y(from) - y(to)
                );
            }
        }
    }
    line(
        text,
        "expected",
        [x(panel.expected), top + TITLE - 8.0],
        [x(panel.expected), foot],
    );
    let halves = ((RANGE[1] - RANGE[0]) * 2.0).round() as usize;
    for half in 0..=halves {
        let order = RANGE[0] + half as f64 / 2.0;
        label(text, x(order), foot + 20.0, "middle", &order.to_string());
    }
    let all = panel.held.len() + panel.missed.len();
    let words = format!(
        "order of the two finest meshes; {all} problems, {} below their bound",
        panel.missed.len()
    );
    label(text, MARGINS[0], foot + 42.0, "start", &words);
}
