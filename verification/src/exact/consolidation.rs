//! Consolidation in one dimension: Terzaghi's series with compressible water, and that of Xie and Leo at large strain.
//!
//! Terzaghi 1925: `p_t = c_v p_zz + (p_0/Q) Q_t` with `c_v = (k/(rho_w g))/(1/E_c + n/K_w)` and `p_0/Q = (K_w/n)/(E_c
//! + K_w/n)`. Under a
//! load that comes on in equal shares of the time `t_r` each mode `(2/M) sin(M d/H)`, `M = (2m + 1) pi/2`, d from the
//! drained top, has
//! the amplitude `(e^(-L (t - t_r)) - e^(-L t))/(L t_r)`, `L = M² c_v/H²`.
//!
//! Xie and Leo 2004, here of a skeleton `sigma' = -E_c ln J`, a conductivity `k J²`, water that keeps its volume, and
//! no weight: J obeys
//! the linear equation of diffusion in the height at the start.

use std::f64::consts::PI;

/// Modes beyond which terms are below 1e-17, from `T_v` = 1e-4 on.
const MODES: usize = 400;

/// A layer on a shut base that drains at its top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Height H, m.
    pub height: f64,
    /// Confined modulus of the skeleton `E_c`, Pa.
    pub confined_modulus: f64,
    /// Bulk modulus of the water over the porosity `K_w/n`, Pa; infinite for water that keeps its volume.
    pub storage: f64,
    /// Hydraulic conductivity over the weight of water `k/(rho_w g)`, m⁴/(N s).
    pub mobility: f64,
    /// Load Q, Pa.
    pub load: f64,
}

/// Average degree of consolidation at a time factor `T_v = c_v t/H²`.
#[must_use]
pub fn degree(time_factor: f64) -> f64 {
    let left = series(|m| 2.0 / (m * m) * libm::exp(-m * m * time_factor));
    1.0 - left
}

impl Layer {
    /// Coefficient of consolidation `c_v`, m²/s.
    #[must_use]
    pub fn consolidation(&self) -> f64 {
        self.mobility / (1.0 / self.confined_modulus + 1.0 / self.storage)
    }

    /// Pressure of the water at once, Pa, under the load that comes on at once.
    #[must_use]
    pub fn undrained_pressure(&self) -> f64 {
        self.load / (1.0 + self.confined_modulus / self.storage)
    }

    /// Pressure of the water, Pa, at the height z (m) at `t` (s) after the load began to come on in `ramp` (s); 0 for
    /// at once.
    #[must_use]
    pub fn pressure(&self, z: f64, t: f64, ramp: f64) -> f64 {
        let depth = 1.0 - z / self.height;
        let all = |m: f64| 2.0 / m * libm::sin(m * depth) * self.amplitude(m, t, ramp);
        self.undrained_pressure() * series(all)
    }

    /// Displacement of the top, m: the strain is that of the effective stress, `(Q - p)/E_c`.
    #[must_use]
    pub fn settlement(&self, t: f64, ramp: f64) -> f64 {
        let share = if ramp > 0.0 { (t / ramp).min(1.0) } else { 1.0 };
        let mean = series(|m| 2.0 / (m * m) * self.amplitude(m, t, ramp));
        let effective = self.load * share - self.undrained_pressure() * mean;
        -self.height * effective / self.confined_modulus
    }

    fn amplitude(&self, m: f64, t: f64, ramp: f64) -> f64 {
        let rate = m * m * self.consolidation() / (self.height * self.height);
        if ramp == 0.0 {
            return libm::exp(-rate * t);
        }
        let since = (t - ramp).max(0.0);
        let on = t.min(ramp);
        // (e^(-L since) - e^(-L t))/(L t_r), which is on/t_r where L is small.
        -libm::exp(-rate * since) * libm::expm1(-rate * on) / (rate * ramp)
    }

    /// Pressure of the water at large strain, Pa, at the height z at the start (m), of a load that came on at once.
    #[must_use]
    pub fn large_pressure(&self, z: f64, t: f64) -> f64 {
        let factor = self.large_time_factor(t);
        let depth = 1.0 - z / self.height;
        let left = series(|m| 2.0 / m * libm::sin(m * depth) * libm::exp(-m * m * factor));
        // u = Q - sigma' with sigma' = -E_c ln J and J = e^(-Q/E_c) + (1 - e^(-Q/E_c)) left.
        let strain = self.load / self.confined_modulus;
        self.confined_modulus * libm::log1p(libm::expm1(strain) * left)
    }

    /// Displacement of the top at large strain, m.
    #[must_use]
    pub fn large_settlement(&self, t: f64) -> f64 {
        let strain = self.load / self.confined_modulus;
        self.height * libm::expm1(-strain) * degree(self.large_time_factor(t))
    }

    /// `c_v t/H²` of the layer at the start, with water that keeps its volume.
    fn large_time_factor(&self, t: f64) -> f64 {
        self.mobility * self.confined_modulus * t / (self.height * self.height)
    }
}

/// A sum over `M = (2m + 1) pi/2`, the smallest first.
fn series(term: impl Fn(f64) -> f64) -> f64 {
    let odd = (0..MODES).rev();
    odd.map(|m| term((2 * m + 1) as f64 * 0.5 * PI)).sum()
}
