//! Confined compression of an elastic solid that yields: a stress with two slopes over the strain.
//!
//! With no strain across the axis the stress rises with `M_c = lambda + 2 G` up to a limit q_y and with a smaller modulus M_p
//! from there on, as long as it rises. Compression is positive here: q along the axis, s across it, strain e = -ln J. The
//! limits and slopes of von Mises follow from `q - s = Y(k)`, those of Mohr and Coulomb at the edge where the two
//! stresses across the axis are equal, those of Drucker and Prager from the cone; each by elastic strain plus flow.
//!
//! The law has one branch, so that work and energy follow from the slopes: what is done is the area under them, what is
//! stored is that of Hooke's law at (q, s, s), and the difference is dissipated.

/// The response of a solid to one monotonic compression in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoSlopes {
    /// Lamé's first constant, Pa.
    pub lambda: f64,
    /// Shear modulus G, Pa.
    pub shear: f64,
    /// Compression q_y at which it yields, Pa.
    pub limit: f64,
    /// Modulus M_p beyond the limit, Pa.
    pub plastic_modulus: f64,
    /// Compression across the axis beyond the limit is the first times q plus the second, Pa.
    pub across: [f64; 2],
}

/// Lamé's constants, Pa, of Young's modulus (Pa) and Poisson's ratio.
fn lame(young: f64, poisson: f64) -> (f64, f64) {
    let shear = young / (2.0 * (1.0 + poisson));
    (2.0 * shear * poisson / (1.0 - 2.0 * poisson), shear)
}

impl TwoSlopes {
    /// Von Mises with the yield stress `Y = yield_stress + hardening k` (Pa): `q_y = Y_0 M_c/2G`,
    /// `M_p = K + (4G/3) H/(3G + H)`, and `k = 2G (e - e_y)/(3G + H)`.
    #[must_use]
    pub fn von_mises(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Self {
        let (lambda, shear) = lame(young, poisson);
        let bulk = lambda + 2.0 * shear / 3.0;
        let limit = yield_stress * (lambda + 2.0 * shear) / (2.0 * shear);
        let stiffness = 3.0 * shear + hardening;
        let plastic_modulus = bulk + 4.0 * shear / 3.0 * hardening / stiffness;
        // s = q - Y_0 - H k.
        let growth = 2.0 * shear * hardening / (plastic_modulus * stiffness);
        Self {
            lambda,
            shear,
            limit,
            plastic_modulus,
            across: [1.0 - growth, growth * limit - yield_stress],
        }
    }

    /// Mohr-Coulomb with angles of friction and dilation (degrees) and cohesion (Pa); Tresca where both angles are zero.
    ///
    /// It yields where `K_0 = nu/(1 - nu) < K_a = (1 - sin phi)/(1 + sin phi)`; elsewhere the limit is negative or infinite.
    /// Then `s = K_a q - 2 c sqrt(K_a)`, and both planes through the edge flow by the same multiplier h.
    #[must_use]
    pub fn mohr_coulomb(
        young: f64,
        poisson: f64,
        [friction, cohesion, dilation]: [f64; 3],
    ) -> Self {
        let (lambda, shear) = lame(young, poisson);
        let confined = lambda + 2.0 * shear;
        let (sine, cosine) = (
            libm::sin(friction.to_radians()),
            libm::cos(friction.to_radians()),
        );
        let flow = libm::sin(dilation.to_radians());
        let strain = 2.0 * cohesion * cosine / ((1.0 - sine) * confined - (1.0 + sine) * lambda);
        let driven = 2.0 * (2.0 * shear * (1.0 - sine) - 2.0 * sine * lambda);
        let resisting = 8.0 * lambda * sine * flow
            + 4.0 * shear * (1.0 + sine * flow)
            + 2.0 * shear * (1.0 - sine) * (1.0 - flow);
        let h = driven / resisting;
        let active = (1.0 - sine) / (1.0 + sine);
        Self {
            lambda,
            shear,
            limit: confined * strain,
            plastic_modulus: confined + h * (2.0 * lambda * flow - 2.0 * shear * (1.0 - flow)),
            across: [active, -2.0 * cohesion * active.sqrt()],
        }
    }

    /// Drucker-Prager with `sqrt(J_2) + eta p <= xi c` (p the mean stress, tension positive) and flow along
    /// `sqrt(J_2) + eta_psi p`, given as eta, xi c (Pa) and eta_psi. It yields where `2 G/sqrt(3) > eta K`.
    #[must_use]
    pub fn drucker_prager(young: f64, poisson: f64, [eta, strength, eta_psi]: [f64; 3]) -> Self {
        let (lambda, shear) = lame(young, poisson);
        let bulk = lambda + 2.0 * shear / 3.0;
        let confined = lambda + 2.0 * shear;
        let root = 3.0_f64.sqrt();
        let [of_yield, of_flow] = [eta, eta_psi].map(|slope| 2.0 * shear / root - slope * bulk);
        // (q - s)/sqrt(3) - eta (q + 2 s)/3 = xi c.
        let part = 1.0 / root + 2.0 * eta / 3.0;
        Self {
            lambda,
            shear,
            limit: strength * confined / of_yield,
            plastic_modulus: confined - of_yield * of_flow / (shear + bulk * eta * eta_psi),
            across: [(1.0 / root - eta / 3.0) / part, -strength / part],
        }
    }

    /// Modulus below the limit, `M_c = lambda + 2 G`, Pa.
    #[must_use]
    pub fn confined_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.shear
    }

    /// Strain e under the compression `q` (Pa).
    #[must_use]
    pub fn strain(&self, q: f64) -> f64 {
        q.min(self.limit) / self.confined_modulus()
            + (q - self.limit).max(0.0) / self.plastic_modulus
    }

    /// Compression across the axis, Pa, under `q` (Pa) along it.
    #[must_use]
    pub fn across(&self, q: f64) -> f64 {
        if q <= self.limit {
            self.lambda / self.confined_modulus() * q
        } else {
            self.across[0] * q + self.across[1]
        }
    }

    /// Elastic energy, J/m³, under `q` (Pa): `p²/2K + (q - s)²/6G`.
    #[must_use]
    pub fn stored(&self, q: f64) -> f64 {
        let s = self.across(q);
        let (mean, bulk) = ((q + 2.0 * s) / 3.0, self.lambda + 2.0 * self.shear / 3.0);
        0.5 * mean * mean / bulk + (q - s).powi(2) / (6.0 * self.shear)
    }

    /// Plastic work, J/m³, once the compression has risen to `q` (Pa): the area under both slopes less what is stored.
    #[must_use]
    pub fn plastic_work(&self, q: f64) -> f64 {
        if q <= self.limit {
            return 0.0;
        }
        let elastic = 0.5 * self.limit * self.limit / self.confined_modulus();
        let beyond = 0.5 * (q * q - self.limit * self.limit) / self.plastic_modulus;
        elastic + beyond - self.stored(q)
    }
}
