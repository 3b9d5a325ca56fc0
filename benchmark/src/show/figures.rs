//! Charts of what was computed: error against time, convergence, curves, speed.

use super::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Point, Scale, Series, Strength, Stroke,
};
use super::{number, seconds};
use crate::precision::choices::{SCHEMES, TRANSFERS, WEIGHTINGS};
use crate::precision::findings::LineFindings;
use crate::precision::{Findings, Line, Studied};
use proctor_verification::case::Curve;
use proctor_verification::convergence::ConvergenceTable;
use proctor_verification::settings::Method;

/// Marks of the stress schemes, in the order of [`SCHEMES`].
const SCHEME_MARKS: [Mark; 3] = [Mark::Circle, Mark::Square, Mark::Triangle];
/// Strokes of the transfers, in the order of [`TRANSFERS`].
const TRANSFER_STROKES: [Stroke; 3] = [Stroke::Solid, Stroke::Dashed, Stroke::Dotted];
/// Marks of the quantities of a convergence plot.
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond];

/// Error against run time of one measure of a study: paths of refinement as lines, sweeps as dots, runs that failed as
/// open marks above the plot, the front of the best runs as a broad band. Lines that have a run on the front or reach
/// a level of error at the least cost stand out.
#[must_use]
pub fn error_against_time(studied: &Studied, measure: usize) -> Chart {
    let findings = Findings::new(studied, measure);
    let word = studied.study.measures()[measure].word;
    let stands_out = |line: &Line| {
        let on_front = |i: &usize| findings.front.contains(i);
        let best = |level| {
            findings
                .cheapest(level)
                .is_some_and(|best| best.method == line.method)
        };
        line.method == Method::DEFAULT || line.path.iter().any(on_front) || best(0) || best(1)
    };
    let point = |&i: &usize| point(studied, measure, i);
    let front = Series {
        colour: Colour::Ink,
        mark: Mark::None,
        stroke: Stroke::Solid,
        strength: Strength::Band,
        points: findings.front.iter().filter_map(point).collect(),
    };
    let mut series = vec![front];
    let mut lines: Vec<&Line> = studied.plan.lines.iter().collect();
    lines.sort_by_key(|line| stands_out(line));
    for line in lines {
        let strength = if stands_out(line) {
            Strength::Plain
        } else {
            Strength::Faint
        };
        let (colour, mark, stroke) = look(&line.method);
        let sweeps = line.courant.iter().chain(&line.particles);
        series.push(Series {
            colour,
            mark: Mark::Dot,
            stroke: Stroke::None,
            strength: Strength::Faint,
            points: sweeps.filter_map(point).collect(),
        });
        series.push(Series {
            colour,
            mark,
            stroke,
            strength,
            points: line.path.iter().filter_map(point).collect(),
        });
    }
    series.retain(|series| !series.points.is_empty());
    Chart {
        title: format!(
            "{}: error of the {word} against run time",
            studied.study.name()
        ),
        description: description(&findings, word),
        x: Axis {
            label: "run time of the stepping loop, fastest run".to_owned(),
            scale: Scale::Log,
            format: Format::Seconds,
        },
        y: Axis {
            label: format!("relative L2 error of the {word}"),
            scale: Scale::Log,
            format: Format::Percent,
        },
        guides: order_guides(&series, studied.study.refined_axes()),
        legend: legend(studied, &series),
        series,
    }
}

/// Colour, mark and stroke of a method.
fn look(method: &Method) -> (Colour, Mark, Stroke) {
    let hue = WEIGHTINGS.iter().position(|w| *w == method.weighting);
    let scheme = SCHEMES.iter().position(|s| *s == method.scheme);
    let transfer = TRANSFERS.iter().position(|t| *t == method.transfer);
    (
        hue.map_or(Colour::Ink, Colour::Hue),
        scheme.map_or(Mark::Diamond, |i| SCHEME_MARKS[i]),
        transfer.map_or(Stroke::Solid, |i| TRANSFER_STROKES[i]),
    )
}

/// A run as a point; `None` if it was not run.
fn point(studied: &Studied, measure: usize, i: usize) -> Option<Point> {
    let (choice, run) = (&studied.plan.choices[i], studied.runs.get(i)?);
    let settings = &choice.settings;
    let time = run.seconds()?;
    let error = run.error(measure);
    let mut title = format!(
        "{}, {}, C = {}, {} particles per cell and axis\n",
        settings.method,
        choice.rung.label,
        number(settings.courant_or_automatic()),
        settings.particles_per_cell
    );
    title += &match &error {
        Ok(error) => format!("error {} %, {}", number(100.0 * error), seconds(time)),
        Err(reason) => format!("failed after {}: {reason}", seconds(time)),
    };
    if let Ok(found) = &run.found {
        title += &format!(
            ", {} particles, {} steps, dt/critical {}",
            found.particles,
            found.steps,
            number(found.dt_over_critical)
        );
    }
    if !settings.method.has_safe_step() {
        title += "; no step is safe for every body";
    }
    Some(Point {
        x: time,
        y: error.ok(),
        title,
    })
}

/// What the chart shows, in words.
fn description(findings: &Findings, word: &str) -> String {
    let cheapest = |level: usize, name: &str| match findings.cheapest(level) {
        Some(line) => format!(
            "An error of {name} in the {word} costs least with {}: {}.",
            line.method,
            seconds(line.costs[level].seconds().unwrap_or(f64::NAN))
        ),
        None => format!("No combination reaches an error of {name} in the {word}."),
    };
    format!(
        "Relative error over run time, both logarithmic; each line refines the mesh. {} {}",
        cheapest(0, "1 %"),
        cheapest(1, "0.1 %")
    )
}

/// Slopes of orders 1 and 2: error like T^(-p/(d+1)), from one point at the lower left of the runs.
fn order_guides(series: &[Series], axes: usize) -> Vec<Guide> {
    let points = || {
        let all = series.iter().flat_map(|s| &s.points);
        all.filter_map(|p| Some((p.x, p.y?)))
            .filter(|(x, y)| *x > 0.0 && *y > 0.0)
    };
    let extent = |value: fn((f64, f64)) -> f64| {
        points()
            .map(value)
            .fold(None, |range: Option<[f64; 2]>, v| {
                Some(range.map_or([v, v], |[low, high]| [low.min(v), high.max(v)]))
            })
    };
    let (Some([x1, x2]), Some([y1, y2])) = (extent(|p| p.0), extent(|p| p.1)) else {
        return vec![];
    };
    if x2 < 4.0 * x1 || y2 < 4.0 * y1 {
        return vec![];
    }
    // At the lower left, where no run is fast and accurate at once: down to the smallest error at order 2.
    let slope_of = |order: i32| f64::from(order) / (axes as f64 + 1.0);
    let ratio = (x2 / x1).powf(0.22);
    let from = [x1, y1 * ratio.powf(slope_of(2))];
    [1, 2]
        .into_iter()
        .map(|order| {
            let slope = slope_of(order);
            Guide {
                from,
                to: [from[0] * ratio, from[1] * ratio.powf(-slope)],
                label: format!("order {order}"),
            }
        })
        .collect()
}

/// Entries for what occurs: colours, marks, strokes, dots, open marks, the front.
fn legend(studied: &Studied, series: &[Series]) -> Vec<Entry> {
    let lines = &studied.plan.lines;
    let any = |test: &dyn Fn(&Method) -> bool| lines.iter().any(|line| test(&line.method));
    let mut entries = vec![];
    let mut push = |label: &str, colour, mark, stroke| {
        entries.push(Entry {
            label: label.to_owned(),
            colour,
            mark,
            stroke,
            strength: Strength::Plain,
            open: false,
        });
    };
    let default = Method::DEFAULT;
    for (i, weighting) in WEIGHTINGS.into_iter().enumerate() {
        if any(&|m| m.weighting == weighting) {
            let word = Method {
                weighting,
                ..default
            }
            .weighting_word();
            push(word, Colour::Hue(i), Mark::None, Stroke::Solid);
        }
    }
    for (i, scheme) in SCHEMES.into_iter().enumerate() {
        if any(&|m| m.scheme == scheme) {
            let word = Method { scheme, ..default }.scheme_word();
            push(word, Colour::Ink, SCHEME_MARKS[i], Stroke::None);
        }
    }
    for (i, transfer) in TRANSFERS.into_iter().enumerate() {
        if any(&|m| m.transfer == transfer) {
            let word = Method {
                transfer,
                ..default
            }
            .transfer_word();
            push(word, Colour::Ink, Mark::None, TRANSFER_STROKES[i]);
        }
    }
    entries.push(Entry {
        label: "Pareto front".to_owned(),
        colour: Colour::Ink,
        mark: Mark::None,
        stroke: Stroke::Solid,
        strength: Strength::Band,
        open: false,
    });
    let mut push = |label: &str, mark, open| {
        entries.push(Entry {
            label: label.to_owned(),
            colour: Colour::Ink,
            mark,
            stroke: Stroke::None,
            strength: Strength::Plain,
            open,
        });
    };
    if series.iter().any(|s| s.mark == Mark::Dot) {
        let words = "other C or particles per cell";
        push(words, Mark::Dot, false);
    }
    let failed = |p: &Point| p.y.is_none();
    if series.iter().any(|s| s.points.iter().any(failed)) {
        push("failed run", Mark::Circle, true);
    }
    entries
}

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

/// Errors over cell size of the lines of a study, the best first, at most as many as there are colours.
#[must_use]
pub fn convergence_of_lines(title: &str, lines: &[&LineFindings]) -> Chart {
    let lines: Vec<(String, &ConvergenceTable, usize)> = lines
        .iter()
        .take(MARKS.len())
        .map(|line| (line.method.to_string(), &line.table, 0))
        .collect();
    convergence_of(title, &lines)
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
                title: format!(
                    "{name}, h = {} m: error {} %{order}",
                    number(row.h),
                    number(100.0 * error)
                ),
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

/// Slopes of orders 1 and 2 from the finest cells upwards, below the lines.
fn refinement_guides(series: &[Series]) -> Vec<Guide> {
    let points = || {
        let all = series.iter().flat_map(|s| &s.points);
        all.filter_map(|p| Some((p.x, p.y.filter(|y| *y > 0.0)?)))
    };
    let least = |value: fn((f64, f64)) -> f64| points().map(value).fold(f64::INFINITY, f64::min);
    let (h, e) = (least(|p| p.0), least(|p| p.1));
    let largest = points().map(|p| p.0).fold(0.0, f64::max);
    if !(largest > 1.9 * h && e.is_finite()) {
        return vec![];
    }
    let ratio = (largest / h).sqrt();
    [1, 2]
        .into_iter()
        .map(|order| Guide {
            from: [h, 0.6 * e],
            to: [h * ratio, 0.6 * e * ratio.powi(order)],
            label: format!("order {order}"),
        })
        .collect()
}

/// Computed against exact along a coordinate.
#[must_use]
pub fn curve(curve: &Curve) -> Chart {
    let side = |word: &str, value: fn(&proctor_verification::case::CurvePoint) -> f64| {
        let points = curve.points.iter().map(move |p| Point {
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
    let looks = [
        ("exact", Colour::Ink, Mark::None, Stroke::Solid),
        ("computed", Colour::Hue(1), Mark::Dot, Stroke::None),
    ];
    let largest = curve
        .points
        .iter()
        .map(|p| (p.computed - p.exact).abs())
        .fold(0.0, f64::max);
    Chart {
        title: curve.title.clone(),
        description: format!(
            "{} over {}, computed as dots and exact as a line; they differ by at most {}.",
            curve.ordinate,
            curve.abscissa,
            number(largest)
        ),
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
        series: looks
            .iter()
            .map(|&(word, colour, mark, stroke)| Series {
                colour,
                mark,
                stroke,
                strength: Strength::Plain,
                points: if word == "exact" {
                    side(word, |p| p.exact)
                } else {
                    side(word, |p| p.computed)
                },
            })
            .collect(),
        guides: vec![],
        legend: looks
            .iter()
            .map(|&(word, colour, mark, stroke)| entry(word, colour, mark, stroke))
            .collect(),
    }
}

/// Bars of one value per name, such as the speed of each number of threads.
#[must_use]
pub fn bars(title: &str, quantity: &str, values: &[(String, f64)]) -> Chart {
    let points = values.iter().enumerate().map(|(i, (name, value))| Point {
        x: *value,
        y: Some(i as f64),
        title: format!("{name}: {}", number(*value)),
    });
    Chart {
        title: title.to_owned(),
        description: values
            .iter()
            .map(|(name, value)| format!("{name}: {} {quantity}.", number(*value)))
            .collect::<Vec<_>>()
            .join(" "),
        x: Axis {
            label: quantity.to_owned(),
            scale: Scale::Linear,
            format: Format::Number,
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
