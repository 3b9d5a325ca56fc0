//! A standing sound wave in a viscous fluid: `u'' + nu k² u' + c² k² u = 0` for the amplitude of each mode.

use libm::{cos, exp, sin, sqrt};

/// A mode of sound in a fluid between walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampedSound {
    /// Speed of sound c, m/s.
    pub speed: f64,
    /// Longitudinal viscosity over density, nu = (4 mu/3)/rho, m²/s.
    pub diffusivity: f64,
    /// Wave number k, 1/m.
    pub wave_number: f64,
}

impl DampedSound {
    /// Rate of decay of the amplitude, `nu k²/2`, 1/s.
    #[must_use]
    pub fn decay(&self) -> f64 {
        0.5 * self.diffusivity * self.wave_number * self.wave_number
    }

    /// Frequency of the damped swing, rad/s; NaN where nothing swings.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        let undamped = self.speed * self.wave_number;
        sqrt(undamped * undamped - self.decay() * self.decay())
    }

    /// Velocity over that at time zero, where nothing was displaced.
    #[must_use]
    pub fn velocity(&self, time: f64) -> f64 {
        let (decay, frequency) = (self.decay(), self.frequency());
        exp(-decay * time) * (cos(frequency * time) - decay / frequency * sin(frequency * time))
    }
}
