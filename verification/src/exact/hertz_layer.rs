//! Line contact through a layer that transmits pressure across a gap: what a barrier method converges to instead of
//! Hertz.
//!
//! The gap under a cylinder of radius R is g(x) = x²/(2 R) - d + w(x) with the deflection of a half-plane
//! w(x) = -2/(pi E*) int p(s) ln|x - s| ds (Johnson, eq. 2.24d), and the pressure is that of the layer, p = p(g). The
//! approach d follows from the load. Solved by collocation with a constant pressure in each of equal cells and Newton's
//! method; the pressure is smooth, so the error falls as the square of the cell.

use super::fe::Barrier;
use super::hertz::Hertz;
use libm::log;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Pressure of the layer \[Pa\] and its slope dp/dg \[Pa/m\], which must not be positive, at a gap \[m\].
pub type Layer<'a> = &'a dyn Fn(f64) -> (f64, f64);

/// Pressure of the barrier of Liang et al. 2024, eq. 48, kappa (g - g_c) (2 ln(g/g_c) - g_c/g + 1) below the critical
/// gap, and its slope.
#[must_use]
pub fn barrier(kappa: f64, critical_gap: f64, gap: f64) -> (f64, f64) {
    let barrier = Barrier {
        stiffness: kappa,
        critical_gap,
        floor: 0.0,
    };
    let (_, pressure, stiffness) = barrier.at(gap);
    (pressure, -stiffness)
}

/// Pressure on cells of equal width, symmetric about 0.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerContact {
    /// Width of a cell \[m\].
    pub cell: f64,
    /// Pressure of each cell \[Pa\], from the middle outwards; cell k is centred at (k + 1/2) times the width.
    pub pressure: Vec<f64>,
    /// Gap of each cell \[m\].
    pub gap: Vec<f64>,
    /// Approach of the bodies, up to the constant that a half-plane leaves open \[m\].
    pub approach: f64,
}

/// Reason for which there is no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerError {
    /// Largest residual of the gaps \[m\].
    pub residual: f64,
}

impl LayerContact {
    /// Solves for a cylinder and a layer, on `cells` cells over a half-width of `extent` \[m\]. `start` is a gap at which
    /// the layer carries about the mean pressure.
    ///
    /// # Errors
    /// If Newton's method does not converge.
    pub fn solve(
        hertz: &Hertz,
        layer: Layer<'_>,
        cells: usize,
        extent: f64,
        start: f64,
    ) -> Result<Self, LayerError> {
        let width = extent / cells as f64;
        let x = |k: usize| (k as f64 + 0.5) * width;
        // Integral of ln|x - s| over a cell and its mirror image.
        let primitive = |u: f64| if u == 0.0 { 0.0 } else { u * log(u.abs()) - u };
        let over = |x: f64, s: f64| primitive(s + 0.5 * width - x) - primitive(s - 0.5 * width - x);
        let factor = 2.0 / (PI * hertz.modulus);
        let kernel = DMatrix::from_fn(cells, cells, |i, j| {
            factor * (over(x(i), x(j)) + over(x(i), -x(j)))
        });
        let shape = DVector::from_fn(cells, |i, _| x(i) * x(i) / (2.0 * hertz.radius));

        // Unknown: the gaps and the approach; the load is added in steps so that Newton's method stays near.
        let mut gap = DVector::from_fn(cells, |i, _| start + shape[i]);
        let mut approach = -start;
        let mut residual = f64::INFINITY;
        for _ in 0..400 {
            let law: Vec<(f64, f64)> = gap.iter().map(|g| layer(*g)).collect();
            let pressure = DVector::from_iterator(cells, law.iter().map(|l| l.0));
            let of_gaps = &gap - &shape + &kernel * &pressure + DVector::repeat(cells, approach);
            let of_load = 2.0 * width * pressure.sum() - hertz.load;
            residual = of_gaps.amax().max(of_load.abs() / hertz.modulus);
            if residual < 1.0e-13 * extent {
                return Ok(Self {
                    cell: width,
                    pressure: pressure.iter().copied().collect(),
                    gap: gap.iter().copied().collect(),
                    approach,
                });
            }
            let jacobian =
                DMatrix::from_fn(cells + 1, cells + 1, |i, j| match (i < cells, j < cells) {
                    (true, true) => f64::from(i == j) + kernel[(i, j)] * law[j].1,
                    (true, false) => 1.0,
                    (false, true) => 2.0 * width * law[j].1,
                    (false, false) => 0.0,
                });
            let mut right = of_gaps.push(of_load);
            right.neg_mut();
            let Some(change) = jacobian.lu().solve(&right) else {
                return Err(LayerError { residual });
            };
            // No gap may close by more than half in one iteration: the barrier is steep there.
            let share = (0..cells)
                .filter(|k| change[*k] < -0.5 * gap[*k])
                .map(|k| -0.5 * gap[k] / change[k])
                .fold(1.0, f64::min);
            gap += share * change.rows(0, cells);
            approach += share * change[cells];
        }
        Err(LayerError { residual })
    }

    /// Load per length \[N/m\].
    #[must_use]
    pub fn load(&self) -> f64 {
        2.0 * self.cell * self.pressure.iter().sum::<f64>()
    }

    /// Pressure at a distance from the middle, linear between the centres of the cells \[Pa\].
    #[must_use]
    pub fn pressure_at(&self, x: f64) -> f64 {
        let at = x.abs() / self.cell - 0.5;
        if at <= 0.0 {
            return self.pressure[0];
        }
        let k = at as usize;
        let Some(outer) = self.pressure.get(k + 1) else {
            return 0.0;
        };
        let share = at - k as f64;
        self.pressure[k] * (1.0 - share) + outer * share
    }

    /// Half-width of the Hertz pressure that has the same second moment, 2 sqrt(m_2/m_0) \[m\].
    #[must_use]
    pub fn effective_half_width(&self) -> f64 {
        let moment: f64 = self
            .pressure
            .iter()
            .enumerate()
            .map(|(k, p)| p * ((k as f64 + 0.5) * self.cell).powi(2))
            .sum();
        2.0 * (moment / self.pressure.iter().sum::<f64>()).sqrt()
    }

    /// L2 norm of the difference to the pressure of Hertz, over that of Hertz.
    #[must_use]
    pub fn distance_from_hertz(&self, hertz: &Hertz) -> f64 {
        let exact = |k: usize| hertz.pressure((k as f64 + 0.5) * self.cell);
        let (mut off, mut all) = (0.0, 0.0);
        for (k, p) in self.pressure.iter().enumerate() {
            off += (p - exact(k)).powi(2);
            all += exact(k).powi(2);
        }
        (off / all).sqrt()
    }
}
