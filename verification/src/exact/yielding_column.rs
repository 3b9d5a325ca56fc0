//! A column under its own weight that yields below a depth: equilibrium in confined compression.
//!
//! Equilibrium in the initial configuration gives the vertical stress `rho0 g (H - Y)` whatever the law, since the
//! cross-section stays. If the weight has come slowly, so that no stress ever fell, the solid is on the one branch of
//! [`TwoSlopes`]: elastic down to the depth `q_y/(rho0 g)`, with the modulus M_p below it. With the logarithmic strain of the
//! rate law the height of a slice is `exp(-e)` of what it was.

use super::two_slopes::TwoSlopes;
use libm::exp;

/// The column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingColumn {
    /// The solid.
    pub solid: TwoSlopes,
    /// Height H, m.
    pub height: f64,
    /// Initial density, kg/m^3.
    pub density: f64,
    /// Gravity g, downwards, m/s^2.
    pub gravity: f64,
}

impl YieldingColumn {
    /// Weight of the column per volume, N/m³.
    fn weight(&self) -> f64 {
        self.density * self.gravity
    }

    /// Depth below the top, m, from which on it yields.
    #[must_use]
    pub fn yield_depth(&self) -> f64 {
        self.solid.limit / self.weight()
    }

    /// Vertical compression, Pa, of the material at the initial height `y0` (m): the weight above it.
    #[must_use]
    pub fn compression(&self, y0: f64) -> f64 {
        self.weight() * (self.height - y0)
    }

    /// Compression, Pa, that the rollers carry there.
    #[must_use]
    pub fn lateral_compression(&self, y0: f64) -> f64 {
        self.solid.across(self.compression(y0))
    }

    /// Displacement, m, upwards positive, of the material at the initial height `y0` (m).
    #[must_use]
    pub fn displacement(&self, y0: f64) -> f64 {
        let above = self.shortening(self.compression(y0));
        (above - self.shortening(self.compression(0.0))) / self.weight()
    }

    /// Plastic work per cross-section, J/m². It is quadratic in the compression, so that Simpson's rule is exact; strains
    /// are small.
    #[must_use]
    pub fn plastic_work(&self) -> f64 {
        let (from, to) = (self.solid.limit, self.compression(0.0));
        if to <= from {
            return 0.0;
        }
        let middle = self.solid.plastic_work(0.5 * (from + to));
        (to - from) / 6.0 * (4.0 * middle + self.solid.plastic_work(to)) / self.weight()
    }

    /// Integral of `1 - exp(-e)` over the compression from zero to `q`, Pa: what all above has been shortened by, times the
    /// weight per volume.
    fn shortening(&self, q: f64) -> f64 {
        let branch = |modulus: f64, from: f64, to: f64| {
            let start = exp(-self.solid.strain(from));
            (to - from) + modulus * start * (exp(-(to - from) / modulus) - 1.0)
        };
        let limit = self.solid.limit.min(q);
        branch(self.solid.confined_modulus(), 0.0, limit)
            + branch(self.solid.plastic_modulus, limit, q)
    }
}
