//! Colours, marks and strokes.

use super::Strength;
use serde::{Deserialize, Serialize};
use std::fmt::{self, Write};

/// A colour of the palette by its meaning-free number; Okabe and Ito's, which people with any colour vision tell
/// apart, and a lighter set of the same hues on dark paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Colour {
    /// The colour of text.
    Ink,
    /// A colour of the palette, 0 to 6; greater numbers begin again.
    Hue(usize),
}

/// Light and dark tone of each hue.
const HUES: [(&str, &str); 7] = [
    ("#0072b2", "#5ab4f0"),
    ("#d55e00", "#ff9147"),
    ("#009e73", "#35cfa3"),
    ("#b0508a", "#eb9bcb"),
    ("#8a6d00", "#f0c93c"),
    ("#3b3fa8", "#a3a6ff"),
    ("#6b6b6b", "#b5b5b5"),
];

/// Ink, paper and grid on light and on dark paper.
const INK: (&str, &str) = ("#1b1f24", "#e6e8eb");
const PAPER: (&str, &str) = ("#ffffff", "#14171b");
const GRID: (&str, &str) = ("#d5d9de", "#363c44");

/// A mark at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mark {
    /// None: the line alone.
    None,
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A triangle that points up.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// A small dot.
    Dot,
    /// A bar from zero along the horizontal axis.
    Bar,
}

/// Stroke between points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Stroke {
    /// Not at all.
    None,
    /// A line.
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// A dash and a dot.
    DashDotted,
}

impl Colour {
    /// Name of its class.
    pub(super) fn class(self) -> String {
        match self {
            Self::Ink => "ink".to_owned(),
            Self::Hue(hue) => format!("hue{}", hue % HUES.len()),
        }
    }

    /// The light tone, for renderers without CSS variables.
    pub(super) fn light(self) -> &'static str {
        match self {
            Self::Ink => INK.0,
            Self::Hue(hue) => HUES[hue % HUES.len()].0,
        }
    }
}

impl Strength {
    /// Attribute of opacity, with a blank before it.
    pub(super) fn opacity(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Faint => " opacity=\"0.32\"",
            Self::Band => " opacity=\"0.22\"",
        }
    }

    /// Width of a line.
    pub(super) fn width(self) -> f64 {
        match self {
            Self::Plain => 2.2,
            Self::Faint => 1.4,
            Self::Band => 9.0,
        }
    }
}

impl Stroke {
    /// Pattern of dashes, in the units of the chart.
    pub(super) fn dashes(self) -> Option<&'static str> {
        match self {
            Self::Dashed => Some("7 4"),
            Self::Dotted => Some("2 4"),
            Self::DashDotted => Some("8 4 2 4"),
            Self::None | Self::Solid => None,
        }
    }
}

/// Typefaces of pictures, the first that a machine has.
pub const FONTS: &str = "system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif";

/// The paper's light tone.
pub(super) const PAPER_LIGHT: &str = PAPER.0;
/// The grid's light tone.
pub(super) const GRID_LIGHT: &str = GRID.0;
/// The text's light tone.
pub(super) const INK_LIGHT: &str = INK.0;

/// The style sheet of a chart. A page that defines the variables decides over the colours.
pub(super) fn sheet() -> String {
    let tones = |dark: bool| {
        let pick = |(light, deep): (&'static str, &'static str)| if dark { deep } else { light };
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            ".chart{{--p:var(--chart-paper,{});--i:var(--chart-ink,{});--g:var(--chart-grid,{})}}",
            pick(PAPER),
            pick(INK),
            pick(GRID)
        );
        for (i, hue) in HUES.iter().enumerate() {
            let _ = write!(
                text,
                ".chart .hue{i}{{--c:var(--chart-{i},{})}}",
                pick(*hue)
            );
        }
        text
    };
    format!(
        "{}.chart .ink{{--c:var(--i)}}.chart text{{fill:var(--i)}}.chart .paper{{fill:var(--p)}}\
         .chart .grid{{stroke:var(--g)}}.chart .frame{{stroke:var(--i)}}.chart .strip{{fill:var(--g)}}\
         .chart .line{{stroke:var(--c)}}.chart .mark{{fill:var(--c);stroke:var(--c)}}\
         .chart .open{{fill:var(--p);stroke:var(--c)}}.chart .halo{{stroke:var(--p)}}\
         @media(prefers-color-scheme:dark){{{}}}",
        tones(false),
        tones(true)
    )
}

/// A mark of half-width `r` at (x, y) as an SVG element without its end: `<circle ...`; nothing for marks that have no
/// place of their own.
pub(super) struct Shape {
    pub mark: Mark,
    pub x: f64,
    pub y: f64,
    pub r: f64,
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mark, x, y, r } = *self;
        match mark {
            Mark::None => Ok(()),
            Mark::Circle => write!(f, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\""),
            Mark::Dot => write!(
                f,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"",
                0.55 * r
            ),
            Mark::Square | Mark::Bar => {
                let s = 0.9 * r;
                write!(
                    f,
                    "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"",
                    x - s,
                    y - s,
                    2.0 * s,
                    2.0 * s
                )
            }
            Mark::Triangle => write!(
                f,
                "<path d=\"M{x:.1} {:.1}L{:.1} {:.1}H{:.1}Z\"",
                y - 1.2 * r,
                x + 1.1 * r,
                y + 0.8 * r,
                x - 1.1 * r
            ),
            Mark::Diamond => write!(
                f,
                "<path d=\"M{x:.1} {:.1}L{:.1} {y:.1}L{x:.1} {:.1}L{:.1} {y:.1}Z\"",
                y - 1.25 * r,
                x + 1.25 * r,
                y + 1.25 * r,
                x - 1.25 * r
            ),
        }
    }
}
