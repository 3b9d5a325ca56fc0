//! Points of a surface in a table: a line x, y, or x, y, z on a regular grid.

use super::fault;
use crate::records::Table;
use proctor_kernel::sheet::Sheet;
use proctor_scene::SceneError;
use std::path::Path;

/// A line of points in ascending order of x.
pub(super) fn line(file: &Path) -> Result<Sheet, SceneError> {
    let rows = Table::read(file, None, &["x", "y"])?.finish()?;
    let accepted = "at least two rows of x and y [m]";
    if rows.len() < 2 {
        let found = format!("{} row(s) of numbers", rows.len());
        return Err(fault(file, (1, 1), found, accepted));
    }
    for pair in rows.windows(2) {
        let [before, now] = [&pair[0], &pair[1]].map(|row| row.numbers[0]);
        if now <= before {
            return Err(fault(
                file,
                (pair[1].line, pair[1].columns[0]),
                format!("x = {now} after x = {before}"),
                "x in ascending order [m]: one height above each point",
            ));
        }
    }
    let points: Vec<[f64; 2]> = (rows.iter())
        .map(|row| [row.numbers[0], row.numbers[1]])
        .collect();
    Ok(Sheet::polyline(&points))
}

/// Points on a regular grid, in any order. A point of the grid without a row is a hole.
pub(super) fn grid(file: &Path) -> Result<Sheet, SceneError> {
    let rows = Table::read(file, None, &["x", "y", "z"])?.finish()?;
    let [x, y] = [0, 1].map(|axis| {
        let mut ticks: Vec<f64> = rows.iter().map(|row| row.numbers[axis]).collect();
        ticks.sort_unstable_by(f64::total_cmp);
        ticks.dedup();
        ticks
    });
    let accepted = "points on a regular grid: each x with each y, two or more of both [m]";
    // At least half of the points of the grid: scattered points would make a grid of their square.
    if x.len() < 2 || y.len() < 2 || x.len() as f64 * y.len() as f64 > 2.0 * rows.len() as f64 {
        let found = format!(
            "{} points with {} different x and {} different y",
            rows.len(),
            x.len(),
            y.len()
        );
        return Err(fault(file, (1, 1), found, accepted));
    }
    let mut heights = vec![f64::NAN; x.len() * y.len()];
    for row in &rows {
        let place = |ticks: &[f64], at: f64| ticks.partition_point(|tick| *tick < at);
        let here = place(&y, row.numbers[1]) * x.len() + place(&x, row.numbers[0]);
        if heights[here].is_finite() {
            let found = format!("a second point at ({}, {})", row.numbers[0], row.numbers[1]);
            return Err(fault(file, (row.line, 1), found, "each point once"));
        }
        heights[here] = row.numbers[2];
    }
    Ok(Sheet::grid(&x, &y, &heights))
}
