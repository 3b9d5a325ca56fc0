//! A thick-walled cylinder (plane strain) or sphere under internal pressure, elastic.
//!
//! Lamé 1852; Timoshenko and Goodier 1970, sections 28 and 136.

/// A wall between two radii under a pressure inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThickWall {
    /// Inner radius \[m\].
    pub inner: f64,
    /// Outer radius \[m\].
    pub outer: f64,
    /// Pressure inside \[Pa\].
    pub pressure: f64,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl ThickWall {
    /// Radial displacement of a cylinder at a radius \[m\].
    #[must_use]
    pub fn cylinder_displacement(&self, r: f64) -> f64 {
        let (b2, nu) = (self.outer * self.outer, self.poisson);
        self.of_cylinder() * (1.0 + nu) / self.young * ((1.0 - 2.0 * nu) * r + b2 / r)
    }

    /// Radial, axial and hoop stress of a cylinder at a radius \[Pa\].
    #[must_use]
    pub fn cylinder_stress(&self, r: f64) -> [f64; 3] {
        let k = self.of_cylinder();
        let q = (self.outer / r).powi(2);
        [k * (1.0 - q), 2.0 * self.poisson * k, k * (1.0 + q)]
    }

    /// p a²/(b² - a²) \[Pa\].
    fn of_cylinder(&self) -> f64 {
        let (a2, b2) = (self.inner * self.inner, self.outer * self.outer);
        self.pressure * a2 / (b2 - a2)
    }

    /// Radial displacement of a sphere at a radius \[m\].
    #[must_use]
    pub fn sphere_displacement(&self, r: f64) -> f64 {
        let (b3, nu) = (self.outer.powi(3), self.poisson);
        self.of_sphere() / self.young * ((1.0 - 2.0 * nu) * r + (1.0 + nu) * b3 / (2.0 * r * r))
    }

    /// Radial and hoop stress of a sphere at a radius \[Pa\].
    #[must_use]
    pub fn sphere_stress(&self, r: f64) -> [f64; 2] {
        let k = self.of_sphere();
        let q = (self.outer / r).powi(3);
        [k * (1.0 - q), k * (1.0 + 0.5 * q)]
    }

    /// p a³/(b³ - a³) \[Pa\].
    fn of_sphere(&self) -> f64 {
        let (a3, b3) = (self.inner.powi(3), self.outer.powi(3));
        self.pressure * a3 / (b3 - a3)
    }
}
