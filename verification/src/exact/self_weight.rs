//! The column under its own weight (verification notes, A5): equilibrium at large strain.
//!
//! A column of initial height H, confined sideways by rollers, rests on its base. Equilibrium in the initial
//! configuration gives `sigma_yy = P = -rho0 g (H - Y)` whatever the law; the law gives the shape. With
//! `S = rho0 g H / M` (M the modulus of confined compression) the base has the nominal stress `-S M`.

use libm::{exp, log};

/// A material law of the self-weight column, in confined compression by the stretch F.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Small strain, `P = M (F - 1)`.
    SmallStrain,
    /// Linear elastic in rate form, `P = M ln F`.
    RateElastic,
    /// Hencky, `P = M ln(F)/F`.
    Hencky,
    /// Compressible neo-Hookean, `P = lambda ln(F)/F + mu (F - 1/F)`.
    NeoHookean,
}

/// A column under its own weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfWeightColumn {
    /// Material law.
    pub law: Law,
    /// Initial height H, m.
    pub height: f64,
    /// Initial density, kg/m^3.
    pub density: f64,
    /// Gravity g, downwards, m/s^2.
    pub gravity: f64,
    /// Lamé's first constant, Pa.
    pub lambda: f64,
    /// Shear modulus, Pa.
    pub mu: f64,
}

impl SelfWeightColumn {
    /// Modulus of confined compression, `M = lambda + 2 mu`, Pa.
    #[must_use]
    pub fn confined_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    /// Load number `S = rho0 g H / M`.
    #[must_use]
    pub fn load_number(&self) -> f64 {
        self.density * self.gravity * self.height / self.confined_modulus()
    }

    /// Vertical stress, Pa, of the material at the initial height `y0` (m): `-rho0 g (H - Y)`.
    #[must_use]
    pub fn vertical_stress(&self, y0: f64) -> f64 {
        -self.density * self.gravity * (self.height - y0)
    }

    /// Lateral Cauchy stress, Pa, that the rollers carry there.
    #[must_use]
    pub fn lateral_stress(&self, y0: f64) -> f64 {
        let f = self.stretch(y0);
        match self.law {
            Law::SmallStrain | Law::RateElastic => {
                self.lambda / self.confined_modulus() * self.vertical_stress(y0)
            }
            Law::Hencky | Law::NeoHookean => self.lambda * log(f) / f,
        }
    }

    /// Vertical stretch F at the initial height `y0` (m).
    ///
    /// Closed form for small strain and the rate law; elsewhere the root of `P(F)`. NaN where there is none: small
    /// strain beyond `S = 1`, and above the top (`Y > H`) for the laws that are solved for compression only.
    #[must_use]
    pub fn stretch(&self, y0: f64) -> f64 {
        let stress = self.vertical_stress(y0);
        let s = stress / self.confined_modulus();
        match self.law {
            Law::SmallStrain if s > -1.0 => 1.0 + s,
            Law::SmallStrain => f64::NAN,
            Law::RateElastic => exp(s),
            Law::Hencky | Law::NeoHookean => self.solve_stretch(stress),
        }
    }

    /// Height, m, at which the material of initial height `y0` (m) comes to rest; `y0 = H` gives the height of the column.
    ///
    /// `y = integral of F dY = 1/(rho0 g) * integral of F dP`, in closed form as `F P - integral of P dF`.
    #[must_use]
    pub fn position(&self, y0: f64) -> f64 {
        if self.load_number() == 0.0 {
            return y0;
        }
        (self.work(self.stretch(y0)) - self.work(self.stretch(0.0))) / (self.density * self.gravity)
    }

    /// Displacement, m, of the material of the initial height `y0` (m).
    #[must_use]
    pub fn displacement(&self, y0: f64) -> [f64; 3] {
        [0.0, self.position(y0) - y0, 0.0]
    }

    /// Cauchy stress, Pa, there: xx, yy, zz and no shear.
    #[must_use]
    pub fn stress(&self, y0: f64) -> [f64; 6] {
        let lateral = self.lateral_stress(y0);
        [lateral, self.vertical_stress(y0), lateral, 0.0, 0.0, 0.0]
    }

    /// Antiderivative of `F dP` over F, Pa.
    fn work(&self, f: f64) -> f64 {
        let m = self.confined_modulus();
        let log = log(f);
        match self.law {
            Law::SmallStrain => 0.5 * m * f * f,
            Law::RateElastic => m * f,
            Law::Hencky => m * (log - 0.5 * log * log),
            Law::NeoHookean => {
                let nominal = self.nominal_stress(f);
                f * nominal - 0.5 * self.lambda * log * log - self.mu * (0.5 * f * f - log)
            }
        }
    }

    /// Nominal stress P(F), Pa, of the two laws that are solved by iteration.
    fn nominal_stress(&self, f: f64) -> f64 {
        match self.law {
            Law::NeoHookean => self.lambda * log(f) / f + self.mu * (f - 1.0 / f),
            _ => self.confined_modulus() * log(f) / f,
        }
    }

    /// Bisection in `x = ln F`, compression only: P rises with F for every `0 < F <= 1`.
    fn solve_stretch(&self, stress: f64) -> f64 {
        if stress > 0.0 {
            return f64::NAN;
        }
        // Both laws are stiffer than `P = M x` for x < 0, so the root lies between its root and zero.
        let s = -stress / self.confined_modulus();
        let (mut low, mut high) = (-s, 0.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            if self.nominal_stress(exp(middle)) < stress {
                low = middle;
            } else {
                high = middle;
            }
        }
        exp(0.5 * (low + high))
    }
}
