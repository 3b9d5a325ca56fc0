//! An elastic layer in plane strain under a load that waves along its top, on a base without friction.
//!
//! `sigma_yy = -q cos kx` and no shear at the top y = H, no displacement across the base y = 0 and no shear there. With Airy's
//! function `(A cosh ky + B y sinh ky) cos kx`: `B = -q S/(k (S C + kH))`, `A = -B (S + kH C)/(k S)`, S = sinh kH, C = cosh kH
//! (Timoshenko and Goodier 1951, article 24). Water that cannot flow makes of a skeleton with the moduli G and K one with G and
//! `K + K_w/n`, and bears `-(K_w/n) tr eps`.

/// The layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WavyLayer {
    /// Height H, m.
    pub height: f64,
    /// Wave number k, 1/m.
    pub wave_number: f64,
    /// Amplitude q of the load, Pa.
    pub load: f64,
    /// Shear modulus G, Pa.
    pub shear: f64,
    /// Bulk modulus K of the skeleton, Pa.
    pub bulk: f64,
    /// Bulk modulus of the water over the porosity `K_w/n`, Pa; zero for a dry layer.
    pub storage: f64,
}

impl WavyLayer {
    /// Poisson's ratio of skeleton and water together.
    #[must_use]
    pub fn poisson(&self) -> f64 {
        let bulk = self.bulk + self.storage;
        (3.0 * bulk - 2.0 * self.shear) / (2.0 * (3.0 * bulk + self.shear))
    }

    /// A and B, Pa m² and Pa m.
    fn factors(&self) -> [f64; 2] {
        let (k, x) = (self.wave_number, self.wave_number * self.height);
        let (s, c) = (libm::sinh(x), libm::cosh(x));
        let b = -self.load * s / (k * (s * c + x));
        [-b * (s + x * c) / (k * s), b]
    }

    /// Total stress xx, yy, xy, Pa, at a place (m).
    #[must_use]
    pub fn stress(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let ([a, b], k) = (self.factors(), self.wave_number);
        let (s, c) = (libm::sinh(k * y), libm::cosh(k * y));
        let f = a * c + b * y * s;
        let slope = a * k * s + b * (s + k * y * c);
        let curvature = a * k * k * c + b * (2.0 * k * c + k * k * y * s);
        let (wave, side) = (libm::cos(k * x), libm::sin(k * x));
        [curvature * wave, -k * k * f * wave, k * slope * side]
    }

    /// Displacement up, m, at a place (m).
    #[must_use]
    pub fn rise(&self, [x, y]: [f64; 2]) -> f64 {
        let ([a, b], k) = (self.factors(), self.wave_number);
        let (s, c) = (libm::sinh(k * y), libm::cosh(k * y));
        let twice = -k * a * s - b * k * y * c + (1.0 - 2.0 * self.poisson()) * b * s;
        twice * libm::cos(k * x) / (2.0 * self.shear)
    }

    /// Pressure of the water, Pa, compression positive, at a place (m).
    #[must_use]
    pub fn pressure(&self, at: [f64; 2]) -> f64 {
        let [xx, yy, _] = self.stress(at);
        // (1 - 2 nu)/(2 G) of the stiff whole is (1 + nu)/(3 K).
        let volume = (1.0 + self.poisson()) / (3.0 * (self.bulk + self.storage)) * (xx + yy);
        -self.storage * volume
    }
}
