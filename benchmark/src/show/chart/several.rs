//! Several charts in one picture, side by side, with one legend above them.

use super::draw::WIDTH;
use super::style::{self, FONTS, INK_LIGHT, PAPER_LIGHT};
use super::text::escaped;
use super::{Chart, Entry, legend};
use std::fmt::Write;

/// Size of the title, and its room above the legend.
const TITLE: f64 = 24.0;
/// Free space at the edges and between charts.
const EDGE: f64 = 16.0;

/// Charts in so many columns as an SVG document, with a title and one legend for all.
#[must_use]
pub fn side_by_side(title: &str, charts: &[Chart], entries: &[Entry], columns: usize) -> String {
    let columns = columns.clamp(1, charts.len().max(1));
    let width = EDGE + columns as f64 * (WIDTH + EDGE);
    let (places, legend_height) = legend::arranged(entries, width - 2.0 * EDGE);
    let mut top = 2.0 * EDGE + 1.4 * TITLE + legend_height;
    let mut body = String::new();
    for row in charts.chunks(columns) {
        let mut tallest = 0.0_f64;
        for (column, chart) in row.iter().enumerate() {
            let svg = chart.to_svg();
            let height = height_of(&svg);
            tallest = tallest.max(height);
            let place = format!(
                "<svg x=\"{:.0}\" y=\"{top:.0}\" width=\"{WIDTH}\" height=\"{height}\" ",
                EDGE + column as f64 * (WIDTH + EDGE)
            );
            body.push_str(&svg.replacen("<svg ", &place, 1));
        }
        top += tallest + EDGE;
    }
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" role=\"img\" viewBox=\"0 0 {width:.0} {top:.0}\" \
         font-family=\"{FONTS}\" fill=\"{INK_LIGHT}\">\
         <title>{0}</title><style>{1}</style>\
         <rect class=\"paper\" width=\"100%\" height=\"100%\" fill=\"{PAPER_LIGHT}\"/>\
         <text x=\"{EDGE}\" y=\"{2:.1}\" font-size=\"{TITLE}\" font-weight=\"600\">{0}</text>",
        escaped(title),
        style::sheet(),
        EDGE + TITLE
    );
    for (entry, [x, y]) in entries.iter().zip(places) {
        legend::draw(&mut out, entry, EDGE + x, EDGE + 1.4 * TITLE + y);
    }
    let _ = writeln!(out, "{body}</svg>");
    out
}

/// Height in the view box of a chart.
fn height_of(svg: &str) -> f64 {
    let view = svg.split_once("viewBox=\"").map_or("", |(_, rest)| rest);
    let numbers = view.split_once('"').map_or("", |(numbers, _)| numbers);
    let last = numbers.split(' ').next_back().unwrap_or_default();
    last.parse().unwrap_or(0.0)
}
