//! Charts as SVG: points, lines and bars over two axes, one type for all of them.
//!
//! A chart stands in a page or in a file of its own. Its colours are CSS variables with fallbacks (`--chart-paper`,
//! `--chart-ink`, `--chart-grid`, `--chart-0` to `--chart-6`), light and dark; renderers that know no variables take
//! the light ones from the attributes. Every point has its values as a title, which browsers show on hovering.

mod axis;
mod draw;
mod legend;
mod several;
mod style;
pub mod text;

pub use axis::{Axis, AxisRange, Format, Scale, Tick};
pub use several::side_by_side;
pub use style::{Colour, FONTS, Mark, Stroke};

use serde::{Deserialize, Serialize};

/// A chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// Title; above the chart and for screen readers.
    pub title: String,
    /// The same in a sentence or two, for screen readers: what can be seen.
    pub description: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Lines, points and bars, drawn in this order.
    pub series: Vec<Series>,
    /// Reference lines, behind everything else.
    pub guides: Vec<Guide>,
    /// Legend of the colours, marks and strokes.
    pub legend: Vec<Entry>,
    /// True if a length is the same along both axes, as in a drawing of bodies.
    #[serde(default, skip_serializing_if = "is_false")]
    pub equal: bool,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // The form that serde asks for.
fn is_false(value: &bool) -> bool {
    !value
}

/// Points with one look.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Colour.
    pub colour: Colour,
    /// Mark at each point.
    pub mark: Mark,
    /// Line from point to point; it is broken where a point has no value.
    pub stroke: Stroke,
    /// Strength of the series.
    pub strength: Strength,
    /// Points, in the order in which the line joins them.
    pub points: Vec<Point>,
}

/// Strength of a series beside the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Strength {
    /// Steps back behind others, though its points can be read.
    Faint,
    /// The usual strength.
    Plain,
    /// Broad and pale, behind other series.
    Band,
}

/// A point of a series.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Along the horizontal axis; for named axes the number of the name.
    pub x: f64,
    /// Along the vertical axis. A point without a value, such as a run that failed, is an open mark in a strip above
    /// the plot.
    pub y: Option<f64>,
    /// Text that hovering shows: the sample, its values, and its failure if it failed.
    pub title: String,
}

/// A reference line with a label at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guide {
    /// Start of the line, in values of the axes.
    pub from: [f64; 2],
    /// End of the line.
    pub to: [f64; 2],
    /// Label of the line.
    pub label: String,
}

/// A line of the legend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Label of the entry.
    pub label: String,
    /// Colour of the sample.
    pub colour: Colour,
    /// Mark of the sample.
    pub mark: Mark,
    /// Line of the sample.
    pub stroke: Stroke,
    /// Strength of the sample.
    pub strength: Strength,
    /// True if the sample stands for points without a value.
    pub open: bool,
}

impl Chart {
    /// The chart as an SVG document that is also fit to stand inside a page.
    ///
    /// Points whose coordinates an axis cannot hold (not finite, or not positive on a logarithmic one) are treated as
    /// points without a value.
    #[must_use]
    pub fn to_svg(&self) -> String {
        draw::svg(self)
    }
}
