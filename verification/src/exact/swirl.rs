//! A standing shear wave that swirls: an elastic square between rollers turns to and fro about its middle, and no force
//! drives it.
//!
//! In a square of side L the stream function `sin kx sin ky` with `k = pi/L` gives, in plane strain at small amplitude,
//!
//! ```text
//! u_x =  A sin kx cos ky sin wt
//! u_y = -A cos kx sin ky sin wt
//! ```
//!
//! It keeps the volume, its shear strain in the axes of the square is zero, and so Navier's equation leaves
//! `rho w^2 = 2 mu k^2`. On each side the displacement across and the shear stress along are zero, which is what a
//! roller asks for; a body that stands free would have to be pulled by the normal stress.

use libm::{cos, sin, sincos};

/// The motion. Positions are from a corner of the square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swirl {
    /// Side L, m.
    pub side: f64,
    /// Amplitude A, m.
    pub amplitude: f64,
    /// Shear modulus mu, Pa.
    pub shear: f64,
    /// Density, kg/m^3.
    pub density: f64,
}

impl Swirl {
    /// Wave number k, 1/m.
    fn number(&self) -> f64 {
        std::f64::consts::PI / self.side
    }

    /// Angular frequency w, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        self.number() * (2.0 * self.shear / self.density).sqrt()
    }

    /// Shape of the displacement of the point that began at `x` (m), 1.
    fn shape(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let k = self.number();
        let ((sin_x, cos_x), (sin_y, cos_y)) = (sincos(k * x), sincos(k * y));
        [sin_x * cos_y, -cos_x * sin_y]
    }

    /// Displacement, m, at `t` (s) of the point that began at `x` (m).
    #[must_use]
    pub fn displacement(&self, x: [f64; 2], t: f64) -> [f64; 2] {
        let factor = self.amplitude * sin(self.angular_frequency() * t);
        self.shape(x).map(|shape| factor * shape)
    }

    /// Its velocity, m/s.
    #[must_use]
    pub fn velocity(&self, x: [f64; 2], t: f64) -> [f64; 2] {
        let w = self.angular_frequency();
        self.shape(x)
            .map(|shape| self.amplitude * w * cos(w * t) * shape)
    }

    /// Stresses xx and yy there, Pa; all others are zero.
    #[must_use]
    pub fn normal_stresses(&self, [x, y]: [f64; 2], t: f64) -> [f64; 2] {
        let k = self.number();
        let stretch =
            self.amplitude * sin(self.angular_frequency() * t) * k * cos(k * x) * cos(k * y);
        [2.0 * self.shear * stretch, -2.0 * self.shear * stretch]
    }
}
