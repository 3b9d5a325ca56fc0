//! Charts of a refined scene: each quantity over the meshes, and its history with the band of its bars.

use super::super::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Point, Scale, Series, Strength, Stroke,
};
use super::super::number;
use crate::refine::judge::{QuantityBar, SceneBars};
use crate::refine::work::Runs;

/// Colours of values with a claimed bar and without one.
const CLAIMED: Colour = Colour::Hue(0);
const NOT_CLAIMED: Colour = Colour::Hue(6);
/// Colour of the extrapolated value, and of the moved meshes.
const LIMIT: Colour = Colour::Hue(1);
const MOVED: Colour = Colour::Hue(2);
/// Highest order to which the horizontal axis is bent.
const HIGHEST: f64 = 2.0;
/// Order of the axis where none was seen.
const USUAL: f64 = 1.0;

fn linear(label: String) -> Axis {
    Axis {
        label,
        scale: Scale::Linear,
        format: Format::Number,
    }
}

fn with_unit(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} in {unit}"),
    }
}

fn entry(label: &str, series: &Series) -> Entry {
    Entry {
        label: label.to_owned(),
        colour: series.colour,
        mark: series.mark,
        stroke: series.stroke,
        strength: series.strength,
        open: false,
    }
}

/// Values of a quantity over the power of the cell size with which they settle: a straight line is asymptotic.
#[must_use]
pub fn settling(refined: &SceneBars, judged: &QuantityBar, runs: &Runs) -> Chart {
    let name = &judged.quantity.name;
    let unit = judged.quantity.unit();
    let order = judged.estimate.order.filter(|order| *order >= 0.5);
    let order = order.map_or(USUAL, |order| (10.0 * order.min(HIGHEST)).round() / 10.0);
    let at = |cell: f64| libm::pow(cell, order);
    let claimed = judged.bar().is_some();
    let colour = if claimed { CLAIMED } else { NOT_CLAIMED };
    let point = |x: f64, y: f64, what: &str| Point {
        x,
        y: Some(y),
        title: format!("{what}: {} {unit}", number(y)),
    };
    let meshes = Series {
        colour,
        mark: Mark::Circle,
        stroke: if claimed {
            Stroke::Solid
        } else {
            Stroke::Dashed
        },
        strength: Strength::Plain,
        points: (runs.meshes.iter().zip(&judged.values))
            .map(|(run, value)| point(at(run.cell), *value, &format!("h = {} m", number(run.cell))))
            .collect(),
    };
    let mut legend = vec![entry("value on each mesh", &meshes)];
    let mut series = vec![meshes];
    let finest = at(refined.cells[2]);
    if let Some(bar) = judged.bar() {
        let bars = Series {
            colour: Colour::Ink,
            mark: Mark::Dot,
            stroke: Stroke::Solid,
            strength: Strength::Plain,
            points: [-bar, bar]
                .map(|side| point(finest, judged.value() + side, "end of the bar"))
                .to_vec(),
        };
        legend.push(entry("bar, 95 of 100 cases", &bars));
        series.push(bars);
    }
    if !judged.moved.is_empty() {
        let moved = Series {
            colour: MOVED,
            mark: Mark::Dot,
            stroke: Stroke::None,
            strength: Strength::Plain,
            points: judged
                .moved
                .iter()
                .filter(|value| value.is_finite())
                .map(|value| point(at(refined.cells[1]), *value, "moved mesh"))
                .collect(),
        };
        legend.push(entry("mesh moved by parts of a cell", &moved));
        series.push(moved);
    }
    if let Some(limit) = judged.extrapolated() {
        let line = [(finest, judged.value()), (0.0, limit)]
            .map(|(x, y)| point(x, y, "extrapolated to h = 0"));
        let of = |mark, stroke, points: &[Point]| Series {
            colour: LIMIT,
            mark,
            stroke,
            strength: Strength::Plain,
            points: points.to_vec(),
        };
        series.push(of(Mark::None, Stroke::Dotted, &line));
        let limit = of(Mark::Diamond, Stroke::None, &line[1..]);
        legend.push(entry("extrapolated; no bar is around it", &limit));
        series.push(limit);
    }
    Chart {
        equal: false,
        title: format!(
            "{}: {name} over the meshes, {}",
            refined.scene,
            judged.verdict()
        ),
        description: format!(
            "Values of {name} on meshes of {} cell sizes: {}.",
            judged.values.len(),
            judged.verdict()
        ),
        x: linear(power(order)),
        y: linear(with_unit(name, unit)),
        series,
        guides: vec![],
        legend,
    }
}

/// The label of an axis of a power of the cell size.
fn power(order: f64) -> String {
    let tenths = (10.0 * order).round();
    let word = match tenths {
        10.0 => return "cell size h in m".to_owned(),
        20.0 => "2".to_owned(),
        _ => format!("{order:.1}"),
    };
    format!("cell size h in m, to the power of {word}")
}

/// The history of a quantity on all meshes: the finest with the band of its bars.
#[must_use]
pub fn history(refined: &SceneBars, judged: &QuantityBar, runs: &Runs) -> Option<Chart> {
    let column = &judged.quantity.column;
    let unit = crate::refine::quantity::unit(column);
    let times = &refined.times;
    let claimed = judged.bar().is_some();
    let line = |values: &[f64], colour, stroke, strength, what: &str| Series {
        colour,
        mark: Mark::None,
        stroke,
        strength,
        points: (times.iter().zip(values))
            .map(|(time, value)| Point {
                x: *time,
                y: Some(*value).filter(|value| value.is_finite()),
                title: format!("{what}, {} s: {} {unit}", number(*time), number(*value)),
            })
            .collect(),
    };
    let (mut series, mut legend) = (vec![], vec![]);
    let (finest, coarser) = runs.meshes.split_last()?;
    for (k, run) in coarser.iter().enumerate() {
        let what = format!("h = {} m", number(run.cell));
        let values = run.columns.get(column)?;
        let stroke = [Stroke::Dotted, Stroke::Dashed][k % 2];
        let thin = line(values, Colour::Hue(6), stroke, Strength::Faint, &what);
        legend.push(entry(&what, &thin));
        series.push(thin);
    }
    let values = finest.columns.get(column)?;
    if claimed {
        for side in [-1.0, 1.0] {
            let edge: Vec<f64> = (values.iter().zip(&judged.curve))
                .map(|(value, bar)| {
                    if bar.verdict.claims() {
                        value + side * bar.width
                    } else {
                        f64::NAN
                    }
                })
                .collect();
            let edge = line(&edge, LIMIT, Stroke::Solid, Strength::Faint, "band");
            if side > 0.0 {
                legend.push(entry("band of the bars, where they are claimed", &edge));
            }
            series.push(edge);
        }
    }
    let colour = if claimed { CLAIMED } else { NOT_CLAIMED };
    let what = format!("h = {} m", number(finest.cell));
    let fine = line(values, colour, Stroke::Solid, Strength::Plain, &what);
    legend.push(entry(&what, &fine));
    series.push(fine);
    let all = series
        .iter()
        .flat_map(|series| &series.points)
        .filter_map(|point| point.y);
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
        (low.min(y), high.max(y))
    });
    let guides = refined.until().map(|until| Guide {
        from: [until, low],
        to: [until, high],
        label: format!("settles until {} s", number(until)),
    });
    // Points without a value end a band; they are no runs that failed.
    for series in &mut series {
        series.points.retain(|point| point.y.is_some());
    }
    Some(Chart {
        equal: false,
        title: format!("{}: {column} on all meshes", refined.scene),
        description: format!("{column} over time on {} meshes.", runs.meshes.len()),
        x: linear("time in s".to_owned()),
        y: linear(with_unit(column, unit)),
        series,
        guides: guides.into_iter().collect(),
        legend,
    })
}
