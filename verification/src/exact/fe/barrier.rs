//! The barrier between two mirror images (Liang et al. 2024, eq. 47 and 48), as a stored energy.

/// Energy per area -kappa (g - g_c)² ln(g/g_c) below the critical gap g_c; below `floor` times g_c it goes on as a
/// parabola, so that the pressure is continued along its tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Barrier {
    /// kappa \[Pa/m\].
    pub stiffness: f64,
    /// g_c \[m\].
    pub critical_gap: f64,
    /// Share of the critical gap below which the pressure is linear, between 0 and 1.
    pub floor: f64,
}

impl Barrier {
    /// Energy per area B \[J/m²\], pressure -dB/dg \[Pa\] and slope d²B/dg² \[Pa/m\] at a gap \[m\].
    #[must_use]
    pub fn at(&self, gap: f64) -> (f64, f64, f64) {
        let g_c = self.critical_gap;
        if gap >= g_c {
            return (0.0, 0.0, 0.0);
        }
        // s = g/g_c; b(s) = -(s - 1)² ln s with its first two derivatives.
        let s = (gap / g_c).max(self.floor);
        let (log, open) = (libm::log(s), s - 1.0);
        let b = -open * open * log;
        let b1 = -2.0 * open * log - open * open / s;
        let b2 = -2.0 * log - 4.0 * open / s + open * open / (s * s);
        let below = gap / g_c - s;
        (
            self.stiffness * g_c * g_c * (b + below * (b1 + 0.5 * below * b2)),
            -self.stiffness * g_c * (b1 + below * b2),
            self.stiffness * b2,
        )
    }
}
