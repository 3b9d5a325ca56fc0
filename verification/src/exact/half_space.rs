//! An elastic half-space under a downward force at a point of its surface, or under a pressure on a disc.
//!
//! Boussinesq 1885; Johnson 1985, *Contact Mechanics*, sections 3.2 and 3.4. Depth and vertical displacement are positive
//! downwards, stress in tension.

use super::special::gauss_legendre;
use std::f64::consts::PI;

/// The half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl HalfSpace {
    /// Horizontal displacement away from a force over the distance along the surface, and vertical displacement, per newton, at
    /// a squared distance along the surface \[m²\] and a depth \[m\].
    fn of_unit_force(&self, square: f64, depth: f64) -> [f64; 2] {
        let nu = self.poisson;
        let far = (square + depth * depth).sqrt();
        let scale = (1.0 + nu) / (2.0 * PI * self.young * far);
        [
            scale * (depth / (far * far) - (1.0 - 2.0 * nu) / (far + depth)),
            scale * (2.0 * (1.0 - nu) + (depth / far).powi(2)),
        ]
    }

    /// Radial and vertical displacement \[m\] under a force \[N\] at a radius and a depth \[m\].
    #[must_use]
    pub fn point_displacement(&self, force: f64, radius: f64, depth: f64) -> [f64; 2] {
        let [along, down] = self.of_unit_force(radius * radius, depth);
        [force * along * radius, force * down]
    }

    /// Radial, vertical, hoop and shear stress \[Pa\] under a force \[N\] at a radius and a depth \[m\]; the shear is that of radius and
    /// depth.
    #[must_use]
    pub fn point_stress(&self, force: f64, radius: f64, depth: f64) -> [f64; 4] {
        let (r, z, nu) = (radius, depth, self.poisson);
        let far = (r * r + z * z).sqrt();
        let scale = force / (2.0 * PI);
        let near = (1.0 - 2.0 * nu) / (far * (far + z));
        let fifth = far.powi(5);
        [
            scale * (near - 3.0 * r * r * z / fifth),
            -scale * 3.0 * z.powi(3) / fifth,
            scale * ((1.0 - 2.0 * nu) * z / far.powi(3) - near),
            -scale * 3.0 * r * z * z / fifth,
        ]
    }

    /// Radial and vertical displacement \[m\] under a pressure \[Pa\] on a disc of a radius \[m\], at a radius and a depth \[m\]: Gauss points
    /// along the radius of the disc, midpoints around it. It is good to 1e-9 from half a radius beyond the edge on.
    #[must_use]
    pub fn disc_displacement(&self, [pressure, disc]: [f64; 2], at: [f64; 2]) -> [f64; 2] {
        const ANGLES: usize = 48;
        let [radius, depth] = at;
        let mut sum = [0.0; 2];
        for (x, weight) in gauss_legendre(16) {
            let rho = 0.5 * disc * (1.0 + x);
            for angle in 0..ANGLES {
                let phi = PI * (angle as f64 + 0.5) / ANGLES as f64;
                let across = radius - rho * libm::cos(phi);
                let square = across * across + (rho * libm::sin(phi)).powi(2);
                let [along, down] = self.of_unit_force(square, depth);
                sum[0] += weight * rho * along * across;
                sum[1] += weight * rho * down;
            }
        }
        // Half of the circle twice, and the half-length of the radius.
        let area = 2.0 * (PI / ANGLES as f64) * 0.5 * disc;
        sum.map(|of| pressure * area * of)
    }

    /// Vertical displacement \[m\] on the axis of the disc at a depth \[m\].
    #[must_use]
    pub fn axis_displacement(&self, [pressure, disc]: [f64; 2], depth: f64) -> f64 {
        let (nu, far) = (self.poisson, libm::hypot(disc, depth));
        (1.0 + nu) * pressure / self.young
            * (depth * (1.0 - depth / far) + 2.0 * (1.0 - nu) * (far - depth))
    }

    /// Radial and vertical stress \[Pa\] on the axis of the disc at a depth \[m\].
    #[must_use]
    pub fn axis_stress(&self, [pressure, disc]: [f64; 2], depth: f64) -> [f64; 2] {
        let cosine = depth / libm::hypot(disc, depth);
        let cube = cosine.powi(3);
        let nu = self.poisson;
        [
            -0.5 * pressure * (1.0 + 2.0 * nu - 2.0 * (1.0 + nu) * cosine + cube),
            -pressure * (1.0 - cube),
        ]
    }

    /// Force \[N\] that sinks a smooth rigid flat punch of a radius by a way \[m\]: 2 E a d/(1 - nu²) (Johnson 1985, eq. 3.36).
    #[must_use]
    pub fn punch_load(&self, [sunk, punch]: [f64; 2]) -> f64 {
        2.0 * self.young * punch * sunk / (1.0 - self.poisson * self.poisson)
    }

    /// Radial and vertical displacement \[m\] under such a punch, at a radius and a depth \[m\]: the pressure
    /// P/(2 pi a sqrt(a² - r²)) at Gauss points of the angle whose sine is r/a, midpoints around it. It is good to 1e-9 from half a
    /// radius beyond the edge on.
    #[must_use]
    pub fn punch_displacement(&self, [sunk, punch]: [f64; 2], at: [f64; 2]) -> [f64; 2] {
        const ANGLES: usize = 48;
        let [radius, depth] = at;
        let mut sum = [0.0; 2];
        for (x, weight) in gauss_legendre(16) {
            let theta = 0.25 * PI * (1.0 + x);
            let (sin, weight) = (libm::sin(theta), 0.25 * PI * weight);
            for angle in 0..ANGLES {
                let phi = PI * (angle as f64 + 0.5) / ANGLES as f64;
                let across = radius - punch * sin * libm::cos(phi);
                let square = across * across + (punch * sin * libm::sin(phi)).powi(2);
                let [along, down] = self.of_unit_force(square, depth);
                sum[0] += weight * sin * along * across;
                sum[1] += weight * sin * down;
            }
        }
        // Of the whole force a share sin(theta) d theta d phi/(2 pi), and half of the circle twice.
        let force = self.punch_load([sunk, punch]) / ANGLES as f64;
        sum.map(|of| force * of)
    }

    /// Vertical stress \[Pa\] on the axis of the punch at a depth \[m\]: -P/(2 pi a²) (1 + 3 (z/a)²)/(1 + (z/a)²)².
    #[must_use]
    pub fn punch_axis_stress(&self, [sunk, punch]: [f64; 2], depth: f64) -> f64 {
        let square = (depth / punch).powi(2);
        let middle = self.punch_load([sunk, punch]) / (2.0 * PI * punch * punch);
        -middle * (1.0 + 3.0 * square) / (1.0 + square).powi(2)
    }
}
