//! The map of stability as a picture: weighting functions by schemes and particles per cell, one panel per transfer.
//!
//! The number of a cell is the safe Courant number, its colour says how the measured limit compares with the predicted
//! one, and a frame with a mark says that a gate fails. As with charts, colours are CSS variables with fallbacks.

use super::stability::{courant, sizes, words};
use crate::report::escape;
use crate::stability::{StabilityCell, StabilityDetail};
use std::fmt::Write as _;

/// Width of the picture, in its own units: at 400 pixels a number is 12 pixels high.
const WIDTH: f64 = 640.0;
/// Width of the names of rows.
const NAMES: f64 = 112.0;
/// Height of a row.
const ROW: f64 = 36.0;
/// Space around a cell.
const GAP: f64 = 2.0;
/// Heights of the title, of the heading of a panel, and of the legend.
const TITLE: f64 = 88.0;
const HEADING: f64 = 82.0;
const LEGEND: f64 = 204.0;
/// Size of text.
const TEXT: f64 = 19.0;

/// Ratios of measured to predicted from which on a cell is darker.
const EQUAL: f64 = 1.05;

const STYLE: &str = "\
.map{--p:var(--chart-paper,#fff);--i:var(--chart-ink,#1b1f24);--g:var(--chart-grid,#d5d9de);\
--a:var(--chart-0,#0072b2);--b:var(--chart-1,#d55e00);--c:var(--chart-2,#009e73)}\
@media(prefers-color-scheme:dark){.map{--p:var(--chart-paper,#14171b);--i:var(--chart-ink,#e6e8eb);\
--g:var(--chart-grid,#363c44);--a:var(--chart-0,#5ab4f0);--b:var(--chart-1,#ff9147);--c:var(--chart-2,#35cfa3)}}\
.map text{fill:var(--i)}.map .paper{fill:var(--p)}.map .equal{fill:var(--c);fill-opacity:.3}\
.map .above{fill:var(--a);fill-opacity:.38}.map .below{fill:var(--b);fill-opacity:.85}.map .none{fill:var(--g)}\
.map .bad{fill:none;stroke:var(--b);stroke-width:3}.map .soft{fill-opacity:.75}";

/// Meaning of the colour of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shade {
    Below,
    Equal,
    Above,
    None,
}

impl Shade {
    fn of(ratio: Option<f64>) -> Self {
        match ratio {
            Some(ratio) if ratio < 1.0 => Self::Below,
            Some(ratio) if ratio < EQUAL => Self::Equal,
            Some(_) => Self::Above,
            None => Self::None,
        }
    }

    /// Its class, and the attribute for renderers that know no variables.
    fn class(self) -> (&'static str, &'static str) {
        match self {
            Self::Below => ("below", "#d9711f"),
            Self::Equal => ("equal", "#b3e2d5"),
            Self::Above => ("above", "#9ecae6"),
            Self::None => ("none", "#d5d9de"),
        }
    }
}

/// The map as an SVG document that is also fit to stand inside a page.
#[must_use]
pub fn svg(detail: &StabilityDetail) -> String {
    let transfers = words(&detail.cells, |cell| &cell.transfer);
    let panels: Vec<(&str, Vec<&str>)> = { transfers.into_iter() }
        .map(|transfer| (transfer, weightings_of(detail, transfer)))
        .collect();
    let rows: usize = panels.iter().map(|(_, weightings)| weightings.len()).sum();
    let height = TITLE + HEADING * panels.len() as f64 + ROW * rows as f64 + LEGEND;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"map\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
         aria-label=\"{}\" font-family=\"system-ui, 'Liberation Sans', sans-serif\" font-size=\"{TEXT}\">\n\
         <title>Largest safe c dt/h of each method</title>\n<style>{STYLE}</style>\n<rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escape(&description(detail))
    );
    let failed = detail.gates.iter().filter(|gate| !gate.passed).count();
    label(
        &mut text,
        [8.0, 28.0],
        "Largest safe c dt/h",
        "font-size=\"24\" font-weight=\"600\"",
    );
    let three = detail.cells.iter().any(|cell| cell.axes.contains(&3));
    label(
        &mut text,
        [8.0, 54.0],
        &format!(
            "of every body anywhere on the mesh, {}",
            if three { "2D and 3D" } else { "2D" }
        ),
        "class=\"soft\"",
    );
    let verdict = if failed == 0 {
        format!("all {} gates hold", detail.gates.len())
    } else {
        format!("{failed} of {} gates fail", detail.gates.len())
    };
    label(&mut text, [8.0, 78.0], &verdict, "font-weight=\"600\"");
    let mut top = TITLE;
    for (transfer, weightings) in &panels {
        draw_panel(&mut text, detail, transfer, weightings, top);
        top += HEADING + ROW * weightings.len() as f64;
    }
    legend(&mut text, height - LEGEND + 40.0);
    text.push_str("</svg>\n");
    text
}

/// Weighting functions that have a cell with a transfer, in the order of the map.
fn weightings_of<'a>(detail: &'a StabilityDetail, transfer: &str) -> Vec<&'a str> {
    let mut weightings = words(&detail.cells, |cell| &cell.weighting);
    weightings.retain(|weighting| {
        let mut of = detail.cells.iter();
        of.any(|cell| cell.transfer == transfer && cell.weighting == *weighting)
    });
    weightings
}

/// Description of the picture, in words.
fn description(detail: &StabilityDetail) -> String {
    let failing = detail.cells.iter().filter(|cell| !cell.passed).count();
    format!(
        "Map of stability: {} cells, weighting functions by schemes and particles per cell for each transfer; the number \
         is the largest safe Courant number. In {failing} cells a gate fails.",
        detail.cells.len()
    )
}

fn draw_panel(
    text: &mut String,
    detail: &StabilityDetail,
    transfer: &str,
    weightings: &[&str],
    top: f64,
) {
    let schemes = words(&detail.cells, |cell| &cell.scheme);
    let sizes = sizes(&detail.cells);
    let columns = (schemes.len() * sizes.len()).max(1) as f64;
    let width = (WIDTH - NAMES - 6.0) / columns;
    label(
        text,
        [8.0, top + 34.0],
        transfer,
        "font-size=\"22\" font-weight=\"600\"",
    );
    label(text, [8.0, top + 66.0], "per cell", "class=\"soft\"");
    for (s, scheme) in schemes.iter().enumerate() {
        let left = NAMES + width * (s * sizes.len()) as f64;
        let middle = left + 0.5 * width * sizes.len() as f64;
        label(
            text,
            [middle, top + 34.0],
            scheme,
            "text-anchor=\"middle\" font-weight=\"600\"",
        );
        for (k, size) in sizes.iter().enumerate() {
            let middle = left + (k as f64 + 0.5) * width;
            label(
                text,
                [middle, top + 66.0],
                &size.to_string(),
                "text-anchor=\"middle\" class=\"soft\"",
            );
        }
        for (row, weighting) in weightings.iter().enumerate() {
            let y = top + HEADING + ROW * row as f64;
            if s == 0 {
                label(text, [8.0, y + 24.0], weighting, "");
            }
            for (k, &size) in sizes.iter().enumerate() {
                let found = detail.cells.iter().find(|cell| {
                    cell.transfer == transfer
                        && cell.weighting == *weighting
                        && cell.scheme == *scheme
                        && cell.particles_per_cell == size
                });
                if let Some(cell) = found {
                    draw_cell(text, cell, [left + width * k as f64, y], width);
                }
            }
        }
    }
}

fn draw_cell(text: &mut String, cell: &StabilityCell, [x, y]: [f64; 2], width: f64) {
    // Where no step is safe there is nothing to be measured against.
    let shade = if cell.warned {
        Shade::None
    } else {
        Shade::of(cell.ratio)
    };
    let (class, fill) = shade.class();
    let ratio = cell
        .ratio
        .map_or_else(|| "not measured".to_owned(), |r| format!("{r:.3}"));
    let warned = if cell.warned {
        "\nno step is safe for every body; plan says so"
    } else {
        ""
    };
    let title = format!(
        "{} {} {}, {} per cell\nsafe c dt/h {:.4}, ruled by a {}\nmeasured over predicted {ratio}\nkernel's step {:.3}{warned}",
        cell.weighting,
        cell.scheme,
        cell.transfer,
        cell.particles_per_cell,
        cell.safe,
        cell.ruled_by,
        cell.kernel
    );
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "<g class=\"point\"><title>{}</title><rect class=\"{class}\" fill=\"{fill}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"3\"/>",
        escape(&title),
        x + GAP,
        y + GAP,
        width - 2.0 * GAP,
        ROW - 2.0 * GAP
    );
    if !cell.passed {
        let _ = write!(
            text,
            "<rect class=\"bad\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"3\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"3\"/>",
            x + GAP + 1.5,
            y + GAP + 1.5,
            width - 2.0 * GAP - 3.0,
            ROW - 2.0 * GAP - 3.0
        );
    }
    let mark = if cell.passed { "" } else { "!" };
    let number = courant(cell.safe);
    // A digit more fits without the zero.
    let number = format!("{}{mark}", number.strip_prefix('0').unwrap_or(&number));
    let weight = match (cell.passed, cell.warned) {
        (false, _) => " font-weight=\"700\"",
        (true, true) => " font-style=\"italic\" class=\"soft\"",
        (true, false) => "",
    };
    label(
        text,
        [x + 0.5 * width, y + 24.5],
        &number,
        &format!("text-anchor=\"middle\"{weight}"),
    );
    text.push_str("</g>\n");
}

fn legend(text: &mut String, top: f64) {
    label(
        text,
        [8.0, top],
        "measured limit against the predicted one",
        "font-weight=\"600\"",
    );
    let entries = [
        (Shade::Equal, "equal, within 5 %", false),
        (Shade::Above, "above it: the prediction is careful", false),
        (Shade::Below, "below it: a fault", false),
        (
            Shade::None,
            "! a gate fails: the kernel's step is too long",
            true,
        ),
    ];
    for (row, (shade, words, bad)) in entries.into_iter().enumerate() {
        let y = top + 14.0 + 29.0 * row as f64;
        let (class, fill) = shade.class();
        let look = if bad {
            "class=\"bad\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"3\"".to_owned()
        } else {
            format!("class=\"{class}\" fill=\"{fill}\"")
        };
        let _ = write!(
            text,
            "<rect {look} x=\"10\" y=\"{y:.1}\" width=\"34\" height=\"20\" rx=\"3\"/>"
        );
        label(text, [56.0, y + 17.0], words, "");
    }
    label(
        text,
        [12.0, top + 147.0],
        ".0",
        "font-style=\"italic\" class=\"soft\"",
    );
    label(
        text,
        [56.0, top + 147.0],
        "no step is safe for every body; plan warns",
        "",
    );
}

fn label(text: &mut String, [x, y]: [f64; 2], words: &str, attributes: &str) {
    let _ = writeln!(
        text,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" {attributes}>{}</text>",
        escape(words)
    );
}
