//! Lists of particles: a table in a text file, or rows in JSON.

use super::table::{Table, padded};
use proctor_scene::{Dimension, Location, ParticleSeed, Problem, SceneError};
use std::path::Path;

/// Reads a particle list: columns x, y, in three dimensions z, and volume, as a table or as rows in JSON.
///
/// A header is found by looking. Where it has these names in another order, so are the columns.
///
/// # Errors
/// As for [`read`](super::read), and volumes that are not greater than zero.
pub fn read_particles(file: &Path, dimension: Dimension) -> Result<Vec<ParticleSeed>, SceneError> {
    let names: &[&str] = match dimension {
        Dimension::Two => &["x", "y", "volume"],
        Dimension::Three => &["x", "y", "z", "volume"],
    };
    let axes = dimension.axes();
    let text = Table::text(
        file,
        &format!("a text file with the columns {}", names.join(", ")),
    )?;
    if text
        .trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with('[')
    {
        return from_json(file, &text, axes);
    }
    let mut table = Table::read(file, None, names)?;
    let order = order(table.header.as_deref(), names);
    for row in 0..table.rows.len() {
        let volume = table.rows[row].numbers[order[axes]];
        if volume <= 0.0 {
            let at = (table.rows[row].line, table.rows[row].columns[order[axes]]);
            table.add(
                at,
                format!("the volume {volume}"),
                "a volume greater than 0 [m³]",
            );
        }
    }
    let rows = table.finish()?;
    Ok(rows
        .iter()
        .map(|row| {
            let position: Vec<f64> = order[..axes].iter().map(|k| row.numbers[*k]).collect();
            ParticleSeed {
                position: padded(&position),
                volume: row.numbers[order[axes]],
            }
        })
        .collect())
}

/// Column of each name: by the header if it has all of them, else by their order.
fn order(header: Option<&[String]>, names: &[&str]) -> Vec<usize> {
    let place = |name: &&str| header?.iter().position(|known| known == name);
    let by_name: Option<Vec<usize>> = names.iter().map(place).collect();
    by_name.unwrap_or_else(|| (0..names.len()).collect())
}

/// Rows of numbers in JSON.
fn from_json(file: &Path, text: &str, axes: usize) -> Result<Vec<ParticleSeed>, SceneError> {
    let refused = |(line, column): (usize, usize), found: String, accepted: String| SceneError {
        problems: vec![Problem::new("", found, accepted).at(Location {
            file: file.display().to_string(),
            line,
            column,
        })],
    };
    let accepted = format!("rows of {} numbers, position and volume", axes + 1);
    let rows: Vec<Vec<f64>> =
        serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|error| {
            let words = error.to_string();
            let found = words.split(" at line ").next().unwrap_or(&words).to_owned();
            refused((error.line(), error.column()), found, accepted.clone())
        })?;
    let mut seeds = Vec::with_capacity(rows.len());
    for (i, row) in rows.iter().enumerate() {
        let found = match row[..] {
            [.., volume] if row.len() == axes + 1 && volume > 0.0 => None,
            [.., volume] if row.len() == axes + 1 => Some(format!("the volume {volume}")),
            _ => Some(format!("a list of length {}", row.len())),
        };
        if let Some(found) = found {
            let accepted = format!(
                "{} numbers, the last a volume greater than 0 [m³]",
                axes + 1
            );
            return Err(refused(place_of_row(text, i), found, accepted));
        }
        seeds.push(ParticleSeed {
            position: padded(&row[..axes]),
            volume: row[axes],
        });
    }
    Ok(seeds)
}

/// Line and column at which a row of a list of rows begins.
fn place_of_row(text: &str, row: usize) -> (usize, usize) {
    let begin = text.match_indices('[').nth(row + 1).map_or(0, |(at, _)| at);
    let before = &text[..begin];
    let line_begin = before.rfind('\n').map_or(0, |at| at + 1);
    (
        before.matches('\n').count() + 1,
        before[line_begin..].chars().count() + 1,
    )
}
