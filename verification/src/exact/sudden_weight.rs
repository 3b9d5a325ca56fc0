//! A column that is let go: gravity acts from t = 0 on an elastic column at rest on its base.
//!
//! `u_tt = c^2 u_zz - g` on `0 < z < H`, `u(0, t) = 0`, `u_z(H, t) = 0`, at rest at t = 0. With the static solution
//! `s(z) = -(g/c^2) (H z - z^2/2)` the difference `u - s` is a free vibration that starts from `-s`, so that, after
//! d'Alembert, `u = s(z) - (S(z - c t) + S(z + c t))/2` with S the extension of s that is odd about the base and even
//! about the top. Small strains; confined (lateral strain zero) where `c^2 = (lambda + 2 mu)/rho`.

/// The column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuddenWeight {
    /// Height H, m.
    pub height: f64,
    /// Wave speed c, m/s.
    pub wave_speed: f64,
    /// Gravity g, downwards, m/s^2.
    pub gravity: f64,
}

impl SuddenWeight {
    /// Displacement along z, m, at the height `z` (m) above the base at `t` (s).
    #[must_use]
    pub fn displacement(&self, z: f64, t: f64) -> f64 {
        let ct = self.wave_speed * t;
        self.at_rest(z) - 0.5 * (self.extended(z - ct) + self.extended(z + ct))
    }

    /// Vertical stress, Pa, tension positive, for a density (kg/m^3): `rho c^2 u_z`.
    #[must_use]
    pub fn stress(&self, z: f64, t: f64, density: f64) -> f64 {
        let ct = self.wave_speed * t;
        let strain =
            self.slope(z) - 0.5 * (self.extended_slope(z - ct) + self.extended_slope(z + ct));
        density * self.wave_speed.powi(2) * strain
    }

    /// Period of the swing, s: four times the way of a wave through the column.
    #[must_use]
    pub fn period(&self) -> f64 {
        4.0 * self.height / self.wave_speed
    }

    /// Static displacement, m, under the same weight.
    #[must_use]
    pub fn at_rest(&self, z: f64) -> f64 {
        -self.gravity / self.wave_speed.powi(2) * (self.height * z - 0.5 * z * z)
    }

    /// Derivative of the static displacement along z.
    fn slope(&self, z: f64) -> f64 {
        -self.gravity / self.wave_speed.powi(2) * (self.height - z)
    }

    /// The static displacement beyond the column: odd about the base, even about the top, period 4H.
    fn extended(&self, z: f64) -> f64 {
        let (z, [half, quarter]) = self.folded(z);
        let sign = if half { -1.0 } else { 1.0 };
        sign * self.at_rest(if quarter { 2.0 * self.height - z } else { z })
    }

    /// Derivative of [`Self::extended`].
    fn extended_slope(&self, z: f64) -> f64 {
        let (z, [half, quarter]) = self.folded(z);
        let sign = if half == quarter { 1.0 } else { -1.0 };
        sign * self.slope(if quarter { 2.0 * self.height - z } else { z })
    }

    /// A height within the first half of the period, whether it lay in the second half, and whether it lies beyond the top.
    fn folded(&self, z: f64) -> (f64, [bool; 2]) {
        let h = self.height;
        let z = z.rem_euclid(4.0 * h);
        let half = z > 2.0 * h;
        let z = if half { z - 2.0 * h } else { z };
        (z, [half, z > h])
    }
}
