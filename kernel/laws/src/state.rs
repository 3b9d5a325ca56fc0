//! The pressure of a fluid as a function of its volume.

use super::{Constant, ConstantDefault, ConstantRange, Increment};
use crate::functions;
use proctor_kernel::lanes::Lanes;

/// Bulk modulus of a fluid.
pub(super) const BULK: Constant = Constant {
    key: "bulk",
    meaning: "Bulk modulus of the fluid",
    unit: "Pa",
    accepted: ConstantRange::Positive,
    given: ConstantDefault::Needed,
};

/// Exponent of Tait's equation.
pub(super) const EXPONENT: Constant = Constant {
    key: "exponent",
    meaning: "Exponent n of the pressure K/n (J^-n - 1) of a volume ratio J (Tait); 0 is its limit, -K ln J",
    unit: "",
    accepted: ConstantRange::NotNegative,
    given: ConstantDefault::Or(0.0),
};

/// Volume strain up to which energy is a power series: beyond, the closed form has lost no digits.
const SERIES: f64 = 0.05;
/// Terms of that series; the last is below 1e-17 of the first for exponents up to 20.
const TERMS: usize = 30;

/// Pressure p(J) = K/n (J^-n - 1) of the volume ratio J (Tait 1888, Murnaghan 1944), -K ln J for n = 0. It is a function of
/// the state: a cycle of volume brings it back to round-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquationOfState {
    /// Bulk modulus at rest, K \[Pa\].
    pub bulk: f64,
    /// Exponent n; 0 for the logarithm.
    pub exponent: f64,
    /// True if the fluid carries tension; one that does not parts where it would, at no pressure.
    pub carries_tension: bool,
}

impl EquationOfState {
    /// Pressure \[Pa\], compression positive, and its slope -J dp/dJ \[Pa\], at a volume ratio. The slope of a fluid that has
    /// parted is that at which it closes.
    #[inline(always)]
    pub(super) fn pressure<L: Lanes>(&self, j: L) -> (L, L) {
        let bulk = L::splat(self.bulk);
        let strain = functions::ln(j);
        let (pressure, slope) = if self.exponent == 0.0 {
            (-(bulk * strain), bulk)
        } else {
            let power = functions::exp(L::splat(-self.exponent) * strain);
            (
                L::splat(self.bulk / self.exponent) * (power - L::splat(1.0)),
                bulk * power,
            )
        };
        if self.carries_tension {
            (pressure, slope)
        } else {
            (pressure.max(L::splat(0.0)), slope.max(bulk))
        }
    }

    /// The share of a volume that is fluid: 1, or 1/J where the fluid has parted. Shear stress is carried by that share alone.
    #[inline(always)]
    pub(super) fn share<L: Lanes>(&self, j: L) -> L {
        let one = L::splat(1.0);
        if self.carries_tension {
            one
        } else {
            one / j.max(one)
        }
    }

    /// The volume of a unit of mass \[m³/kg\] on which a wave speed depends, of a particle: no more than that at which a
    /// fluid that has parted closes.
    #[inline(always)]
    pub(super) fn specific_volume<L: Lanes>(&self, increment: &Increment<L>) -> L {
        let specific = increment.volume / increment.mass;
        if self.carries_tension {
            specific
        } else {
            specific.min(L::splat(1.0 / increment.density))
        }
    }

    /// Square of the speed of sound \[m²/s²\], dp/d rho = -J dp/dJ / rho, at rest and an initial density \[kg/m³\].
    #[must_use]
    pub fn sound_squared(&self, density: f64) -> f64 {
        self.bulk / density
    }

    /// Volume ratio under a mean stress \[Pa\] (tension positive); not a number where there is none.
    #[must_use]
    pub fn volume_ratio(&self, mean_stress: f64) -> f64 {
        let strain = mean_stress / self.bulk;
        if self.exponent == 0.0 {
            libm::exp(strain)
        } else {
            // (1 + n p/K)^(-1/n).
            libm::exp(-libm::log1p(-self.exponent * strain) / self.exponent)
        }
    }

    /// Energy per initial volume \[J/m³\], the integral of p from J to 1.
    #[must_use]
    pub fn energy_density(&self, j: f64) -> f64 {
        let (n, x) = (self.exponent, j - 1.0);
        if x > 0.0 && !self.carries_tension {
            return 0.0;
        }
        if x.abs() < SERIES {
            // p/K = sum b_k x^k with b_1 = -1 and b_(k+1) = -b_k (n + k)/(k + 1).
            let (mut b, mut power, mut sum) = (-1.0, x * x, 0.0);
            for k in 1..=TERMS {
                let k = k as f64;
                sum -= b * power / (k + 1.0);
                b *= -(n + k) / (k + 1.0);
                power *= x;
            }
            return self.bulk * sum;
        }
        let strain = libm::log(j);
        if n == 0.0 {
            return self.bulk * (j * strain - x);
        }
        let inner = if n == 1.0 {
            -strain
        } else {
            libm::expm1((1.0 - n) * strain) / (n - 1.0)
        };
        self.bulk / n * (inner + x)
    }
}
