//! Charts of the histories of runs: columns that belong together over time, and several runs in one chart.

use super::super::chart::{
    Axis, Chart, Colour, Entry, Format, Mark, Point, Scale, Series, Strength, Stroke,
};
use crate::refine::quantity::unit;
use crate::runs::RunHistory;

/// Most points of a line; of more the least and the largest of each stretch are drawn.
const MOST_POINTS: usize = 1200;
/// Most charts of a run: a line of probes may have hundreds of columns.
pub const MOST_CHARTS: usize = 40;
/// Largest value of a column over that of its group below which it is left out.
const ROUND_OFF: f64 = 1e-9;
/// Strokes of the runs.
const STROKES: [Stroke; 4] = [
    Stroke::Solid,
    Stroke::Dashed,
    Stroke::Dotted,
    Stroke::DashDotted,
];

/// Columns that are drawn in one chart.
struct Group {
    title: String,
    label: String,
    /// Place in the order of charts.
    rank: usize,
    /// Columns, each with its name in the legend.
    columns: Vec<(String, String)>,
    /// True where the change since the start is drawn.
    is_change: bool,
}

/// Charts of the histories of runs, each run with its name; motion of probes first, energies last. Columns that are zero
/// but for round-off are left out.
#[must_use]
pub fn histories(runs: &[(String, &RunHistory)]) -> Vec<Chart> {
    let groups = groups(runs);
    groups
        .iter()
        .take(MOST_CHARTS)
        .map(|group| chart(group, runs))
        .collect()
}

fn groups(runs: &[(String, &RunHistory)]) -> Vec<Group> {
    let mut groups: Vec<Group> = vec![];
    for (_, history) in runs {
        for (name, values) in &history.columns {
            let is_known = groups
                .iter()
                .any(|g| g.columns.iter().any(|(known, _)| known == name));
            let is_nothing = values.iter().all(|v| v.is_nan() || *v == 0.0);
            let Some(place) = (!is_known && !is_nothing)
                .then(|| Place::of(name))
                .flatten()
            else {
                continue;
            };
            let entry = (name.clone(), place.entry);
            if let Some(group) = groups.iter_mut().find(|group| group.title == place.title) {
                group.columns.push(entry);
            } else {
                groups.push(Group {
                    title: place.title,
                    label: place.label,
                    rank: place.rank,
                    columns: vec![entry],
                    is_change: place.is_change,
                });
            }
        }
    }
    let largest = |column: &str| {
        let values = runs
            .iter()
            .filter_map(|(_, history)| history.column(column))
            .flatten();
        values.copied().map(f64::abs).fold(0.0, f64::max)
    };
    for group in &mut groups {
        // What is round-off beside the others is a line at zero.
        let sizes: Vec<f64> = group
            .columns
            .iter()
            .map(|(column, _)| largest(column))
            .collect();
        let most = sizes.iter().copied().fold(0.0, f64::max);
        let mut sizes = sizes.into_iter();
        group
            .columns
            .retain(|_| sizes.next().is_some_and(|size| size > ROUND_OFF * most));
    }
    groups.sort_by_key(|group| group.rank);
    groups
}

/// Place of a column.
struct Place {
    title: String,
    label: String,
    rank: usize,
    entry: String,
    is_change: bool,
}

impl Place {
    /// The place of a column; `None` for those that are not drawn.
    fn of(name: &str) -> Option<Self> {
        let is_left_out = matches!(
            name,
            "step" | "velocity_time" | "nominal_time" | "kinetic_energy"
        ) || name.ends_with("_mass")
            || name.ends_with("_particle");
        if is_left_out {
            return None;
        }
        let place = |title: String, what: &str, rank: usize, entry: &str| Self {
            title,
            label: match unit(name) {
                "" => what.to_owned(),
                unit => format!("{what} ({unit})"),
            },
            rank,
            entry: entry.to_owned(),
            is_change: false,
        };
        if name.contains("energy") {
            let of_body = name
                .split_once("_energy_")
                .filter(|(body, _)| body.starts_with("body"));
            if let Some((body, word)) = of_body {
                return Some(place(format!("{body}: energy"), "energy", 7, word));
            }
            let word = name.replace("energy_", "").replace("_energy", "");
            return Some(place(
                "Energy".to_owned(),
                "energy",
                6,
                &word.replace('_', " "),
            ));
        }
        if let Some(axis) = name.strip_prefix("momentum_") {
            return Some(place("Momentum".to_owned(), "momentum", 8, axis));
        }
        let kinds = [
            ("contact_f", "contact force", 3),
            ("u", "displacement", 0),
            ("v", "velocity", 1),
            ("s", "stress", 2),
        ];
        if let Some((of, end)) = name.rsplit_once('_') {
            let of_body = usize::from(of.starts_with("body"));
            for (word, what, rank) in kinds {
                let of = of.strip_suffix("_contact").unwrap_or(of);
                let end = match word {
                    "contact_f" => name.split_once("_contact_f").map(|(_, axis)| axis),
                    _ => end.strip_prefix(word),
                };
                let is_axis = |end: &str| !end.is_empty() && end.chars().all(|c| "xyz".contains(c));
                if let Some(end) = end.filter(|end| is_axis(end)) {
                    return Some(place(
                        format!("{of}: {what}"),
                        what,
                        rank + 2 * of_body,
                        end,
                    ));
                }
            }
            if ["x", "y", "z"].contains(&end) && of_body == 1 {
                let mut found = place(
                    format!("{of}: motion of the centre"),
                    "since the start",
                    2,
                    end,
                );
                found.is_change = true;
                return Some(found);
            }
        }
        Some(place(name.to_owned(), name, 4, name))
    }
}

fn chart(group: &Group, runs: &[(String, &RunHistory)]) -> Chart {
    let (mut series, mut legend) = (vec![], vec![]);
    let look = |colour: Colour, stroke: Stroke, points: Vec<Point>| Series {
        colour,
        mark: Mark::None,
        stroke,
        strength: Strength::Plain,
        points,
    };
    for (i, (column, entry)) in group.columns.iter().enumerate() {
        let colour = Colour::Hue(i);
        for ((_, history), stroke) in runs.iter().zip(STROKES.into_iter().cycle()) {
            if let Some(values) = history.column(column) {
                let start = values
                    .first()
                    .copied()
                    .filter(|_| group.is_change)
                    .unwrap_or(0.0);
                series.push(look(colour, stroke, points(&history.times, values, start)));
            }
        }
        if group.columns.len() > 1 {
            legend.push(line_of_legend(entry, colour, Stroke::Solid));
        }
    }
    if runs.len() > 1 {
        for ((name, _), stroke) in runs.iter().zip(STROKES.into_iter().cycle()) {
            legend.push(line_of_legend(name, Colour::Ink, stroke));
        }
    }
    let linear = |label: &str| Axis {
        label: label.to_owned(),
        scale: Scale::Linear,
        format: Format::Number,
    };
    Chart {
        equal: false,
        title: group.title.clone(),
        description: format!("{} over time.", group.title),
        x: linear("time (s)"),
        y: linear(&group.label),
        series,
        guides: vec![],
        legend,
    }
}

fn line_of_legend(label: &str, colour: Colour, stroke: Stroke) -> Entry {
    Entry {
        label: label.to_owned(),
        colour,
        mark: Mark::None,
        stroke,
        strength: Strength::Plain,
        open: false,
    }
}

/// The points of a line less its start; of many the least and the largest of each stretch.
fn points(times: &[f64], values: &[f64], start: f64) -> Vec<Point> {
    let every = times.len().div_ceil(MOST_POINTS / 2).max(1);
    let mut kept: Vec<usize> = vec![];
    if every <= 2 {
        kept.extend(0..times.len());
    } else {
        for from in (0..times.len()).step_by(every) {
            let stretch = from..(from + every).min(times.len());
            let by = |i: &usize, j: &usize| values[*i].total_cmp(&values[*j]);
            let ends = [stretch.clone().min_by(by), stretch.max_by(by)];
            let mut ends: Vec<usize> = ends.into_iter().flatten().collect();
            ends.sort_unstable();
            ends.dedup();
            kept.extend(ends);
        }
    }
    let point = |i: usize| Point {
        x: times[i],
        y: Some(values[i] - start),
        title: String::new(),
    };
    kept.into_iter().map(point).collect()
}
