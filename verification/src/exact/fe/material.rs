//! The compressible neo-Hookean material in plane strain.

/// Energy per initial volume W = mu/2 (tr F^T F - 2) - mu ln J + lambda/2 (ln J)², from which the Cauchy stress is
/// sigma = (mu (F F^T - 1) + lambda ln J 1)/J. F is the 2 x 2 part of the deformation gradient, J its determinant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    /// First Lamé parameter lambda \[Pa\].
    pub lambda: f64,
    /// Shear modulus mu \[Pa\].
    pub shear: f64,
    /// Initial density \[kg/m³\].
    pub density: f64,
}

impl NeoHookean {
    /// Material of Young's modulus \[Pa\] and Poisson's ratio at small strain, and density \[kg/m³\].
    #[must_use]
    pub fn from_young(young: f64, poisson: f64, density: f64) -> Self {
        Self {
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            shear: 0.5 * young / (1.0 + poisson),
            density,
        }
    }

    /// Material of bulk and shear modulus \[Pa\], and density \[kg/m³\].
    #[must_use]
    pub fn from_bulk(bulk: f64, shear: f64, density: f64) -> Self {
        Self {
            lambda: bulk - 2.0 / 3.0 * shear,
            shear,
            density,
        }
    }

    /// Speed of pressure waves at rest \[m/s\].
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        ((self.lambda + 2.0 * self.shear) / self.density).sqrt()
    }

    /// First Piola-Kirchhoff stress P = mu (F - F^-T) + lambda ln J F^-T \[Pa\] and energy W \[J/m³\]; `None` where
    /// J is not positive.
    #[inline]
    #[must_use]
    pub fn stress_and_energy(&self, f: [[f64; 2]; 2]) -> Option<([[f64; 2]; 2], f64)> {
        let [[a, b], [c, d]] = f;
        let j = a * d - b * c;
        if j.is_nan() || j <= 0.0 {
            return None;
        }
        let log = libm::log(j);
        let pull = (self.lambda * log - self.shear) / j;
        let stress = [
            [self.shear * a + pull * d, self.shear * b - pull * c],
            [self.shear * c - pull * b, self.shear * d + pull * a],
        ];
        let energy = 0.5 * self.shear * (a * a + b * b + c * c + d * d - 2.0) - self.shear * log
            + 0.5 * self.lambda * log * log;
        Some((stress, energy))
    }
}
