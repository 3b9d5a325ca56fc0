//! Modified Cam clay in the triaxial test, the oedometer and under pressure alone, in closed form.
//!
//! Roscoe and Burland 1968, with straight lines of ln v against ln p (Butterfield 1979). p, q and strains are positive
//! in
//! compression, `eta = q/p`, `s = 1 - kappa/lambda`; shear modulus `G = r p/kappa`, `r = 3 (1 - 2 nu)/(2 (1 + nu))`.
//! Paths begin on the
//! yield surface.

/// The clay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamClayExact {
    /// Stress ratio at the critical state M.
    pub critical_ratio: f64,
    /// Slope of ln v against ln p in first compression, lambda.
    pub compression: f64,
    /// Slope in swelling, kappa.
    pub swelling: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Pressure at the start `p_0`, Pa.
    pub pressure: f64,
}

impl CamClayExact {
    /// Share of a volume strain in first compression that is plastic, `1 - kappa/lambda`.
    #[must_use]
    pub fn plastic_share(&self) -> f64 {
        1.0 - self.swelling / self.compression
    }

    fn proportion(&self) -> f64 {
        3.0 * (1.0 - 2.0 * self.poisson) / (2.0 * (1.0 + self.poisson))
    }

    /// Pressure on the undrained path at a stress ratio, Pa, from one of `eta_0` on the yield surface.
    #[must_use]
    pub fn undrained_pressure(&self, eta: f64, eta_0: f64) -> f64 {
        let square = self.critical_ratio.powi(2);
        let ratio = (square + eta_0 * eta_0) / (square + eta * eta);
        self.pressure * libm::pow(ratio, self.plastic_share())
    }

    /// Deviator strain on the undrained path between two stress ratios: `kappa s (2/M) [artanh - arctan](x/M)` is
    /// plastic,
    /// `(kappa/(3 r)) [x (1 - 2 s) + 2 s M arctan(x/M)]` elastic.
    #[must_use]
    pub fn undrained_strain(&self, eta: f64, eta_0: f64) -> f64 {
        let (m, s) = (self.critical_ratio, self.plastic_share());
        let to = |x: f64| {
            let (y, arc) = (x / m, libm::atan(x / m));
            let plastic = self.swelling * s * 2.0 / m * (libm::atanh(y) - arc);
            let elastic = x * (1.0 - 2.0 * s) + 2.0 * s * m * arc;
            plastic + self.swelling / (3.0 * self.proportion()) * elastic
        };
        to(eta) - to(eta_0)
    }

    /// Pressure on the drained path q = 3 (p - `p_0`), Pa, from no shear.
    #[must_use]
    pub fn drained_pressure(&self, eta: f64) -> f64 {
        3.0 * self.pressure / (3.0 - eta)
    }

    /// Volume strain on the drained path.
    #[must_use]
    pub fn drained_volume_strain(&self, eta: f64) -> f64 {
        let risen = libm::log(self.drained_pressure(eta) / self.pressure);
        let hardened = risen + libm::log1p((eta / self.critical_ratio).powi(2));
        self.swelling * risen + (self.compression - self.swelling) * hardened
    }

    /// Deviator strain on the drained path.
    #[must_use]
    pub fn drained_strain(&self, eta: f64) -> f64 {
        let m = self.critical_ratio;
        let integral = |x: f64| {
            -libm::log(m - x) / (3.0 - m) - libm::log(m + x) / (3.0 + m)
                + 6.0 / (9.0 - m * m) * libm::log(3.0 - x)
        };
        let y = eta / m;
        let bent = 2.0 / m * (libm::atanh(y) - libm::atan(y));
        let plastic = integral(eta) - integral(0.0) + bent;
        let risen = libm::log(self.drained_pressure(eta) / self.pressure);
        (self.compression - self.swelling) * plastic + self.swelling / self.proportion() * risen
    }

    /// Stress ratio in first compression in the oedometer: `eta (1 - s)/(2 r) + 3 eta s/(M² - eta²) = 1`, by bisection.
    #[must_use]
    pub fn ratio_at_rest(&self) -> f64 {
        let (m, s) = (self.critical_ratio, self.plastic_share());
        let off = |eta: f64| {
            eta * (1.0 - s) / (2.0 * self.proportion()) + 3.0 * eta * s / (m * m - eta * eta) - 1.0
        };
        let (mut low, mut high) = (0.0, m * (1.0 - 1e-12));
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if off(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// Coefficient of earth pressure at rest, `K_0 = (3 - eta)/(3 + 2 eta)`.
    #[must_use]
    pub fn at_rest(&self) -> f64 {
        let eta = self.ratio_at_rest();
        (3.0 - eta) / (3.0 + 2.0 * eta)
    }
}
