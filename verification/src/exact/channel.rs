//! Flow between parallel walls: Newton's and Bingham's fluid, driven by a body force or by a wall.
//!
//! Velocities are along the walls and depend on the place between them alone; diffusion with the viscosity over density,
//! nu = mu/rho, carries them. Series are those of separated variables (Batchelor 1967, 4.3), summed until their terms are
//! below round-off.

use libm::{cos, exp, sin};
use std::f64::consts::PI;

/// Terms after which a series ends whatever its terms are: at the start it converges as 1/n, and answers are asked for
/// later.
const MOST_TERMS: u32 = 10_000;
/// Exponents below which a term is no part of the sum.
const NEGLIGIBLE: f64 = -40.0;

/// Fluid between two walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// Distance of the walls a, m.
    pub width: f64,
    /// Dynamic viscosity mu, Pa s.
    pub viscosity: f64,
    /// Density rho, kg/m^3.
    pub density: f64,
    /// Shear stress up to which the fluid does not flow, Pa; 0 for Newton's.
    pub yield_stress: f64,
}

impl Channel {
    /// Kinematic viscosity, m²/s.
    #[must_use]
    pub fn diffusivity(&self) -> f64 {
        self.viscosity / self.density
    }

    /// Velocity, m/s, of Newton's fluid that a body force of `g` (m/s²) along the walls sets in motion at time zero, at a
    /// distance `y` from one wall (m) and a time (s).
    #[must_use]
    pub fn driven_by_force(&self, g: f64, y: f64, time: f64) -> f64 {
        let (half, nu) = (0.5 * self.width, self.diffusivity());
        let from_middle = y - half;
        let steady = 0.5 * g / nu * (half * half - from_middle * from_middle);
        let mut rest = 0.0;
        for m in 0..MOST_TERMS {
            let b = (f64::from(m) + 0.5) * PI;
            let exponent = -b * b * nu * time / (half * half);
            if exponent < NEGLIGIBLE {
                break;
            }
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            rest += sign * cos(b * from_middle / half) * exp(exponent) / (b * b * b);
        }
        steady - 2.0 * g * half * half / nu * rest
    }

    /// Velocity, m/s, of either fluid at last under such a force: a plug where the shear stress rho g |y - a/2| is below the
    /// yield stress.
    #[must_use]
    pub fn driven_by_force_at_last(&self, g: f64, y: f64) -> f64 {
        let half = 0.5 * self.width;
        let plug = (self.yield_stress / (self.density * g)).min(half);
        let from_plug = ((y - half).abs() - plug).max(0.0);
        let flowing = half - plug;
        0.5 * g / self.diffusivity() * (flowing * flowing - from_plug * from_plug)
    }

    /// Velocity, m/s, of Newton's fluid that the far wall drags along with `speed` (m/s) from time zero on, at a distance
    /// `y` from the wall at rest (m).
    #[must_use]
    pub fn dragged(&self, speed: f64, y: f64, time: f64) -> f64 {
        let mut rest = 0.0;
        for n in 1..MOST_TERMS {
            let b = f64::from(n) * PI;
            let exponent = -b * b * self.diffusivity() * time / (self.width * self.width);
            if exponent < NEGLIGIBLE {
                break;
            }
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            rest += sign / b * sin(b * y / self.width) * exp(exponent);
        }
        speed * (y / self.width + 2.0 * rest)
    }

    /// Shear stress, Pa, at last between a wall at rest and one with a speed (m/s).
    #[must_use]
    pub fn dragging_stress(&self, speed: f64) -> f64 {
        self.yield_stress + self.viscosity * speed / self.width
    }
}
