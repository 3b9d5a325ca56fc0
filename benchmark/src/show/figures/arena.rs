//! The picture of an arena: error against processor time, one chart for each case, one look for each solver.

use crate::arena::{Board, Mesh};
use crate::precision::findings::LEVELS;
use crate::show::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Point, Scale, Series, Strength, Stroke,
    side_by_side,
};
use crate::show::{number, percent, seconds};

/// Marks, one solver after the other.
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond];
/// Columns of the picture.
const COLUMNS: usize = 3;
/// The quantity of the horizontal axis.
const TIME: &str = "CPU time of the process without its start-up";

/// The picture as an SVG document.
#[must_use]
pub fn arena(board: &Board) -> String {
    let title = "Error against CPU time, solver by case; down and to the left is better";
    side_by_side(title, &arena_charts(board), &arena_legend(board), COLUMNS)
}

/// One chart for each case, without legends.
#[must_use]
pub fn arena_charts(board: &Board) -> Vec<Chart> {
    board.judged().map(|case| chart(board, case)).collect()
}

/// The legend of colours and marks; a solver that took no part has none.
#[must_use]
pub fn arena_legend(board: &Board) -> Vec<Entry> {
    let looks = board.solvers.iter().zip(looks(board));
    looks
        .filter(|(solver, _)| solver.failed.is_none() && solver.skipped.is_none())
        .map(|(solver, (colour, mark, stroke))| Entry {
            label: solver.name.clone(),
            colour,
            mark,
            stroke,
            strength: Strength::Plain,
            open: false,
        })
        .collect()
}

/// This program's methods in the colour of text, the others each in one of the palette.
fn looks(board: &Board) -> Vec<(Colour, Mark, Stroke)> {
    let mut guests = 0;
    let solvers = board.solvers.iter().enumerate();
    solvers
        .map(|(i, solver)| {
            if Board::is_own(&solver.name) {
                (Colour::Ink, MARKS[i % MARKS.len()], Stroke::Dashed)
            } else {
                guests += 1;
                (
                    Colour::Hue(guests - 1),
                    MARKS[(guests - 1) % MARKS.len()],
                    Stroke::Solid,
                )
            }
        })
        .collect()
}

fn chart(board: &Board, case: &str) -> Chart {
    let series: Vec<Series> = board
        .solvers
        .iter()
        .zip(looks(board))
        .filter_map(|(solver, (colour, mark, stroke))| {
            let cell = board.cell(case, &solver.name)?;
            let points = cell.meshes.iter();
            Some(Series {
                colour,
                mark,
                stroke,
                strength: Strength::Plain,
                points: points
                    .filter_map(|mesh| point(&solver.name, mesh))
                    .collect(),
            })
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    let times = || series.iter().flat_map(|s| &s.points).map(|point| point.x);
    let ends = [
        times().fold(f64::INFINITY, f64::min),
        times().fold(f64::NEG_INFINITY, f64::max),
    ];
    let errors = || series.iter().flat_map(|s| &s.points).filter_map(|p| p.y);
    let least = errors().fold(f64::INFINITY, f64::min);
    let most = errors().fold(0.0, f64::max);
    let guides = LEVELS
        .into_iter()
        .filter(|level| (least..=most).contains(level))
        .map(|level| Guide {
            from: [ends[0], level],
            to: [ends[1], level],
            label: format!("{} %", 100.0 * level),
        });
    Chart {
        title: case.to_owned(),
        description: format!(
            "Relative error of each solver on {case} against processor time, from coarse to fine meshes."
        ),
        x: Axis {
            label: TIME.to_owned(),
            scale: Scale::Log,
            format: Format::Seconds,
        },
        y: Axis {
            label: "relative error".to_owned(),
            scale: Scale::Log,
            format: Format::Percent,
        },
        guides: guides.collect(),
        series,
        legend: vec![],
        equal: false,
    }
}

/// A run with a time; one that failed has no error.
fn point(solver: &str, mesh: &Mesh) -> Option<Point> {
    let time = mesh.seconds?;
    let found = match &mesh.error {
        Ok(error) => percent(*error),
        Err(reason) => reason.clone(),
    };
    Some(Point {
        x: time,
        y: mesh.error.as_ref().ok().copied(),
        title: format!(
            "{solver}, h = {}: {found}, {}",
            number(mesh.cell),
            seconds(time)
        ),
    })
}
