//! Point contact of a sphere (Hertz 1881; Johnson, Contact Mechanics, sections 3.4 and 4.2b).

use std::f64::consts::PI;

/// A sphere of radius R pressed by a force on a plane, with the shape of a paraboloid near the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzSphere {
    /// Relative radius \[m\], 1/R = 1/R_1 + 1/R_2; that of the sphere on a plane.
    pub radius: f64,
    /// Force \[N\].
    pub load: f64,
    /// Contact modulus E* \[Pa\], see [`contact_modulus`](super::hertz::contact_modulus).
    pub modulus: f64,
}

impl HertzSphere {
    /// Radius of the contact, a = (3 F R/(4 E*))^(1/3) \[m\].
    #[must_use]
    pub fn contact_radius(&self) -> f64 {
        libm::cbrt(0.75 * self.load * self.radius / self.modulus)
    }

    /// Largest pressure, p_0 = 3 F/(2 pi a²) \[Pa\].
    #[must_use]
    pub fn peak(&self) -> f64 {
        1.5 * self.load / (PI * self.contact_radius().powi(2))
    }

    /// Approach of distant points of the bodies, a²/R \[m\].
    #[must_use]
    pub fn approach(&self) -> f64 {
        self.contact_radius().powi(2) / self.radius
    }

    /// Pressure p_0 sqrt(1 - r²/a²) at a distance from the middle of the contact \[Pa\].
    #[must_use]
    pub fn pressure(&self, r: f64) -> f64 {
        let share = r / self.contact_radius();
        self.peak() * (1.0 - share * share).max(0.0).sqrt()
    }

    /// Mean pressure within a distance from the middle, at most that of the edge \[Pa\]:
    /// p_0 (1 - (1 - r²/a²)^(3/2))/(3/2 r²/a²).
    #[must_use]
    pub fn mean_within(&self, r: f64) -> f64 {
        let square = (r / self.contact_radius()).powi(2).min(1.0);
        self.peak() * (1.0 - libm::pow(1.0 - square, 1.5)) / (1.5 * square)
    }
}
