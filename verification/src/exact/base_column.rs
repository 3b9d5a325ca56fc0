//! The column shaken at its base: the exact response by images.
//!
//! A linear elastic column `0 <= z <= H` with a free top follows the velocity `v_b(t)` of its base, at rest for
//! `t < 0`. Every wave runs up, is reflected at the free top with its sign and at the driven base against it,
//! so the response at any time is a finite sum of delayed copies of the base motion (verification notes,
//! section 3). It is exact for shear waves and for confined compression waves alike: only the wave speed differs.

use std::f64::consts::TAU;

use libm::{cos, sin};

/// A column on a moving base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseColumn {
    /// Height H, m.
    pub height: f64,
    /// Wave speed c, m/s: `sqrt(M/rho)` for vertical base motion between rollers, `sqrt(G/rho)` for horizontal.
    pub wave_speed: f64,
    /// Density, kg/m^3.
    pub density: f64,
}

impl BaseColumn {
    /// Particle velocity, m/s, at the height `z` (m) and time `t` (s) for the base velocity `base_velocity` (m/s).
    ///
    /// `v = sum_j (-1)^j [v_b(t - (2jH + z)/c) + v_b(t - (2(j+1)H - z)/c)]`. `base_velocity` is never asked about
    /// negative times. The base displacement in its place gives the displacement, the acceleration the acceleration.
    #[must_use]
    pub fn velocity(&self, z: f64, t: f64, base_velocity: impl Fn(f64) -> f64) -> f64 {
        self.images(z, t, &base_velocity, 1.0)
    }

    /// Displacement, m, for the base displacement `base_displacement` (m, zero at `t = 0`).
    #[must_use]
    pub fn displacement(&self, z: f64, t: f64, base_displacement: impl Fn(f64) -> f64) -> f64 {
        self.images(z, t, &base_displacement, 1.0)
    }

    /// Stress along the motion, Pa (axial stress or shear), for the base velocity `base_velocity` (m/s).
    ///
    /// `rho c sum_j (-1)^j [-v_b(t - (2jH + z)/c) + v_b(t - (2(j+1)H - z)/c)]`; zero at the top.
    #[must_use]
    pub fn stress(&self, z: f64, t: f64, base_velocity: impl Fn(f64) -> f64) -> f64 {
        -self.density * self.wave_speed * self.images(z, t, &base_velocity, -1.0)
    }

    /// Steady amplitude at the height `z` (m) over that of a base shaken for ever with the frequency
    /// `frequency` (Hz): `cos(W (H - z)/c) / cos(W H/c)`, `W = 2 pi f`. Infinite at resonance.
    #[must_use]
    pub fn steady_amplification(&self, z: f64, frequency: f64) -> f64 {
        let wave_number = TAU * frequency / self.wave_speed;
        cos(wave_number * (self.height - z)) / cos(wave_number * self.height)
    }

    /// Lowest natural frequency, Hz: `c / (4 H)`.
    #[must_use]
    pub fn fundamental_frequency(&self) -> f64 {
        self.wave_speed / (4.0 * self.height)
    }

    /// The sum over images; `downward` is the sign of the waves that run down.
    fn images(&self, z: f64, t: f64, base: &impl Fn(f64) -> f64, downward: f64) -> f64 {
        let round_trip = 2.0 * self.height / self.wave_speed;
        let climb = z / self.wave_speed;
        // Waves that left the base after time zero; a non-positive height or speed gives none.
        let count = if round_trip > 0.0 {
            ((t - climb) / round_trip).floor()
        } else {
            -1.0
        };
        let mut sum = 0.0;
        let mut sign = 1.0;
        let mut j = 0.0;
        while j <= count {
            sum += sign * base(t - (j * round_trip + climb));
            let descent = t - ((j + 1.0) * round_trip - climb);
            if descent >= 0.0 {
                sum += sign * downward * base(descent);
            }
            sign = -sign;
            j += 1.0;
        }
        sum
    }
}

/// The manual's accelerogram, `a = 2 pi f A cos(2 pi f t + alpha)`, and the motion it produces from rest.
///
/// At `t = 0` the acceleration jumps, which costs a numerical solution part of its order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SineRecord {
    /// Velocity amplitude A, m/s.
    pub amplitude: f64,
    /// Frequency f, Hz.
    pub frequency: f64,
    /// Phase alpha, rad.
    pub phase: f64,
}

impl SineRecord {
    /// Acceleration, m/s^2, at `t >= 0` (s).
    #[must_use]
    pub fn acceleration(&self, t: f64) -> f64 {
        let w = TAU * self.frequency;
        self.amplitude * w * cos(w * t + self.phase)
    }

    /// Velocity, m/s: `A sin(2 pi f t + alpha) - A sin(alpha)`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> f64 {
        self.amplitude * (sin(TAU * self.frequency * t + self.phase) - sin(self.phase))
    }

    /// Displacement, m, from zero at `t = 0`.
    #[must_use]
    pub fn displacement(&self, t: f64) -> f64 {
        let w = TAU * self.frequency;
        self.amplitude * ((cos(self.phase) - cos(w * t + self.phase)) / w - sin(self.phase) * t)
    }
}

/// A base motion that starts smoothly, `v = A sin^3(W t)`: velocity, acceleration and its rate begin at zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CubedSine {
    /// Velocity amplitude A, m/s.
    pub amplitude: f64,
    /// Frequency W/(2 pi), Hz.
    pub frequency: f64,
}

impl CubedSine {
    /// Acceleration, m/s^2, at `t >= 0` (s).
    #[must_use]
    pub fn acceleration(&self, t: f64) -> f64 {
        let w = TAU * self.frequency;
        3.0 * self.amplitude * w * sin(w * t).powi(2) * cos(w * t)
    }

    /// Velocity, m/s.
    #[must_use]
    pub fn velocity(&self, t: f64) -> f64 {
        self.amplitude * sin(TAU * self.frequency * t).powi(3)
    }

    /// Displacement, m, from zero at `t = 0`: `A/W (2/3 - cos + cos^3/3)`.
    #[must_use]
    pub fn displacement(&self, t: f64) -> f64 {
        let w = TAU * self.frequency;
        let c = cos(w * t);
        self.amplitude / w * (2.0 / 3.0 - c + c.powi(3) / 3.0)
    }
}
