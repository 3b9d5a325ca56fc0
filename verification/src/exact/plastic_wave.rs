//! A plane wave in a solid that yields, under a load that rises and stays.
//!
//! Strain is along x alone. While stresses rise everywhere, what is below the limit q_y of the solid runs with
//! `c_e = sqrt(M_c/rho)` and what is above it with `c_p = sqrt(M_p/rho)`: both are simple waves, as slopes are constant. The
//! load q(t) on x = 0 is split at the limit, and each part carries its velocity,
//!
//! ```text
//! q(x, t) = min(q(t - x/c_e), q_y) + max(q(t - x/c_p) - q_y, 0)
//! v(x, t) = min(q(t - x/c_e), q_y)/(rho c_e) + max(q(t - x/c_p) - q_y, 0)/(rho c_p)
//! ```
//!
//! until the first wave reaches an end. Small strains. The load rises as `Q (10 s³ - 15 s⁴ + 6 s⁵)`, `s = t/t_r`.

use super::two_slopes::TwoSlopes;

/// The wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticWave {
    /// The solid.
    pub solid: TwoSlopes,
    /// Density, kg/m^3.
    pub density: f64,
    /// Final load Q, Pa, compression positive.
    pub load: f64,
    /// Time t_r in which it is reached, s.
    pub rise: f64,
}

/// Intervals of the integrals over the rise; the midpoint rule is off by 1e-7 of the whole, where the load passes the limit.
const INTERVALS: u32 = 4000;

impl PlasticWave {
    /// Speed c_e, m/s, of what is below the limit.
    #[must_use]
    pub fn elastic_speed(&self) -> f64 {
        (self.solid.confined_modulus() / self.density).sqrt()
    }

    /// Speed c_p, m/s, of what is above the limit.
    #[must_use]
    pub fn plastic_speed(&self) -> f64 {
        (self.solid.plastic_modulus / self.density).sqrt()
    }

    /// Load q(t) on x = 0, Pa.
    #[must_use]
    pub fn load_at(&self, t: f64) -> f64 {
        let s = (t / self.rise).clamp(0.0, 1.0);
        self.load * s * s * s * (10.0 + s * (6.0 * s - 15.0))
    }

    /// The two parts of the compression at `x` (m) and `t` (s), Pa: up to the limit, and beyond it.
    fn parts(&self, x: f64, t: f64) -> [f64; 2] {
        let (limit, arrived) = (self.solid.limit, |speed: f64| self.load_at(t - x / speed));
        [
            arrived(self.elastic_speed()).min(limit),
            (arrived(self.plastic_speed()) - limit).max(0.0),
        ]
    }

    /// Compression along x, Pa.
    #[must_use]
    pub fn compression(&self, x: f64, t: f64) -> f64 {
        self.parts(x, t).iter().sum()
    }

    /// Cauchy stress, Pa, tension positive: xx, yy, zz, yz, xz, xy.
    #[must_use]
    pub fn stress(&self, x: f64, t: f64) -> [f64; 6] {
        let q = self.compression(x, t);
        let s = self.solid.across(q);
        [-q, -s, -s, 0.0, 0.0, 0.0]
    }

    /// Velocity, m/s.
    #[must_use]
    pub fn velocity(&self, x: f64, t: f64) -> f64 {
        let [elastic, plastic] = self.parts(x, t);
        (elastic / self.elastic_speed() + plastic / self.plastic_speed()) / self.density
    }

    /// Momentum per cross-section, N s/m²: the impulse of the load.
    #[must_use]
    pub fn momentum(&self, t: f64) -> f64 {
        let s = (t / self.rise).clamp(0.0, 1.0);
        let rising = s.powi(4) * (2.5 + s * (s - 3.0));
        self.load * (self.rise * rising + (t - self.rise).max(0.0))
    }

    /// Work of the load per cross-section, J/m²: the integral of q v at x = 0.
    #[must_use]
    pub fn work(&self, t: f64) -> f64 {
        self.over_time(t, |time| self.load_at(time) * self.velocity(0.0, time))
    }

    /// Plastic work per cross-section, J/m². Each load beyond the limit has gone `c_p (t - time)` by now, and whatever it
    /// has passed holds it or more.
    #[must_use]
    pub fn plastic_work(&self, t: f64) -> f64 {
        let density = |time| self.solid.plastic_work(self.load_at(time));
        self.plastic_speed() * self.over_time(t, density)
    }

    /// Integral from 0 to `t` (s) of what is constant once the load has risen.
    fn over_time(&self, t: f64, of: impl Fn(f64) -> f64) -> f64 {
        let rising = t.min(self.rise);
        let dt = rising / f64::from(INTERVALS);
        let middle = |i: u32| of((f64::from(i) + 0.5) * dt);
        let sum: f64 = (0..INTERVALS).map(middle).sum();
        sum * dt + (t - rising) * of(t)
    }
}
