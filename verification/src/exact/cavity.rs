//! A spherical cavity in an elastic space without end, in which a pressure begins to act at once.
//!
//! Blake 1952, *J. Acoust. Soc. Am.* 24, 211; Graff 1975, section 5.2. With tau = t - (r - a)/c, alpha = 2 c_s²/(c a),
//! omega = 2 c_s/a and beta = omega sqrt(1 - (c_s/c)²) the potential is
//! phi = -(p a³/(4 mu)) (1 - exp(-alpha tau) (cos(beta tau) + (alpha/beta) sin(beta tau))), and u = -phi'/(c r) - phi/r².

use std::f64::consts::TAU;

/// The cavity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cavity {
    /// Radius \[m\].
    pub radius: f64,
    /// Pressure \[Pa\].
    pub pressure: f64,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density \[kg/m³\].
    pub density: f64,
}

impl Cavity {
    /// Shear modulus \[Pa\].
    #[must_use]
    pub fn shear(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// Lamé's first constant \[Pa\].
    fn lambda(&self) -> f64 {
        2.0 * self.shear() * self.poisson / (1.0 - 2.0 * self.poisson)
    }

    /// Speed of pressure waves \[m/s\].
    #[must_use]
    pub fn speed(&self) -> f64 {
        ((self.lambda() + 2.0 * self.shear()) / self.density).sqrt()
    }

    /// The potential \[m³\] and its first three derivatives by time, at a time after the front; zero before.
    fn potential(&self, tau: f64) -> [f64; 4] {
        if tau < 0.0 {
            return [0.0; 4];
        }
        let (c, shear) = (self.speed(), (self.shear() / self.density).sqrt());
        let alpha = 2.0 * shear * shear / (c * self.radius);
        let square = (2.0 * shear / self.radius).powi(2);
        let beta = (square - alpha * alpha).sqrt();
        let scale = -self.pressure * self.radius.powi(3) / (4.0 * self.shear());
        // The angle within a turn, for the functions.
        let (sin, cos) = libm::sincos((beta * tau) % TAU);
        let decay = libm::exp(-alpha * tau);
        // f = 1 - e^(-alpha t) (cos + (alpha/beta) sin) is at rest at first, and f'' = square (1 - f) - 2 alpha f'.
        let f = 1.0 - decay * (cos + alpha / beta * sin);
        let first = decay * square / beta * sin;
        let second = square * (1.0 - f) - 2.0 * alpha * first;
        let third = -square * first - 2.0 * alpha * second;
        [f, first, second, third].map(|of| scale * of)
    }

    /// Time after the front passed a radius \[s\].
    fn after(&self, r: f64, t: f64) -> f64 {
        t - (r - self.radius) / self.speed()
    }

    /// Radial displacement at a radius and a time \[m\].
    #[must_use]
    pub fn displacement(&self, r: f64, t: f64) -> f64 {
        let [f, first, ..] = self.potential(self.after(r, t));
        -first / (self.speed() * r) - f / (r * r)
    }

    /// Radial velocity at a radius and a time \[m/s\].
    #[must_use]
    pub fn velocity(&self, r: f64, t: f64) -> f64 {
        let [_, first, second, _] = self.potential(self.after(r, t));
        -second / (self.speed() * r) - first / (r * r)
    }

    /// Derivative of the radial velocity by the radius \[1/s\].
    #[must_use]
    pub fn velocity_slope(&self, r: f64, t: f64) -> f64 {
        let [_, first, second, third] = self.potential(self.after(r, t));
        let c = self.speed();
        third / (c * c * r) + 2.0 * second / (c * r * r) + 2.0 * first / (r * r * r)
    }

    /// Radial and hoop stress at a radius and a time \[Pa\].
    #[must_use]
    pub fn stress(&self, r: f64, t: f64) -> [f64; 2] {
        let [f, first, second, _] = self.potential(self.after(r, t));
        let c = self.speed();
        let along = second / (c * c * r) + 2.0 * first / (c * r * r) + 2.0 * f / (r * r * r);
        let around = self.displacement(r, t) / r;
        let mean = self.lambda() * (along + 2.0 * around);
        [along, around].map(|strain| mean + 2.0 * self.shear() * strain)
    }
}
