//! Drawing of a chart as SVG text.

use super::axis::AxisRange;
use super::legend::{self, dashes, look_of_point};
use super::style::{self, FONTS, GRID_LIGHT, INK_LIGHT, PAPER_LIGHT, Shape};
use super::text::{escaped, lines, width};
use super::{Chart, Guide, Mark, Point, Series, Stroke};
use std::fmt::Write;

/// Width of the chart in its own units. Text of 14 units is 10 pixels high where the chart is 400 pixels wide.
pub(super) const WIDTH: f64 = 560.0;
/// Height of the plot; bars take what their number needs.
const PLOT: f64 = 330.0;
/// Largest height of the plot of a drawing, in which both axes have the same scale.
const DRAWING: f64 = 460.0;
/// Height of a bar with its gap.
const BAR: f64 = 34.0;
/// Length of the horizontal axis over the longest bar.
const BAR_ROOM: f64 = 1.12;
/// Free space at the edges of the chart.
const EDGE: f64 = 12.0;
/// Distance from the label of the vertical axis to the plot: the uppermost number may stand half its height above the plot.
const GAP: f64 = 11.0;
/// Width of bold letters over that of plain ones.
const BOLD: f64 = 1.15;
/// Size of the title.
const TITLE: f64 = 16.0;
/// Size of all other text.
const TEXT: f64 = 14.0;
/// Height of the strip for points without a value.
const STRIP: f64 = 24.0;
/// Radius of a mark.
const RADIUS: f64 = 4.6;

/// Places of all parts of the chart.
struct Layout {
    x: AxisRange,
    y: AxisRange,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    /// Middle of the strip, where there is one.
    strip: Option<f64>,
}

impl Layout {
    fn at_x(&self, value: f64) -> Option<f64> {
        Some(self.left + self.x.share(value)? * (self.right - self.left))
    }

    fn at_y(&self, value: f64) -> Option<f64> {
        let share = self.y.share(value)?;
        let share = if self.y.is_named() {
            share
        } else {
            1.0 - share
        };
        Some(self.top + share * (self.bottom - self.top))
    }

    /// Place of a point with a value on both axes.
    fn at(&self, point: &Point) -> Option<[f64; 2]> {
        Some([self.at_x(point.x)?, self.at_y(point.y?)?])
    }
}

/// The chart as an SVG document. Writing to a string cannot fail, so its results are ignored.
pub fn svg(chart: &Chart) -> String {
    let points = || chart.series.iter().flat_map(|s| &s.points);
    let has_bars = chart.series.iter().any(|s| s.mark == Mark::Bar);
    // Room for the number at the end of the longest bar.
    let room = if has_bars { BAR_ROOM } else { 1.0 };
    // The shortest bar of a logarithmic axis has a length, too.
    let shortest = points().filter(|_| has_bars).map(|p| 0.5 * p.x);
    let x = chart
        .x
        .ranged(points().map(|p| room * p.x).chain(shortest), has_bars);
    let y = chart.y.ranged(points().filter_map(|p| p.y), false);
    let title = lines(&chart.title, BOLD * TITLE, WIDTH - 2.0 * EDGE);
    let tick_width = y.ticks.iter().map(|t| width(&t.text, TEXT));
    let tick_width = tick_width.fold(0.0, f64::max);
    let named = y.is_named();
    let left = EDGE + tick_width.max(24.0) + 10.0;
    let last_tick = x.ticks.last().map_or(0.0, |t| 0.5 * width(&t.text, TEXT));
    let strip = points().any(|p| p.y.is_none_or(|value| y.share(value).is_none()));
    let y_label = if y.label.is_empty() { 0.0 } else { 1.4 * TEXT };
    let head = EDGE + 1.3 * TITLE * title.len() as f64 + y_label + GAP;
    let top = head + if strip { STRIP + 4.0 } else { 0.0 };
    let mut right = WIDTH - EDGE - last_tick.max(6.0);
    let plot = if named {
        BAR * y.ticks.len() as f64 + 10.0
    } else if chart.equal {
        let tall = (right - left) * y.span() / x.span();
        let plot = tall.min(DRAWING);
        right = left + (right - left) * plot / tall;
        plot
    } else {
        PLOT
    };
    let layout = Layout {
        left,
        right,
        top,
        bottom: top + plot,
        strip: strip.then_some(head + 0.5 * STRIP),
        x,
        y,
    };
    let legend_top = layout.bottom + 3.6 * TEXT;
    let (places, legend_height) = legend::arranged(&chart.legend, WIDTH - 2.0 * EDGE);
    let height = legend_top + legend_height + EDGE;

    let mut out = String::new();
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" role=\"img\" viewBox=\"0 0 {WIDTH} {height:.0}\" \
         font-family=\"{FONTS}\" fill=\"{INK_LIGHT}\">\
         <title>{}</title><desc>{}</desc><style>{}</style>\
         <rect class=\"paper\" width=\"100%\" height=\"100%\" fill=\"{PAPER_LIGHT}\"/>",
        escaped(&chart.title),
        escaped(&chart.description),
        style::sheet()
    );
    for (i, line) in title.iter().enumerate() {
        let y = EDGE + TITLE * (1.0 + 1.3 * i as f64);
        label(
            &mut out,
            line,
            [EDGE, y],
            "start",
            TITLE,
            " font-weight=\"600\"",
        );
    }
    if !layout.y.label.is_empty() {
        let at = [EDGE, head - GAP - 1.0];
        label(&mut out, &layout.y.label, at, "start", TEXT, "");
    }
    grid(&mut out, &layout);
    for guide in &chart.guides {
        reference(&mut out, &layout, guide);
    }
    for series in &chart.series {
        line(&mut out, &layout, series);
    }
    for series in &chart.series {
        marks(&mut out, &layout, series);
    }
    frame(&mut out, &layout);
    for (entry, [x, y]) in chart.legend.iter().zip(places) {
        legend::draw(&mut out, entry, EDGE + x, legend_top + y);
    }
    out.push_str("</svg>\n");
    out
}

/// Text with its base line at a point; `more` are attributes with a blank before them.
fn label(out: &mut String, text: &str, [x, y]: [f64; 2], anchor: &str, size: f64, more: &str) {
    let _ = write!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\"{more}>{}</text>",
        escaped(text)
    );
}

/// Grid lines, the strip, and the numbers at the axes.
fn grid(out: &mut String, layout: &Layout) {
    let Layout {
        left,
        right,
        top,
        bottom,
        ..
    } = *layout;
    if let Some(middle) = layout.strip {
        let _ = write!(
            out,
            "<rect class=\"strip\" fill=\"{GRID_LIGHT}\" opacity=\"0.45\" x=\"{left:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{STRIP}\"/>",
            middle - 0.5 * STRIP,
            right - left
        );
        let at = [left - 6.0, middle + 0.36 * TEXT];
        label(out, "failed", at, "end", TEXT, "");
    }
    let mut path = [String::new(), String::new()];
    for (minor, values) in [(false, ticks(&layout.x)), (true, layout.x.minor.clone())] {
        for value in values {
            if let Some(x) = layout.at_x(value) {
                let _ = write!(path[usize::from(minor)], "M{x:.1} {top:.1}V{bottom:.1}");
            }
        }
    }
    if !layout.y.is_named() {
        for (minor, values) in [(false, ticks(&layout.y)), (true, layout.y.minor.clone())] {
            for value in values {
                if let Some(y) = layout.at_y(value) {
                    let _ = write!(path[usize::from(minor)], "M{left:.1} {y:.1}H{right:.1}");
                }
            }
        }
    }
    for (path, (width, opacity)) in path.iter().zip([(1.0, 1.0), (0.6, 0.5)]) {
        let _ = write!(
            out,
            "<path class=\"grid\" stroke=\"{GRID_LIGHT}\" stroke-width=\"{width}\" opacity=\"{opacity}\" fill=\"none\" d=\"{path}\"/>"
        );
    }
    // A number is left out where it would touch the one before.
    let mut free = f64::NEG_INFINITY;
    for tick in &layout.x.ticks {
        let Some(x) = layout.at_x(tick.at) else {
            continue;
        };
        let half = 0.5 * width(&tick.text, TEXT);
        if x - half > free {
            label(
                out,
                &tick.text,
                [x, bottom + 1.3 * TEXT],
                "middle",
                TEXT,
                "",
            );
            free = x + half + 5.0;
        }
    }
    for tick in &layout.y.ticks {
        if let Some(y) = layout.at_y(tick.at) {
            let at = [left - 6.0, y + 0.36 * TEXT];
            label(out, &tick.text, at, "end", TEXT, "");
        }
    }
    let middle = [0.5 * (left + right), bottom + 2.75 * TEXT];
    label(out, &layout.x.label, middle, "middle", TEXT, "");
}

fn ticks(axis: &AxisRange) -> Vec<f64> {
    axis.ticks.iter().map(|tick| tick.at).collect()
}

/// The two axes.
fn frame(out: &mut String, layout: &Layout) {
    let _ = write!(
        out,
        "<path class=\"frame\" stroke=\"{INK_LIGHT}\" stroke-width=\"1.2\" fill=\"none\" d=\"M{:.1} {:.1}V{:.1}H{:.1}\"/>",
        layout.left, layout.top, layout.bottom, layout.right
    );
}

/// A reference line, with its label above its end.
fn reference(out: &mut String, layout: &Layout, guide: &Guide) {
    let end = |[x, y]: [f64; 2]| Some([layout.at_x(x)?, layout.at_y(y)?]);
    let (Some([x1, y1]), Some([x2, y2])) = (end(guide.from), end(guide.to)) else {
        return;
    };
    let _ = write!(
        out,
        "<path class=\"ink line\" stroke=\"{INK_LIGHT}\" stroke-width=\"1.2\" opacity=\"0.75\" stroke-dasharray=\"5 3\" fill=\"none\" d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\"/>"
    );
    // To the right of its end where there is room, else to the left above it.
    let wide = width(&guide.label, TEXT);
    let (x, y, anchor) = if x2 + wide + 6.0 < layout.right {
        (x2 + 5.0, y2 + 0.36 * TEXT, "start")
    } else {
        (x2.min(layout.right), y2 - 5.0, "end")
    };
    let y = y.clamp(layout.top + TEXT, layout.bottom - 4.0);
    let halo = format!(
        " class=\"halo\" stroke=\"{PAPER_LIGHT}\" stroke-width=\"3\" paint-order=\"stroke\" stroke-linejoin=\"round\""
    );
    label(out, &guide.label, [x, y], anchor, 0.93 * TEXT, &halo);
}

/// The line of a series, broken where a point has no value.
fn line(out: &mut String, layout: &Layout, series: &Series) {
    if series.stroke == Stroke::None {
        return;
    }
    let mut path = String::new();
    let mut joined = false;
    for point in &series.points {
        match layout.at(point) {
            Some([x, y]) => {
                let letter = if joined { 'L' } else { 'M' };
                let _ = write!(path, "{letter}{x:.1} {y:.1}");
                joined = true;
            }
            None => joined = false,
        }
    }
    let _ = write!(
        out,
        "<path class=\"{} line\" stroke=\"{}\" stroke-width=\"{}\" fill=\"none\" stroke-linejoin=\"round\" \
         stroke-linecap=\"round\"{}{} d=\"{path}\"/>",
        series.colour.class(),
        series.colour.light(),
        series.strength.width(),
        dashes(series.stroke),
        series.strength.opacity()
    );
}

/// The marks of a series, each with its title.
fn marks(out: &mut String, layout: &Layout, series: &Series) {
    if series.mark == Mark::None {
        return;
    }
    let _ = write!(out, "<g{}>", series.strength.opacity());
    for point in &series.points {
        let place = layout.at(point);
        let title = escaped(&point.title);
        if series.mark == Mark::Bar {
            // A logarithmic axis has no zero: its bars begin at its end.
            let zero = layout.at_x(0.0).unwrap_or(layout.left);
            if let Some([x, y]) = place {
                bar(out, layout, series, point, [zero, x, y]);
            }
            continue;
        }
        let (place, open) = match (place, layout.strip) {
            (Some(place), _) => (place, false),
            // A run that failed before its time was taken stands at the left end.
            (None, Some(strip)) => ([layout.at_x(point.x).unwrap_or(layout.left), strip], true),
            (None, None) => continue,
        };
        let shape = Shape {
            mark: series.mark,
            x: place[0].clamp(layout.left, layout.right),
            y: place[1],
            r: RADIUS,
        };
        let _ = write!(
            out,
            "{shape} {}><title>{title}</title>{}",
            look_of_point(series.colour, open),
            end_of(series.mark)
        );
    }
    out.push_str("</g>");
}

/// A bar from zero, its value written at its end.
fn bar(out: &mut String, layout: &Layout, series: &Series, point: &Point, at: [f64; 3]) {
    let [zero, x, y] = at;
    let _ = write!(
        out,
        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" {}><title>{}</title></rect>",
        zero.min(x),
        y - 0.32 * BAR,
        (x - zero).abs(),
        0.64 * BAR,
        look_of_point(series.colour, false),
        escaped(&point.title)
    );
    let text = layout.x.format.written(point.x);
    let halo = format!(
        " class=\"halo\" stroke=\"{PAPER_LIGHT}\" stroke-width=\"3\" paint-order=\"stroke\" stroke-linejoin=\"round\""
    );
    let (x, anchor) = if x + width(&text, TEXT) + 8.0 < layout.right {
        (x + 6.0, "start")
    } else {
        (x - 6.0, "end")
    };
    label(out, &text, [x, y + 0.36 * TEXT], anchor, TEXT, &halo);
}

/// The end of the element of a mark.
fn end_of(mark: Mark) -> &'static str {
    match mark {
        Mark::Circle | Mark::Dot => "</circle>",
        Mark::Square | Mark::Bar => "</rect>",
        Mark::Triangle | Mark::Diamond | Mark::None => "</path>",
    }
}
