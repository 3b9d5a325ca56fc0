//! A manufactured motion of a neo-Hookean body of revolution, on a cylinder of radius and height 1 m between fixed planes.
//!
//! `u_r = A sin(W t) sin(pi R) sin(pi Z) (1 + 0.3 Z - 0.2 R²)` is odd in R, and
//! `u_z = A sin(W t) cos(pi R/2) sin(pi Z) (1 - 0.2 Z + 0.3 R²)` even and not zero on the axis. The body force follows from
//! `b = x'' - (dP_rR/dR + dP_rZ/dZ + (P_rR - P_tT)/R)/rho0` and `b = x'' - (dP_zR/dR + dP_zZ/dZ + P_zR/R)/rho0`, with derivatives by
//! forward mode.

use super::jet::{Jet, Scalar};
use std::f64::consts::PI;

/// The motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RevolvedMms {
    /// Lamé's first constant \[Pa\].
    pub lambda: f64,
    /// Shear modulus \[Pa\].
    pub mu: f64,
    /// Initial density \[kg/m³\].
    pub density: f64,
    /// Amplitude A \[m\].
    pub amplitude: f64,
    /// Angular frequency W \[rad/s\].
    pub angular_frequency: f64,
}

/// A deformation gradient or a stress of a body of revolution: rr, rz, zr, zz, tt.
type Round<T> = [T; 5];

impl RevolvedMms {
    /// The displacement over the amplitude and the sine of time, of the material that is at R and Z at first.
    fn shape<T: Scalar>([r, z]: [T; 2]) -> [T; 2] {
        let of = T::of;
        let up = (of(PI) * z).sin();
        let square = r * r;
        [
            (of(PI) * r).sin() * up * (of(1.0) + of(0.3) * z - of(0.2) * square),
            (of(0.5 * PI) * r).cos() * up * (of(1.0) - of(0.2) * z + of(0.3) * square),
        ]
    }

    /// Displacement, radial and along the axis \[m\].
    #[must_use]
    pub fn displacement(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let scale = self.amplitude * libm::sin(self.angular_frequency * t);
        Self::shape(x0).map(|of| scale * of)
    }

    /// Velocity \[m/s\].
    #[must_use]
    pub fn velocity(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let (w, a) = (self.angular_frequency, self.amplitude);
        Self::shape(x0).map(|of| a * w * libm::cos(w * t) * of)
    }

    /// Derivative of the velocity at the start by the place: rr, rz, zr, zz, tt \[1/s\].
    #[must_use]
    pub fn velocity_gradient(&self, x0: [f64; 2]) -> [f64; 5] {
        let scale = self.amplitude * self.angular_frequency;
        let at = [0, 1].map(|axis| Jet::<2>::variable(x0[axis], axis));
        let [along, up] = Self::shape(at);
        let [[rr, rz], [zr, zz]] = [along.partials, up.partials];
        [rr, rz, zr, zz, along.value / x0[0]].map(|of| scale * of)
    }

    /// Deformation gradient, in the numbers of the place.
    fn gradient<T: Scalar>(&self, x0: [T; 2], t: f64) -> Round<T> {
        let scale = T::of(self.amplitude * libm::sin(self.angular_frequency * t));
        let at = [0, 1].map(|axis| Jet::<2, T>::variable(x0[axis], axis));
        let [along, up] = Self::shape(at);
        let one = T::of(1.0);
        [
            one + scale * along.partials[0],
            scale * along.partials[1],
            scale * up.partials[0],
            one + scale * up.partials[1],
            one + scale * along.value / x0[0],
        ]
    }

    /// First Piola-Kirchhoff stress, P = lambda ln J F^-T + mu (F - F^-T).
    fn nominal<T: Scalar>(&self, [rr, rz, zr, zz, tt]: Round<T>) -> Round<T> {
        let (lambda, mu) = (T::of(self.lambda), T::of(self.mu));
        let plane = rr * zz - rz * zr;
        let inverse = [zz / plane, -(zr / plane), -(rz / plane), rr / plane];
        let factor = lambda * (plane * tt).ln() - mu;
        [
            factor * inverse[0] + mu * rr,
            factor * inverse[1] + mu * rz,
            factor * inverse[2] + mu * zr,
            factor * inverse[3] + mu * zz,
            factor / tt + mu * tt,
        ]
    }

    /// Cauchy stress: rr, zz, tt, rz \[Pa\].
    #[must_use]
    pub fn stress(&self, x0: [f64; 2], t: f64) -> [f64; 4] {
        let [rr, rz, zr, zz, tt] = self.gradient(x0, t);
        let [p_rr, p_rz, p_zr, p_zz, p_tt] = self.nominal([rr, rz, zr, zz, tt]);
        let j = (rr * zz - rz * zr) * tt;
        [
            (p_rr * rr + p_rz * rz) / j,
            (p_zr * zr + p_zz * zz) / j,
            p_tt * tt / j,
            (p_rr * zr + p_rz * zz) / j,
        ]
    }

    /// Body force per mass \[m/s²\].
    #[must_use]
    pub fn body_force(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let at = [0, 1].map(|axis| Jet::<2>::variable(x0[axis], axis));
        let [rr, rz, zr, zz, tt] = self.nominal(self.gradient(at, t));
        let divergence = [
            rr.partials[0] + rz.partials[1] + (rr.value - tt.value) / x0[0],
            zr.partials[0] + zz.partials[1] + zr.value / x0[0],
        ];
        let u = self.displacement(x0, t);
        let square = self.angular_frequency * self.angular_frequency;
        std::array::from_fn(|i| -square * u[i] - divergence[i] / self.density)
    }
}
