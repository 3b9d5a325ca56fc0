//! The chart of error against run time.

use super::slopes::slopes;
use crate::precision::choices::{SCHEMES, TRANSFERS, WEIGHTINGS};
use crate::precision::{CaseStudy, Findings, Line, PeerLine, PeerRun};
use crate::show::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Point, Scale, Series, Strength, Stroke,
};
use crate::show::{number, seconds};
use proctor_verification::settings::Method;

/// Marks of the stress schemes, in the order of [`SCHEMES`].
const SCHEME_MARKS: [Mark; 3] = [Mark::Circle, Mark::Square, Mark::Triangle];
/// Strokes of the transfers, in the order of [`TRANSFERS`].
const TRANSFER_STROKES: [Stroke; 4] = [
    Stroke::Solid,
    Stroke::Dashed,
    Stroke::Dotted,
    Stroke::DashDotted,
];
/// Error against run time of one measure of a study: paths of refinement as lines, sweeps as dots, runs that failed as
/// open marks above the plot, the front of the best runs as a broad band. Lines that have a run on the front or reach
/// a level of error at the least cost stand out.
#[must_use]
pub fn error_against_time(studied: &CaseStudy, measure: usize) -> Chart {
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
        let (colour, mark, stroke) = look(line.method);
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
    for (i, peer) in studied.peers_of(measure).iter().enumerate() {
        let (colour, mark, stroke) = peer_look(i);
        let points = peer.runs.iter();
        series.push(Series {
            colour,
            mark,
            stroke,
            strength: Strength::Plain,
            points: points
                .filter_map(|run| peer_point(peer, run, studied.threads))
                .collect(),
        });
    }
    series.retain(|series| !series.points.is_empty());
    Chart {
        equal: false,
        title: format!(
            "{}: error of the {word} against run time",
            studied.study.name()
        ),
        description: description(&findings, word),
        x: Axis {
            label: time_words(studied, measure),
            scale: Scale::Log,
            format: Format::Seconds,
        },
        y: Axis {
            label: format!("relative error of the {word}"),
            scale: Scale::Log,
            format: Format::Percent,
        },
        guides: order_guides(&series, studied.study.refined_axes()),
        legend: legend(studied, measure, &series),
        series,
    }
}

/// Name of the time, of methods and of other solvers.
fn time_words(studied: &CaseStudy, measure: usize) -> String {
    let words = studied.seconds_words();
    if studied.peers_of(measure).is_empty() {
        words.to_owned()
    } else {
        format!("{words}; of (process) all of it")
    }
}

/// Colour, mark and stroke of another solver: none has the mark of a scheme.
fn peer_look(number: usize) -> (Colour, Mark, Stroke) {
    let stroke = if number.is_multiple_of(2) {
        Stroke::Solid
    } else {
        Stroke::Dashed
    };
    (
        Colour::Hue(WEIGHTINGS.len() + number),
        Mark::Diamond,
        stroke,
    )
}

/// A run of another solver as a point; `None` if it has no time.
fn peer_point(peer: &PeerLine, run: &PeerRun, threads: usize) -> Option<Point> {
    let time = run.seconds(threads)?;
    let outcome = match &run.error {
        Ok(error) => format!("error {} %, {}", number(100.0 * error), seconds(time)),
        Err(reason) => format!("failed after {}: {reason}", seconds(time)),
    };
    let particles = run.particles;
    let particles = particles.map_or_else(String::new, |n| format!(", {n} particles"));
    Some(Point {
        x: time,
        y: run.error.as_ref().ok().copied(),
        title: format!(
            "{}, whole process, {}\n{outcome}{particles}",
            peer.name, run.rung.label
        ),
    })
}

/// Colour, mark and stroke of a method.
fn look(method: Method) -> (Colour, Mark, Stroke) {
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
pub(super) fn point(studied: &CaseStudy, measure: usize, i: usize) -> Option<Point> {
    let (choice, run) = (&studied.plan.choices[i], studied.runs.get(i)?);
    let settings = &choice.settings;
    let time = studied.seconds(i)?;
    let error = run.error(measure);
    let outcome = match &error {
        Ok(error) => format!("error {} %, {}", number(100.0 * error), seconds(time)),
        Err(reason) => format!("failed after {}: {reason}", seconds(time)),
    };
    let counts = run.found.as_ref().map_or_else(
        |_| String::new(),
        |found| {
            format!(
                ", {} particles, {} steps, dt/critical {}",
                found.particles,
                found.steps,
                number(found.dt_over_critical)
            )
        },
    );
    let unsafe_step = if settings.method.has_safe_step() {
        ""
    } else {
        "; no step is safe for every body"
    };
    let title = format!(
        "{}, {}, C = {}, {} particles per cell and axis\n{outcome}{counts}{unsafe_step}",
        settings.method,
        choice.rung.label,
        number(settings.courant_or_automatic()),
        settings.particles_per_cell
    );
    Some(Point {
        x: time,
        y: error.ok(),
        title,
    })
}

/// Description of the chart, in words.
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

/// Slopes of orders 1 and 2, error like T^(-p/(d+1)), where they are farthest from the runs.
fn order_guides(series: &[Series], axes: usize) -> Vec<Guide> {
    let slope = |order: i32| -f64::from(order) / (axes as f64 + 1.0);
    slopes(series, slope)
}

/// Entries for what occurs: colours, marks, strokes, dots, open marks, the front.
fn legend(studied: &CaseStudy, measure: usize, series: &[Series]) -> Vec<Entry> {
    let lines = &studied.plan.lines;
    let any = |test: &dyn Fn(Method) -> bool| lines.iter().any(|line| test(line.method));
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
    for (i, peer) in studied.peers_of(measure).iter().enumerate() {
        let (colour, mark, stroke) = peer_look(i);
        if peer.runs.iter().all(|run| run.samples.is_empty()) {
            continue;
        }
        push(&format!("{} (process)", peer.name), colour, mark, stroke);
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
