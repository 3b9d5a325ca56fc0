//! Line contact of a cylinder (Hertz 1881; Johnson, Contact Mechanics, sections 4.2c and 4.3), in plane strain.

use std::f64::consts::PI;

/// A cylinder of radius R pressed by a force per length, in plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    /// Relative radius \[m\], 1/R = 1/R_1 + 1/R_2; that of the cylinder on a plane.
    pub radius: f64,
    /// Force per length \[N/m\].
    pub load: f64,
    /// Contact modulus E* \[Pa\].
    pub modulus: f64,
}

/// Contact modulus of two elastic bodies, 1/E* = (1 - nu_1²)/E_1 + (1 - nu_2²)/E_2 \[Pa\]; an infinite Young's modulus
/// is a rigid body.
#[must_use]
pub fn contact_modulus(young: [f64; 2], poisson: [f64; 2]) -> f64 {
    let compliance = |k: usize| (1.0 - poisson[k] * poisson[k]) / young[k];
    1.0 / (compliance(0) + compliance(1))
}

impl Hertz {
    /// Half of the contact's width, b = 2 sqrt(F R/(pi E*)) \[m\].
    #[must_use]
    pub fn half_width(&self) -> f64 {
        2.0 * (self.load * self.radius / (PI * self.modulus)).sqrt()
    }

    /// Approach of the centre of a disk of the radius to the plane or to the other disk that it is pressed against \[m\]: F/(pi
    /// E_1*) (2 ln(4 R/b) - 1), with the modulus of the disk alone against something rigid, as between two equal disks
    /// (Johnson, eq. 5.57).
    #[must_use]
    pub fn approach(&self) -> f64 {
        let log = libm::log(4.0 * self.radius / self.half_width());
        self.load / (PI * self.modulus) * (2.0 * log - 1.0)
    }

    /// Largest pressure, 2 F/(pi b) \[Pa\].
    #[must_use]
    pub fn peak(&self) -> f64 {
        2.0 * self.load / (PI * self.half_width())
    }

    /// Pressure p_0 sqrt(1 - x²/b²) at a distance from the middle of the contact \[Pa\].
    #[must_use]
    pub fn pressure(&self, x: f64) -> f64 {
        let share = x / self.half_width();
        self.peak() * (1.0 - share * share).max(0.0).sqrt()
    }

    /// Stresses at a depth under the middle of the contact \[Pa\]: along the surface and normal to it, negative in
    /// compression (Johnson, eq. 4.46).
    #[must_use]
    pub fn stress_on_axis(&self, depth: f64) -> [f64; 2] {
        let (b, p) = (self.half_width(), self.peak());
        let root = libm::hypot(b, depth);
        [
            -p / b * ((b * b + 2.0 * depth * depth) / root - 2.0 * depth),
            -p * b / root,
        ]
    }
}
