//! A thick-walled cylinder (plane strain) or sphere under internal pressure that yields from its inner face outwards.
//!
//! Hill 1950, *The Mathematical Theory of Plasticity*, chapter V. The solid is elastic and perfectly plastic after Tresca; in a sphere
//! two principal stresses are equal, so that von Mises is the same. In the cylinder the axial stress is between the others, so that
//! no plastic strain is along the axis.

use super::thick_wall::ThickWall;

/// A wall between two radii that yields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingWall {
    /// Inner radius \[m\].
    pub inner: f64,
    /// Outer radius \[m\].
    pub outer: f64,
    /// Yield stress in tension \[Pa\].
    pub strength: f64,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl YieldingWall {
    /// Pressure at which a cylinder has yielded up to a radius \[Pa\].
    #[must_use]
    pub fn cylinder_pressure(&self, front: f64) -> f64 {
        let share = front / self.outer;
        self.strength * (libm::log(front / self.inner) + 0.5 * (1.0 - share * share))
    }

    /// Largest pressure that a cylinder carries \[Pa\].
    #[must_use]
    pub fn cylinder_limit(&self) -> f64 {
        self.cylinder_pressure(self.outer)
    }

    /// Radial, axial and hoop stress of a cylinder that has yielded up to a radius, at a radius \[Pa\].
    #[must_use]
    pub fn cylinder_stress(&self, front: f64, r: f64) -> [f64; 3] {
        if r > front {
            return self.elastic_cylinder(front).cylinder_stress(r);
        }
        let radial = self.strength * libm::log(r / self.inner) - self.cylinder_pressure(front);
        let hoop = radial + self.strength;
        [radial, self.poisson * (radial + hoop), hoop]
    }

    /// Radial displacement of a cylinder that has yielded up to a radius, at a radius \[m\].
    #[must_use]
    pub fn cylinder_displacement(&self, front: f64, r: f64) -> f64 {
        let nu = self.poisson;
        let [radial, ..] = self.cylinder_stress(front, r);
        let of_volume = (1.0 + nu) * (1.0 - 2.0 * nu) * r * radial;
        (of_volume + (1.0 - nu * nu) * self.strength * front * front / r) / self.young
    }

    /// The part of a cylinder that is still elastic.
    fn elastic_cylinder(&self, front: f64) -> ThickWall {
        let share = front / self.outer;
        self.elastic(front, 0.5 * self.strength * (1.0 - share * share))
    }

    /// Pressure at which a sphere has yielded up to a radius \[Pa\].
    #[must_use]
    pub fn sphere_pressure(&self, front: f64) -> f64 {
        let share = (front / self.outer).powi(3);
        2.0 * self.strength * (libm::log(front / self.inner) + (1.0 - share) / 3.0)
    }

    /// Largest pressure that a sphere carries \[Pa\].
    #[must_use]
    pub fn sphere_limit(&self) -> f64 {
        self.sphere_pressure(self.outer)
    }

    /// Radial and hoop stress of a sphere that has yielded up to a radius, at a radius \[Pa\].
    #[must_use]
    pub fn sphere_stress(&self, front: f64, r: f64) -> [f64; 2] {
        if r > front {
            return self.elastic_sphere(front).sphere_stress(r);
        }
        let radial = 2.0 * self.strength * libm::log(r / self.inner) - self.sphere_pressure(front);
        [radial, radial + self.strength]
    }

    /// Radial displacement of a sphere that has yielded up to a radius, at a radius \[m\].
    #[must_use]
    pub fn sphere_displacement(&self, front: f64, r: f64) -> f64 {
        let nu = self.poisson;
        let [radial, _] = self.sphere_stress(front, r);
        let of_volume = (1.0 - 2.0 * nu) * r * radial;
        (of_volume + (1.0 - nu) * self.strength * front.powi(3) / (r * r)) / self.young
    }

    /// The part of a sphere that is still elastic.
    fn elastic_sphere(&self, front: f64) -> ThickWall {
        let share = (front / self.outer).powi(3);
        self.elastic(front, 2.0 / 3.0 * self.strength * (1.0 - share))
    }

    fn elastic(&self, front: f64, pressure: f64) -> ThickWall {
        ThickWall {
            inner: front,
            outer: self.outer,
            pressure,
            young: self.young,
            poisson: self.poisson,
        }
    }
}
