//! Errors of a refinement study and the orders they show: one table type for all cases.

use std::fmt;

/// One resolution of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Cell size h (or time step, whatever is refined), SI.
    pub h: f64,
    /// One error per quantity of the table; NaN where the run failed.
    pub errors: Vec<f64>,
    /// Particles in the run.
    pub particles: usize,
    /// Steps of the run.
    pub steps: usize,
}

/// Errors of named quantities over a series of refinements, coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergenceTable {
    quantities: Vec<String>,
    rows: Vec<Row>,
}

/// A row whose number of errors is not that of the table's quantities.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrongErrorCount {
    /// Quantities of the table.
    pub expected: usize,
    /// Errors in the row.
    pub found: usize,
}

impl fmt::Display for WrongErrorCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a row with {} errors in a table of {} quantities",
            self.found, self.expected
        )
    }
}

impl std::error::Error for WrongErrorCount {}

/// Rows that the fitted order looks at.
const FITTED_ROWS: usize = 3;

impl ConvergenceTable {
    /// An empty table of the named quantities.
    #[must_use]
    pub fn new<S: Into<String>>(quantities: impl IntoIterator<Item = S>) -> Self {
        Self {
            quantities: quantities.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a finer row.
    ///
    /// # Errors
    /// [`WrongErrorCount`] if the row has not one error per quantity.
    pub fn push(&mut self, row: Row) -> Result<(), WrongErrorCount> {
        if row.errors.len() != self.quantities.len() {
            return Err(WrongErrorCount {
                expected: self.quantities.len(),
                found: row.errors.len(),
            });
        }
        self.rows.push(row);
        Ok(())
    }

    /// Names of the quantities.
    #[must_use]
    pub fn quantities(&self) -> &[String] {
        &self.quantities
    }

    /// Rows, in the order they were added.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Observed order of a quantity between row `row - 1` and row `row`, `ln(e1/e2)/ln(h1/h2)`.
    ///
    /// Negative where the error grows. `None` without a row before, without refinement, and where an error is zero,
    /// negative, infinite or NaN: there is no order to speak of then.
    #[must_use]
    pub fn order(&self, quantity: usize, row: usize) -> Option<f64> {
        let before = self.point(quantity, row.checked_sub(1)?)?;
        let here = self.point(quantity, row)?;
        (before.0 > here.0).then(|| (before.1 - here.1) / (before.0 - here.0))
    }

    /// Least-squares slope of `ln e` over `ln h` in the last three rows.
    ///
    /// `None` with fewer rows, where one of them has no error with a logarithm, and where `h` or the error does
    /// not fall from row to row: a fit through an error that swings or grows would name an order that is not there.
    #[must_use]
    pub fn fitted_order(&self, quantity: usize) -> Option<f64> {
        let first = self.rows.len().checked_sub(FITTED_ROWS)?;
        let points: Vec<(f64, f64)> = (first..self.rows.len())
            .map(|row| self.point(quantity, row))
            .collect::<Option<_>>()?;
        if !points
            .windows(2)
            .all(|pair| pair[1].0 < pair[0].0 && pair[1].1 < pair[0].1)
        {
            return None;
        }
        let count = points.len() as f64;
        let mean_h = points.iter().map(|p| p.0).sum::<f64>() / count;
        let mean_e = points.iter().map(|p| p.1).sum::<f64>() / count;
        let covariance: f64 = points.iter().map(|p| (p.0 - mean_h) * (p.1 - mean_e)).sum();
        let variance: f64 = points.iter().map(|p| (p.0 - mean_h).powi(2)).sum();
        Some(covariance / variance)
    }

    /// `(ln h, ln e)` of a row, if both are finite.
    fn point(&self, quantity: usize, row: usize) -> Option<(f64, f64)> {
        let row = self.rows.get(row)?;
        let point = (libm::log(row.h), libm::log(*row.errors.get(quantity)?));
        (point.0.is_finite() && point.1.is_finite()).then_some(point)
    }
}

/// A text table: one line per row, each error followed by its order; `-` where there is none. The last line holds the
/// fitted orders.
impl fmt::Display for ConvergenceTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let show = |order: Option<f64>| order.map_or_else(|| "-".to_owned(), |p| format!("{p:.2}"));
        let mut lines = vec![vec![
            "h".to_owned(),
            "particles".to_owned(),
            "steps".to_owned(),
        ]];
        for quantity in &self.quantities {
            lines[0].extend([quantity.clone(), "order".to_owned()]);
        }
        for (index, row) in self.rows.iter().enumerate() {
            let mut line = vec![
                format!("{:.4e}", row.h),
                row.particles.to_string(),
                row.steps.to_string(),
            ];
            for (quantity, error) in row.errors.iter().enumerate() {
                let error = if error.is_finite() {
                    format!("{error:.3e}")
                } else {
                    "failed".to_owned()
                };
                line.extend([error, show(self.order(quantity, index))]);
            }
            lines.push(line);
        }
        if self.rows.len() >= FITTED_ROWS {
            let mut line = vec!["fit".to_owned(), String::new(), String::new()];
            for quantity in 0..self.quantities.len() {
                line.extend([String::new(), show(self.fitted_order(quantity))]);
            }
            lines.push(line);
        }
        let widths: Vec<usize> = (0..lines[0].len())
            .map(|column| {
                lines
                    .iter()
                    .map(|line| line[column].chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        for line in &lines {
            let cells: Vec<String> = line
                .iter()
                .zip(&widths)
                .map(|(cell, &width)| format!("{cell:>width$}"))
                .collect();
            writeln!(f, "{}", cells.join("  "))?;
        }
        Ok(())
    }
}

/// Relative L2 error weighted by volume, `sqrt(sum V |u - u_ex|^2 / sum V |u_ex|^2)`.
///
/// Each item is `(volume, computed, exact)`: m^3 and vectors (or stress components) of any one unit.
/// `None` if nothing was compared or the exact field is zero: a ratio without a denominator is no error of zero.
#[must_use]
pub fn relative_l2<const N: usize>(
    samples: impl IntoIterator<Item = (f64, [f64; N], [f64; N])>,
) -> Option<f64> {
    let (mut difference, mut reference) = (0.0, 0.0);
    for (volume, computed, exact) in samples {
        for i in 0..N {
            difference += volume * (computed[i] - exact[i]).powi(2);
            reference += volume * exact[i].powi(2);
        }
    }
    // A NaN reference passes on as a NaN error.
    (reference != 0.0).then(|| (difference / reference).sqrt())
}

/// Largest absolute difference of any component; NaN if any sample is NaN, `None` if nothing was compared.
#[must_use]
pub fn max_norm<const N: usize>(
    samples: impl IntoIterator<Item = ([f64; N], [f64; N])>,
) -> Option<f64> {
    let mut largest: Option<f64> = None;
    for (computed, exact) in samples {
        for i in 0..N {
            let difference = (computed[i] - exact[i]).abs();
            largest = Some(match largest {
                Some(value) if value >= difference || value.is_nan() => value,
                _ => difference,
            });
        }
    }
    largest
}
