//! Reflection of a plane wave of compression at dashpots of Lysmer and Kuhlemeyer on a plane.
//!
//! Source: Lysmer and Kuhlemeyer 1969. The plane carries the traction `rho c_p v_n` along its normal and `rho c_s v_t` along
//! itself, against the velocity. With the angle theta of the wave to the normal, `s = c_s/c_p` and `sin theta_s = s sin theta`,
//! the amplitudes A of the compression and B of the shear that go back follow from both components of the traction:
//!
//! ```text
//! (1 - 2 s² sin² theta + cos theta) A - (s sin 2 theta_s + sin theta_s) B = -(1 - 2 s² sin² theta) + cos theta
//! -(s² sin 2 theta + s sin theta) A - (s cos 2 theta_s + s cos theta_s) B = -s² sin 2 theta + s sin theta
//! ```
//!
//! The share of the energy that goes back is `A² + B² s cos theta_s/cos theta`: 0 at normal incidence.

/// Dashpots on the plane that bounds an elastic solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dashpots {
    /// Poisson's ratio of the solid.
    pub poisson: f64,
    /// Rates of the dashpots along the normal and along the plane, over those of Lysmer: 1, or 0 without dashpots.
    pub rates: [f64; 2],
}

impl Dashpots {
    /// Speed of shear over that of compression.
    fn speeds(&self) -> f64 {
        ((1.0 - 2.0 * self.poisson) / (2.0 * (1.0 - self.poisson))).sqrt()
    }

    /// Amplitudes of the compression and of the shear that a plane wave of compression of amplitude 1 sends back, at the angle
    /// theta (rad) to the normal.
    #[must_use]
    pub fn amplitudes(&self, theta: f64) -> [f64; 2] {
        let ([a, b], s) = (self.rates, self.speeds());
        let (sin, cos) = (libm::sin(theta), libm::cos(theta));
        let (sin_s, cos_s) = (s * sin, libm::cos(libm::asin(s * sin)));
        let pressed = 1.0 - 2.0 * s * s * sin * sin;
        let sheared = 2.0 * s * s * sin * cos;
        let m = [
            [pressed + a * cos, -(2.0 * s * sin_s * cos_s + a * sin_s)],
            [
                -(sheared + b * s * sin),
                -(s * (1.0 - 2.0 * sin_s * sin_s) + b * s * cos_s),
            ],
        ];
        let r = [-pressed + a * cos, -sheared + b * s * sin];
        let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        [
            (r[0] * m[1][1] - m[0][1] * r[1]) / determinant,
            (m[0][0] * r[1] - r[0] * m[1][0]) / determinant,
        ]
    }

    /// Share of the energy of a plane wave of compression that goes back, at the angle theta (rad) to the normal.
    #[must_use]
    pub fn reflected(&self, theta: f64) -> f64 {
        let ([compression, shear], s) = (self.amplitudes(theta), self.speeds());
        let cos_s = libm::cos(libm::asin(s * libm::sin(theta)));
        compression * compression + shear * shear * s * cos_s / libm::cos(theta)
    }

    /// The same of a pulse between two sliding sides, a mode of theirs: the mean over its plane waves. All have the wave number
    /// `across` between the sides; along them they lie about `along` as `exp(-(q a)²/2)`, in their potential, with the
    /// distance q from it and the half-length a of the pulse.
    #[must_use]
    pub fn reflected_pulse(&self, across: f64, along: f64, half_length: f64) -> f64 {
        const PARTS: i32 = 400;
        // A wave has the energy of the square of its potential and of the fourth power of its wave number.
        let (mut sum, mut weights) = (0.0, 0.0);
        for part in -PARTS..=PARTS {
            let s = 5.0 * f64::from(part) / f64::from(PARTS);
            let k = along + s / half_length;
            if k > 0.0 {
                let weight = libm::exp(-s * s) * (across * across + k * k).powi(2);
                sum += weight * self.reflected(libm::atan(across / k));
                weights += weight;
            }
        }
        sum / weights
    }
}
