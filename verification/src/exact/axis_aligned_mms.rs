//! The axis-aligned manufactured solution (verification notes, A1 and A2) in one to three dimensions.
//!
//! Every material line parallel to an axis stretches along itself:
//! `u_i = A sin(k X_i) sin(W t + phi_i)`, `F_i = 1 + A k cos(k X_i) sin(W t + phi_i)`, shear free, on rollers at
//! the planes `k X_i = n pi`. The body force that makes it a motion follows from `rho0 a = div P + rho0 b`.
//! For the neo-Hookean law with phases 0, 2 pi/3, 4 pi/3 and `k = pi` it is the case of Uintah's verification set.

use libm::{cos, log, sin};

/// A material law of the axis-aligned solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Compressible neo-Hookean, `P = lambda ln J F^-T + mu (F - F^-T)`.
    NeoHookean,
    /// Linear elastic in rate form, `d sigma/dt = lambda tr(D) I + 2 mu D`; without rotation it integrates to
    /// `sigma_i = lambda ln J + 2 mu ln F_i`.
    RateElastic,
}

/// Axis-aligned motion in `D` dimensions; directions beyond `D` do not strain (plane strain).
#[derive(Debug, Clone, PartialEq)]
pub struct AxisAlignedMms<const D: usize> {
    /// Material law.
    pub law: Law,
    /// Lamé's first constant, Pa.
    pub lambda: f64,
    /// Shear modulus, Pa.
    pub mu: f64,
    /// Initial density, kg/m^3.
    pub density: f64,
    /// Displacement amplitude A, m; `A k < 1`, or the body inverts.
    pub amplitude: f64,
    /// Wave number k, 1/m.
    pub wave_number: f64,
    /// Angular frequency W, rad/s.
    pub angular_frequency: f64,
    /// Phases `phi_i`, rad.
    pub phases: [f64; D],
}

impl<const D: usize> AxisAlignedMms<D> {
    /// Displacement, m, of the material point `x0` (m, initial position) at `t` (s).
    #[must_use]
    pub fn displacement(&self, x0: [f64; D], t: f64) -> [f64; D] {
        std::array::from_fn(|i| {
            self.amplitude * sin(self.wave_number * x0[i]) * sin(self.phase(i, t))
        })
    }

    /// Velocity, m/s, of the material point `x0`.
    #[must_use]
    pub fn velocity(&self, x0: [f64; D], t: f64) -> [f64; D] {
        let speed = self.amplitude * self.angular_frequency;
        std::array::from_fn(|i| speed * sin(self.wave_number * x0[i]) * cos(self.phase(i, t)))
    }

    /// Diagonal of the derivative of the velocity by the initial position, 1/s; at rest without displacement it is the
    /// velocity gradient.
    #[must_use]
    pub fn stretch_rates(&self, x0: [f64; D], t: f64) -> [f64; D] {
        let k = self.wave_number;
        let rate = self.amplitude * self.angular_frequency * k;
        std::array::from_fn(|i| rate * cos(k * x0[i]) * cos(self.phase(i, t)))
    }

    /// Diagonal of the deformation gradient.
    #[must_use]
    pub fn stretches(&self, x0: [f64; D], t: f64) -> [f64; D] {
        let k = self.wave_number;
        std::array::from_fn(|i| 1.0 + self.amplitude * k * cos(k * x0[i]) * sin(self.phase(i, t)))
    }

    /// Body force per mass, m/s^2, on the material point `x0`.
    ///
    /// `b_i = -W^2 u_i + (k^2 u_i / rho0) K_i`, where `K_i = dP_i/dF_i` is
    /// `mu + (lambda (1 - ln J) + mu)/F_i^2` for the neo-Hookean law and
    /// `(lambda + 2 mu) J / F_i^2` for the rate law (`J/F_i` does not vary along `i`).
    #[must_use]
    pub fn body_force(&self, x0: [f64; D], t: f64) -> [f64; D] {
        let u = self.displacement(x0, t);
        let f = self.stretches(x0, t);
        let j: f64 = f.iter().product();
        let (lambda, mu) = (self.lambda, self.mu);
        std::array::from_fn(|i| {
            let stiffness = match self.law {
                Law::NeoHookean => mu + (lambda * (1.0 - log(j)) + mu) / (f[i] * f[i]),
                Law::RateElastic => (lambda + 2.0 * mu) * j / (f[i] * f[i]),
            };
            u[i] * (self.wave_number.powi(2) * stiffness / self.density
                - self.angular_frequency.powi(2))
        })
    }

    /// Principal Cauchy stresses along x, y, z, Pa, at the material point `x0`.
    ///
    /// Neo-Hookean: `sigma_i = (lambda ln J + mu (F_i^2 - 1))/J`; rate law: `lambda ln J + 2 mu ln F_i`.
    #[must_use]
    pub fn stress(&self, x0: [f64; D], t: f64) -> [f64; 3] {
        let f = self.stretches(x0, t);
        let j: f64 = f.iter().product();
        std::array::from_fn(|i| {
            let f_i = f.get(i).copied().unwrap_or(1.0);
            match self.law {
                Law::NeoHookean => (self.lambda * log(j) + self.mu * (f_i * f_i - 1.0)) / j,
                Law::RateElastic => self.lambda * log(j) + 2.0 * self.mu * log(f_i),
            }
        })
    }

    fn phase(&self, axis: usize, t: f64) -> f64 {
        self.angular_frequency * t + self.phases[axis]
    }
}
