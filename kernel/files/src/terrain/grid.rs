//! ESRI ASCII grids: a head with the place of the raster, then its rows from north to south.

use super::fault;
use proctor_kernel::sheet::Sheet;
use proctor_scene::SceneError;
use std::path::Path;

/// Words of the head.
const HEAD: &str = "a head of `ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`, `cellsize`, and if \
                    need be `NODATA_value`, each with a number on a line of its own";
/// Largest number of values that are read.
const MOST: f64 = 1e9;

/// The head of a raster.
#[derive(Default)]
struct Head {
    columns: Option<f64>,
    rows: Option<f64>,
    size: Option<f64>,
    /// Lower left coordinate per axis, and whether it is that of the centre of a cell.
    lower: [Option<(f64, bool)>; 2],
    no_data: Option<f64>,
}

/// The raster as a sheet. Its values hold at the centres of its cells; over the outer half of the outermost cells they run on as
/// between the two nearest centres, so that the sheet covers the whole raster.
pub(super) fn read(file: &Path, text: &str) -> Result<Sheet, SceneError> {
    let mut head = Head::default();
    let mut lines = text.lines().enumerate().peekable();
    while let Some(&(i, line)) = lines.peek() {
        let mut words = line.split_whitespace();
        let Some(word) = words.next() else {
            lines.next();
            continue;
        };
        if !word.starts_with(|c: char| c.is_ascii_alphabetic()) || is_no_number(word) {
            break;
        }
        let value = words.next().and_then(|text| text.parse::<f64>().ok());
        let Some(value) = value.filter(|value| value.is_finite() && words.next().is_none()) else {
            return Err(fault(file, (i + 1, 1), format!("{line:?}"), HEAD));
        };
        match word.to_ascii_lowercase().as_str() {
            "ncols" => head.columns = Some(value),
            "nrows" => head.rows = Some(value),
            "cellsize" => head.size = Some(value),
            "xllcorner" => head.lower[0] = Some((value, false)),
            "yllcorner" => head.lower[1] = Some((value, false)),
            "xllcenter" => head.lower[0] = Some((value, true)),
            "yllcenter" => head.lower[1] = Some((value, true)),
            "nodata_value" => head.no_data = Some(value),
            _ => return Err(fault(file, (i + 1, 1), format!("{word:?}"), HEAD)),
        }
        lines.next();
    }
    let first = lines.peek().map_or(1, |(i, _)| i + 1);
    let (Some(columns), Some(rows), Some(size), [Some(x), Some(y)]) =
        (head.columns, head.rows, head.size, head.lower)
    else {
        return Err(fault(file, (first, 1), "a head that ends too early", HEAD));
    };
    let is_count = |n: f64| n >= 2.0 && n.fract() == 0.0;
    if !(is_count(columns) && is_count(rows) && columns * rows <= MOST && size > 0.0) {
        return Err(fault(
            file,
            (1, 1),
            format!("{columns} columns and {rows} rows of cells of {size} m"),
            "whole numbers of 2 or more, and a size greater than 0 [m]",
        ));
    }
    let (columns, rows) = (columns as usize, rows as usize);
    let values = values(file, lines, [columns, rows], head.no_data)?;
    let ticks = |(lower, is_centre): (f64, bool), count: usize| -> Vec<f64> {
        let corner = if is_centre { lower - 0.5 * size } else { lower };
        let centres = (0..count).map(|i| corner + (i as f64 + 0.5) * size);
        let ends = [corner, corner + count as f64 * size];
        std::iter::once(ends[0])
            .chain(centres)
            .chain([ends[1]])
            .collect()
    };
    // From south to north, each row and then all rows with one value more at both ends.
    let wide: Vec<Vec<f64>> = (values.chunks(columns).rev()).map(extended).collect();
    let mut all = vec![vec![]; rows + 2];
    for column in 0..columns + 2 {
        let along: Vec<f64> = wide.iter().map(|row| row[column]).collect();
        for (row, value) in extended(&along).into_iter().enumerate() {
            all[row].push(value);
        }
    }
    Ok(Sheet::grid(
        &ticks(x, columns),
        &ticks(y, rows),
        &all.concat(),
    ))
}

/// Words that stand for no number where values are.
fn is_no_number(word: &str) -> bool {
    word.eq_ignore_ascii_case("nan") || word.eq_ignore_ascii_case("inf")
}

/// Values with one more at each end, half a cell away, on the line through the two nearest.
fn extended(values: &[f64]) -> Vec<f64> {
    let end = |outer: f64, inner: f64| {
        if inner.is_finite() {
            1.5 * outer - 0.5 * inner
        } else {
            outer
        }
    };
    let last = values.len() - 1;
    let (first, after) = (
        end(values[0], values[1]),
        end(values[last], values[last - 1]),
    );
    [&[first], values, &[after]].concat()
}

/// The values in the order of the file; not a number where there is none.
fn values<'a>(
    file: &Path,
    lines: impl Iterator<Item = (usize, &'a str)>,
    [columns, rows]: [usize; 2],
    no_data: Option<f64>,
) -> Result<Vec<f64>, SceneError> {
    let mut values = Vec::new();
    let mut last = 1;
    for (i, line) in lines {
        for word in line.split_whitespace() {
            let column = word.as_ptr() as usize - line.as_ptr() as usize + 1;
            let value = word.parse::<f64>().ok();
            let Some(value) = value.filter(|value| value.is_finite() || is_no_number(word)) else {
                return Err(fault(
                    file,
                    (i + 1, column),
                    format!("{word:?}"),
                    "a number",
                ));
            };
            if values.len() == columns * rows {
                return Err(fault(
                    file,
                    (i + 1, column),
                    format!("more than {rows} rows of {columns} values"),
                    format!("{} values", columns * rows),
                ));
            }
            let is_none = no_data == Some(value) || !value.is_finite();
            values.push(if is_none { f64::NAN } else { value });
        }
        last = i + 1;
    }
    if values.len() < columns * rows {
        return Err(fault(
            file,
            (last, 1),
            format!("{} values", values.len()),
            format!("{} values: {rows} rows of {columns}", columns * rows),
        ));
    }
    Ok(values)
}
