//! The vibrating elastic bar (verification notes, A4): a standing wave of one mode.
//!
//! Linear theory; a body that follows its own motion differs by `O(v0/c)`, so order studies want `v0/c <= 1e-4`.

use std::f64::consts::PI;

use libm::{cos, sin};

/// Condition of the far end of the bar; the near end `x = 0` is fixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarEnd {
    /// Stress free.
    Free,
    /// Fixed.
    Fixed,
}

/// A bar `0 <= x <= L` vibrating in one mode, `u = (v0/w) sin(w t) sin(b x)`, `w = b c`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// Length L, m.
    pub length: f64,
    /// Modulus E along the bar, Pa.
    pub modulus: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Velocity amplitude v0, m/s.
    pub velocity_amplitude: f64,
    /// Number of the mode, from 1.
    pub mode: u32,
    /// Condition of the end `x = L`.
    pub far_end: FarEnd,
}

impl Bar {
    /// Wave speed `c = sqrt(E/rho)`, m/s.
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        (self.modulus / self.density).sqrt()
    }

    /// Wave number b, 1/m: `(2n-1) pi/(2L)` with a free end, `n pi/L` with a fixed one.
    #[must_use]
    pub fn wave_number(&self) -> f64 {
        let n = f64::from(self.mode);
        let half_waves = match self.far_end {
            FarEnd::Free => n - 0.5,
            FarEnd::Fixed => n,
        };
        half_waves * PI / self.length
    }

    /// Angular frequency w, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        self.wave_number() * self.wave_speed()
    }

    /// Displacement, m, at `x` (m) and `t` (s).
    #[must_use]
    pub fn displacement(&self, x: f64, t: f64) -> f64 {
        let w = self.angular_frequency();
        self.velocity_amplitude / w * sin(w * t) * sin(self.wave_number() * x)
    }

    /// Velocity, m/s.
    #[must_use]
    pub fn velocity(&self, x: f64, t: f64) -> f64 {
        self.velocity_amplitude * cos(self.angular_frequency() * t) * sin(self.wave_number() * x)
    }

    /// Derivative of the velocity along the bar, 1/s.
    #[must_use]
    pub fn velocity_gradient(&self, x: f64, t: f64) -> f64 {
        let b = self.wave_number();
        self.velocity_amplitude * b * cos(self.angular_frequency() * t) * cos(b * x)
    }

    /// Axial stress, Pa.
    #[must_use]
    pub fn stress(&self, x: f64, t: f64) -> f64 {
        let b = self.wave_number();
        let w = self.angular_frequency();
        self.modulus * self.velocity_amplitude / w * b * sin(w * t) * cos(b * x)
    }

    /// Velocity of the centre of mass, m/s: `v0/(b L) (1 - cos(b L)) cos(w t)`.
    #[must_use]
    pub fn mean_velocity(&self, t: f64) -> f64 {
        let bl = self.wave_number() * self.length;
        self.velocity_amplitude / bl * (1.0 - cos(bl)) * cos(self.angular_frequency() * t)
    }
}
