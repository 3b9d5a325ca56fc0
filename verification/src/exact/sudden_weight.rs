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

    /// Static displacement, m, under the same weight.
    #[must_use]
    pub fn at_rest(&self, z: f64) -> f64 {
        -self.gravity / self.wave_speed.powi(2) * (self.height * z - 0.5 * z * z)
    }

    /// The static displacement beyond the column: odd about the base, even about the top, period 4H.
    fn extended(&self, z: f64) -> f64 {
        let h = self.height;
        let z = z.rem_euclid(4.0 * h);
        let (z, sign) = if z > 2.0 * h {
            (z - 2.0 * h, -1.0)
        } else {
            (z, 1.0)
        };
        sign * self.at_rest(if z > h { 2.0 * h - z } else { z })
    }
}

#[cfg(test)]
mod tests {
    use super::SuddenWeight;
    use std::f64::consts::PI;

    const COLUMN: SuddenWeight = SuddenWeight {
        height: 1.5,
        wave_speed: 40.0,
        gravity: 9.81,
    };

    /// The same by separation of variables: `u = -sum b_n/w_n^2 (1 - cos w_n t) sin k_n z`, `b_n = 2 g/(k_n H)`.
    fn series(z: f64, t: f64) -> f64 {
        let SuddenWeight {
            height,
            wave_speed,
            gravity,
        } = COLUMN;
        (1..20_000)
            .map(|n| {
                let k = (f64::from(n) - 0.5) * PI / height;
                let w = k * wave_speed;
                -2.0 * gravity / (k * height * w * w) * (1.0 - (w * t).cos()) * (k * z).sin()
            })
            .sum()
    }

    #[test]
    fn it_is_the_sum_of_its_modes() {
        let scale = COLUMN.at_rest(COLUMN.height).abs();
        for z in [0.0, 0.2, 0.75, 1.31, 1.5] {
            for t in [0.0, 0.004, 0.02, 0.0375, 0.07, 0.4] {
                let difference = COLUMN.displacement(z, t) - series(z, t);
                assert!(difference.abs() < 1e-8 * scale, "{z} {t} {difference}");
            }
        }
    }

    #[test]
    fn at_first_everything_but_the_base_falls_freely() {
        let t = 0.01;
        let fallen = COLUMN.displacement(1.2, t);
        assert!((fallen + 0.5 * COLUMN.gravity * t * t).abs() < 1e-15);
    }
}
