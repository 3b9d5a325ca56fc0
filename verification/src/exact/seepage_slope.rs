//! An infinite slope with water that seeps along it, its surface at the top.
//!
//! Nothing changes along the slope. With the depth d across it from the surface and the angle b: pore pressure
//! `rho_w g d cos b`, effective stress across `(rho - rho_w) g d cos b`, shear stress `rho g d sin b` with `rho` of
//! soil and water
//! together, and a flux `n (w - v) = k sin b` down the slope, whose drag carries the weight of the water along it
//! (Skempton and
//! DeLory 1957).

/// The slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeepageSlope {
    /// Angle b, rad.
    pub angle: f64,
    /// Depth of the layer across the slope, m.
    pub depth: f64,
    /// Density of soil and water together, kg/m³.
    pub density: f64,
    /// Density of the water, kg/m³.
    pub density_water: f64,
    /// Gravity, m/s².
    pub gravity: f64,
}

impl SeepageSlope {
    /// Pressure of the water, Pa, compression positive, at the depth d (m) across the slope.
    #[must_use]
    pub fn pressure(&self, d: f64) -> f64 {
        self.density_water * self.gravity * d * libm::cos(self.angle)
    }

    /// Effective stress across the slope, Pa, tension positive.
    #[must_use]
    pub fn effective_stress(&self, d: f64) -> f64 {
        -(self.density - self.density_water) * self.gravity * d * libm::cos(self.angle)
    }

    /// Size of the shear stress along the slope, Pa.
    #[must_use]
    pub fn shear_stress(&self, d: f64) -> f64 {
        self.density * self.gravity * d * libm::sin(self.angle)
    }

    /// Flux of water relative to the skeleton down the slope, m/s, of a conductivity k (m/s).
    #[must_use]
    pub fn flux(&self, conductivity: f64) -> f64 {
        conductivity * libm::sin(self.angle)
    }

    /// Displacement of an elastic skeleton down the slope, m, at the depth d, of a shear modulus (Pa).
    #[must_use]
    pub fn displacement(&self, d: f64, shear: f64) -> f64 {
        let weight = self.density * self.gravity * libm::sin(self.angle);
        weight * (self.depth * self.depth - d * d) / (2.0 * shear)
    }

    /// Strength over shear stress at the depth d, of an effective cohesion (Pa) and friction (rad).
    #[must_use]
    pub fn safety(&self, d: f64, cohesion: f64, friction: f64) -> f64 {
        (cohesion - self.effective_stress(d) * libm::tan(friction)) / self.shear_stress(d)
    }
}
