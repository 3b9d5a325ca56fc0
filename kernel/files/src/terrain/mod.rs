//! Terrains: surfaces of ground from files, as a line, as a raster or as triangles.

mod grid;
mod points;

use std::path::Path;

use crate::records::Table;
use crate::stl;
use proctor_kernel::sheet::Sheet;
use proctor_scene::{Dimension, Location, Problem, SceneError};

/// Reads a surface of ground.
///
/// In three dimensions that is an ESRI ASCII grid (its first word is `ncols`), an STL file (its name ends with `.stl`), or a
/// table of x, y and z on a regular grid; in two dimensions a table of x and y in ascending order of x.
///
/// # Errors
/// Each fault of the file, with line and column where there are some.
pub fn read(file: &Path, dimension: Dimension) -> Result<Sheet, SceneError> {
    if dimension == Dimension::Two {
        return points::line(file);
    }
    if (file.extension()).is_some_and(|ending| ending.eq_ignore_ascii_case("stl")) {
        return triangles(file);
    }
    let text = Table::text(
        file,
        "an ESRI ASCII grid, or a table of x, y, z on a regular grid",
    )?;
    let first = text.split_whitespace().next().unwrap_or("");
    if first.eq_ignore_ascii_case("ncols") || first.eq_ignore_ascii_case("nrows") {
        return grid::read(file, &text);
    }
    points::grid(file)
}

/// The triangles of an STL file.
fn triangles(file: &Path) -> Result<Sheet, SceneError> {
    let surface = stl::read(file).map_err(|error| {
        let found = format!("{}: {}", file.display(), error.kind);
        SceneError {
            problems: vec![Problem::new("", found, error.kind.accepted())],
        }
    })?;
    let (corners, triangles) = (surface.vertices(), surface.triangles());
    Ok(Sheet::triangles(corners.to_vec(), triangles.to_vec()))
}

/// One fault of a file as the error of all.
fn fault(
    file: &Path,
    (line, column): (usize, usize),
    found: impl Into<String>,
    accepted: impl Into<String>,
) -> SceneError {
    SceneError {
        problems: vec![Problem::new("", found, accepted).at(Location {
            file: file.display().to_string(),
            line,
            column,
        })],
    }
}
