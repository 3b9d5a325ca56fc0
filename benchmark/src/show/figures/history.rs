//! Charts of a history: how many numbers changed at each record, and the numbers that changed most.

use crate::history::{ChangePoint, History, Series as Numbers};
use crate::record::details::Figure;
use crate::record::{Meaning, key};
use crate::show::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Point, Scale, Series, Strength, Stroke,
};
use crate::show::history::{Tally, change, day, largest, short, written};

/// Numbers that get a chart of their own.
const DRAWN: usize = 8;
/// Change points of a number that are marked in its chart.
const MARKED: usize = 6;

/// All charts, each with a name for a file.
#[must_use]
pub fn all(history: &History) -> Vec<(String, Figure)> {
    let changes = history.change_points();
    let mut figures = vec![("changes".to_owned(), overview(history, &changes))];
    let mut drawn: Vec<usize> = vec![];
    for found in largest(history, &changes) {
        let found = found.change;
        if drawn.len() == DRAWN {
            break;
        }
        if !drawn.contains(&found.series) {
            drawn.push(found.series);
            let series = &history.series[found.series];
            let name = format!("{:02}-{}", drawn.len(), key(&series.name()));
            figures.push((
                name,
                of_number(history, series, &series.change_points(found.series)),
            ));
        }
    }
    figures
}

/// A way in which numbers changed: its word, its look, and how many of a record did.
type Kind = (&'static str, Colour, Mark, fn(&Tally) -> usize);

/// Numbers of values that became worse and better at each record.
fn overview(history: &History, changes: &[ChangePoint]) -> Figure {
    let tallies = Tally::of(history, changes);
    let kinds: [Kind; 4] = [
        ("close", Colour::Hue(6), Mark::Dot, |tally| tally.close),
        ("moved", Colour::Hue(0), Mark::Square, |tally| tally.moved),
        ("better", Colour::Hue(2), Mark::Circle, |tally| tally.better),
        ("worse", Colour::Hue(1), Mark::Triangle, |tally| tally.worse),
    ];
    let series = kinds.iter().map(|&(word, colour, mark, of)| {
        let counted = tallies
            .iter()
            .enumerate()
            .filter(|(_, tally)| of(tally) > 0);
        let points = counted.map(|(at, tally)| Point {
            x: at as f64 + 1.0,
            y: Some(of(tally) as f64),
            title: format!("{}: {} {word}", place(history, at), of(tally)),
        });
        look(colour, mark, Stroke::None, points.collect())
    });
    let legend = kinds.iter().map(|&(word, colour, mark, _)| Entry {
        label: word.to_owned(),
        colour,
        mark,
        stroke: Stroke::None,
        strength: Strength::Plain,
        open: false,
    });
    Figure {
        caption:
            "Numbers that changed at each record; close: by no more than sums in another order do."
                .to_owned(),
        chart: Chart {
            title: "Changes of the history".to_owned(),
            description: format!(
                "{} changes in {} records.",
                changes.len(),
                history.points.len()
            ),
            x: records(),
            y: Axis {
                label: "numbers that changed".to_owned(),
                scale: Scale::Log,
                format: Format::Number,
            },
            series: series.collect(),
            guides: vec![],
            legend: legend.collect(),
            equal: false,
        },
    }
}

/// A number over the records, its change points as broken lines.
fn of_number(history: &History, series: &Numbers, changes: &[ChangePoint]) -> Figure {
    let known = || series.values.iter().flatten();
    let points = series.values.iter().enumerate().filter_map(|(at, value)| {
        let value = (*value)?;
        Some(Point {
            x: at as f64 + 1.0,
            y: Some(value),
            title: format!("{}: {}", place(history, at), written(series, value)),
        })
    });
    let (low, high) = known().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(*value), high.max(*value))
    });
    let mut marked: Vec<&ChangePoint> = changes.iter().collect();
    marked.sort_by(|a, b| b.loss.abs().total_cmp(&a.loss.abs()));
    let guides = marked.iter().take(MARKED).map(|found| {
        let x = found.at as f64 + 0.5;
        Guide {
            from: [x, low],
            to: [x, high],
            label: change(found),
        }
    });
    let format = match series.meaning {
        _ if series.is_time() => Format::Seconds,
        Meaning::Error => Format::Percent,
        _ => Format::Number,
    };
    Figure {
        caption: format!(
            "{} over the records; broken lines are its change points.",
            series.name()
        ),
        chart: Chart {
            title: series.name(),
            description: format!("{} change points.", changes.len()),
            x: records(),
            y: Axis {
                label: if series.is_time() {
                    "median time".to_owned()
                } else {
                    series.number.clone()
                },
                scale: if low > 0.0 { Scale::Log } else { Scale::Linear },
                format,
            },
            guides: guides.collect(),
            series: vec![look(
                Colour::Hue(0),
                Mark::Dot,
                Stroke::Solid,
                points.collect(),
            )],
            legend: vec![],
            equal: false,
        },
    }
}

fn look(colour: Colour, mark: Mark, stroke: Stroke, points: Vec<Point>) -> Series {
    Series {
        colour,
        mark,
        stroke,
        strength: Strength::Plain,
        points,
    }
}

fn records() -> Axis {
    Axis {
        label: "record".to_owned(),
        scale: Scale::Linear,
        format: Format::Number,
    }
}

/// Number, commit, day and subject of a record.
fn place(history: &History, at: usize) -> String {
    let point = &history.points[at];
    format!(
        "{}, {} {}, {}",
        at + 1,
        short(point),
        day(point),
        point.subject
    )
}
