//! The legend: samples with what they mean, in rows below the plot.

use super::style::Shape;
use super::text::{escaped, width};
use super::{Colour, Entry, Mark, Stroke};
use std::fmt::Write;

/// Size of the text.
const SIZE: f64 = 14.0;
/// Height of a row.
const ROW: f64 = 22.0;
/// Width of a sample with its gap.
const SAMPLE: f64 = 34.0;
/// Gap between entries.
const GAP: f64 = 18.0;

/// Places of the entries, in a width of `most` from the origin, and the height of all.
pub fn arranged(entries: &[Entry], most: f64) -> (Vec<[f64; 2]>, f64) {
    let (mut x, mut row) = (0.0, 0);
    let mut places = vec![];
    for entry in entries {
        let wide = SAMPLE + width(&entry.label, SIZE) + GAP;
        if x > 0.0 && x + wide - GAP > most {
            x = 0.0;
            row += 1;
        }
        places.push([x, f64::from(row) * ROW]);
        x += wide;
    }
    let rows = if places.is_empty() { 0 } else { row + 1 };
    (places, f64::from(rows) * ROW)
}

/// Draws an entry with its upper left corner at (x, y).
pub fn draw(svg: &mut String, entry: &Entry, x: f64, y: f64) {
    let middle = y + 0.5 * ROW;
    let (class, light) = (entry.colour.class(), entry.colour.light());
    // Writing to a string cannot fail.
    if entry.stroke != Stroke::None {
        let _ = write!(
            svg,
            "<path class=\"{class} line\" stroke=\"{light}\" stroke-width=\"{}\" fill=\"none\"{}{} d=\"M{x:.1} {middle:.1}h26\"/>",
            entry.strength.width(),
            dashes(entry.stroke),
            entry.strength.opacity()
        );
    }
    if entry.mark != Mark::None {
        let shape = Shape {
            mark: entry.mark,
            x: x + 13.0,
            y: middle,
            r: 5.0,
        };
        let _ = write!(svg, "{shape} {}/>", look(entry.colour, entry.open));
    }
    let _ = write!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{SIZE}\">{}</text>",
        x + SAMPLE,
        middle + 0.36 * SIZE,
        escaped(&entry.label)
    );
}

/// The attribute for a pattern of dashes, with a blank before it.
pub fn dashes(stroke: Stroke) -> String {
    stroke
        .dashes()
        .map_or_else(String::new, |d| format!(" stroke-dasharray=\"{d}\""))
}

/// Attributes of a mark, filled or open.
pub fn look(colour: Colour, open: bool) -> String {
    looks(colour, open, "")
}

/// The same for a point with values, which a page can find by its class.
pub fn look_of_point(colour: Colour, open: bool) -> String {
    looks(colour, open, "point ")
}

fn looks(colour: Colour, open: bool, first: &str) -> String {
    let (class, light) = (colour.class(), colour.light());
    if open {
        format!(
            "class=\"{first}{class} open\" fill=\"{}\" stroke=\"{light}\" stroke-width=\"1.8\"",
            super::style::PAPER_LIGHT
        )
    } else {
        format!("class=\"{first}{class} mark\" fill=\"{light}\"")
    }
}
