//! Charts of what was computed: error against time, convergence, curves, speed.

mod arena;
mod beside;
pub mod history;
mod precision;
pub mod refine;
pub mod runs;
pub mod slopes;

pub use arena::{arena, arena_charts, arena_legend};
pub use beside::cases_beside;
pub use precision::error_against_time;

use super::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Point, Scale, Series, Strength, Stroke,
};
use super::number;
use crate::precision::PeerLine;
use crate::precision::findings::LineFindings;
use proctor_verification::case::{Curve, CurvePoint, Drawing};
use proctor_verification::convergence::ConvergenceTable;
use slopes::slopes;

/// Marks of the quantities of a convergence plot.
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond];

/// Errors over cell size, one line per quantity, with the slopes of orders 1 and 2.
#[must_use]
pub fn convergence(title: &str, table: &ConvergenceTable) -> Chart {
    let lines: Vec<(String, &ConvergenceTable, usize)> = table
        .quantities()
        .iter()
        .enumerate()
        .map(|(i, name)| (name.clone(), table, i))
        .collect();
    convergence_of(title, &lines)
}

/// Errors over cell size of the lines of a study, the best first, and of other solvers; at most as many as there are marks.
#[must_use]
pub fn convergence_of_lines(title: &str, lines: &[&LineFindings], peers: &[PeerLine]) -> Chart {
    let of_peer = |peer: &PeerLine| (format!("{} (process)", peer.name), peer.convergence());
    let tables: Vec<(String, ConvergenceTable)> = peers.iter().map(of_peer).collect();
    let own = MARKS.len().saturating_sub(tables.len()).max(1);
    let lines = lines.iter().take(own);
    let lines = lines.map(|line| (line.method.to_string(), &line.table, 0));
    let others = tables.iter().map(|(name, table)| (name.clone(), table, 0));
    let all: Vec<(String, &ConvergenceTable, usize)> = lines.chain(others).collect();
    convergence_of(title, &all)
}

fn convergence_of(title: &str, lines: &[(String, &ConvergenceTable, usize)]) -> Chart {
    let (mut series, mut legend) = (vec![], vec![]);
    for (i, (name, table, quantity)) in lines.iter().enumerate() {
        let points = table.rows().iter().enumerate().map(|(r, row)| {
            let error = row.errors[*quantity];
            let order = table
                .order(*quantity, r)
                .map_or_else(String::new, |p| format!(", order {p:.2}"));
            Point {
                x: row.h,
                y: error.is_finite().then_some(error),
                title: if error.is_finite() {
                    format!(
                        "{name}, h = {} m: error {} %{order}",
                        number(row.h),
                        number(100.0 * error)
                    )
                } else {
                    format!("{name}, h = {} m: the run failed", number(row.h))
                },
            }
        });
        let (colour, mark) = (Colour::Hue(i), MARKS[i % MARKS.len()]);
        series.push(Series {
            colour,
            mark,
            stroke: Stroke::Solid,
            strength: Strength::Plain,
            points: points.collect(),
        });
        legend.push(Entry {
            label: name.clone(),
            colour,
            mark,
            stroke: Stroke::Solid,
            strength: Strength::Plain,
            open: false,
        });
    }
    Chart {
        equal: false,
        title: title.to_owned(),
        description: format!("Relative errors over cell size, both logarithmic. {}", {
            let orders: Vec<String> = lines
                .iter()
                .map(|(name, table, quantity)| {
                    let last = table.rows().len().checked_sub(1);
                    match last.and_then(|last| table.order(*quantity, last)) {
                        Some(order) => format!("{name} falls with order {order:.2} at the end."),
                        None => format!("{name} shows no order."),
                    }
                })
                .collect();
            orders.join(" ")
        }),
        x: Axis {
            label: "cell size h (m)".to_owned(),
            scale: Scale::Log,
            format: Format::Number,
        },
        y: Axis {
            label: "relative error".to_owned(),
            scale: Scale::Log,
            format: Format::Percent,
        },
        guides: refinement_guides(&series),
        series,
        legend,
    }
}

/// Slopes of orders 1 and 2, error like h^p, where they are farthest from the lines.
fn refinement_guides(series: &[Series]) -> Vec<Guide> {
    slopes(series, f64::from)
}

/// Computed against exact along a coordinate.
#[must_use]
pub fn curve(curve: &Curve) -> Chart {
    let side = |line: &[CurvePoint], word: &str, value: fn(&CurvePoint) -> f64| {
        let points = line.iter().map(move |p| Point {
            x: p.at,
            y: Some(value(p)),
            title: format!("{word}: {} at {}", number(value(p)), number(p.at)),
        });
        points.collect::<Vec<_>>()
    };
    let entry = |label: &str, colour, mark, stroke| Entry {
        label: label.to_owned(),
        colour,
        mark,
        stroke,
        strength: Strength::Plain,
        open: false,
    };
    // Without anything exact the computed points are joined.
    let looks: &[_] = if curve.has_exact() {
        &[
            ("exact", Colour::Ink, Mark::None, Stroke::Solid),
            ("computed", Colour::Hue(1), Mark::Dot, Stroke::None),
        ]
    } else {
        &[("computed", Colour::Hue(1), Mark::Dot, Stroke::Solid)]
    };
    // A point that is not a number parts two lines.
    let lines = curve.points.split(|p| !p.computed.is_finite());
    let largest = curve
        .points
        .iter()
        .map(|p| (p.computed - p.exact).abs())
        .fold(0.0, f64::max);
    Chart {
        equal: false,
        title: curve.title.clone(),
        description: if curve.has_exact() {
            format!(
                "{} over {}, computed as dots and exact as a line; they differ by at most {}.",
                curve.ordinate,
                curve.abscissa,
                number(largest)
            )
        } else {
            format!("{} over {}, as computed.", curve.ordinate, curve.abscissa)
        },
        x: Axis {
            label: curve.abscissa.to_owned(),
            scale: Scale::Linear,
            format: Format::Number,
        },
        y: Axis {
            label: curve.ordinate.to_owned(),
            scale: Scale::Linear,
            format: Format::Number,
        },
        series: lines
            .flat_map(|line| {
                looks
                    .iter()
                    .map(move |&(word, colour, mark, stroke)| Series {
                        colour,
                        mark,
                        stroke,
                        strength: Strength::Plain,
                        points: if word == "exact" {
                            side(line, word, |p| p.exact)
                        } else {
                            side(line, word, |p| p.computed)
                        },
                    })
            })
            .collect(),
        guides: vec![],
        legend: looks
            .iter()
            .map(|&(word, colour, mark, stroke)| entry(word, colour, mark, stroke))
            .collect(),
    }
}

/// Bodies and rigid lines in the plane.
#[must_use]
pub fn drawing(drawing: &Drawing) -> Chart {
    let axis = |label: &str| Axis {
        label: label.to_owned(),
        scale: Scale::Linear,
        format: Format::Number,
    };
    let series = |line: &Vec<[f64; 2]>, close: bool, colour| Series {
        colour,
        mark: Mark::None,
        stroke: Stroke::Solid,
        strength: Strength::Plain,
        points: line
            .iter()
            .chain(line.first().filter(|_| close))
            .map(|&[x, y]| Point {
                x,
                y: Some(y),
                title: String::new(),
            })
            .collect(),
    };
    let looks = [("bodies", Colour::Hue(1)), ("rigid", Colour::Ink)];
    let bodies = drawing.bodies.iter();
    let lines = drawing.lines.iter();
    // What can be pointed at: one point per body.
    let middles = drawing.bodies.iter().enumerate().map(|(i, outline)| {
        let mean = |axis: usize| {
            outline.iter().map(|x| x[axis]).sum::<f64>() / outline.len().max(1) as f64
        };
        let [x, y] = [mean(0), mean(1)];
        Point {
            x,
            y: Some(y),
            title: format!(
                "body {}: middle of its outline at {}, {}",
                i + 1,
                number(x),
                number(y)
            ),
        }
    });
    let middles = Series {
        colour: looks[0].1,
        mark: Mark::Dot,
        stroke: Stroke::None,
        strength: Strength::Plain,
        points: middles.collect(),
    };
    Chart {
        equal: true,
        title: drawing.title.clone(),
        description: format!(
            "Outlines of {} bodies and {} rigid lines.",
            drawing.bodies.len(),
            drawing.lines.len()
        ),
        x: axis("x in m"),
        y: axis("y in m"),
        series: bodies
            .map(|outline| series(outline, true, looks[0].1))
            .chain(lines.map(|line| series(line, false, looks[1].1)))
            .chain([middles])
            .collect(),
        guides: vec![],
        legend: looks
            .iter()
            .map(|&(label, colour)| Entry {
                label: label.to_owned(),
                colour,
                mark: Mark::None,
                stroke: Stroke::Solid,
                strength: Strength::Plain,
                open: false,
            })
            .collect(),
    }
}

/// Bars of one value per name, such as the speed of each number of threads.
#[must_use]
pub fn bars(title: &str, quantity: &str, values: &[(String, f64)]) -> Chart {
    bars_of(title, quantity, Format::Number, values)
}

/// The same on a logarithmic axis, of values above zero that lie decades apart, such as the cost of a step of each scene.
#[must_use]
pub fn logarithmic_bars(title: &str, quantity: &str, values: &[(String, f64)]) -> Chart {
    let mut chart = bars(title, quantity, values);
    chart.x.scale = Scale::Log;
    chart
}

/// Bars of values that are written in a format.
#[must_use]
pub fn bars_of(title: &str, quantity: &str, format: Format, values: &[(String, f64)]) -> Chart {
    let points = values.iter().enumerate().map(|(i, (name, value))| Point {
        x: *value,
        y: Some(i as f64),
        title: format!("{name}: {}", format.written(*value)),
    });
    Chart {
        equal: false,
        title: title.to_owned(),
        description: values
            .iter()
            .map(|(name, value)| format!("{name}: {} {quantity}.", format.written(*value)))
            .collect::<Vec<_>>()
            .join(" "),
        x: Axis {
            label: quantity.to_owned(),
            scale: Scale::Linear,
            format,
        },
        y: Axis {
            label: String::new(),
            scale: Scale::Names(values.iter().map(|(name, _)| name.clone()).collect()),
            format: Format::Number,
        },
        series: vec![Series {
            colour: Colour::Hue(0),
            mark: Mark::Bar,
            stroke: Stroke::None,
            strength: Strength::Plain,
            points: points.collect(),
        }],
        guides: vec![],
        legend: vec![],
    }
}
