//! Elasticity that yields by the criterion of von Mises, with isotropic hardening.

use super::plastic::{RELAXATION, Yielding, deviator, second_invariant};
use super::principal::components;
use super::{Accepted, Band, Choice, Constant, Given, LinearElastic, Readable, Unfit, band};
use crate::lanes::{Lanes, functions};

/// Von Mises: sqrt(3 J_2) <= Y(k) with the yield stress Y(k) = Y_0 + H k + Q (1 - exp(-b k)) of the plastic strain k
/// (Voce 1955 where Q > 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VonMises {
    elastic: LinearElastic,
    yield_stress: f64,
    hardening: f64,
    saturation: f64,
    rate: f64,
    relaxation: f64,
    band: Band,
}

impl VonMises {
    /// Of Young's modulus \[Pa\], Poisson's ratio, yield stress \[Pa\] and hardening modulus \[Pa\].
    #[must_use]
    pub const fn new(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Self {
        Self {
            elastic: LinearElastic::new(young, poisson),
            yield_stress,
            hardening,
            saturation: 0.0,
            rate: 0.0,
            relaxation: 0.0,
            band: Band::NONE,
        }
    }

    /// The same with softening that knows the width of its band.
    #[must_use]
    pub const fn in_band(self, band: Band) -> Self {
        Self { band, ..self }
    }

    /// The same with a yield stress that also rises by `saturation` \[Pa\], as 1 - exp(-`rate` k).
    #[must_use]
    pub const fn saturating(self, saturation: f64, rate: f64) -> Self {
        Self {
            saturation,
            rate,
            ..self
        }
    }

    /// The same with a relaxation time \[s\].
    #[must_use]
    pub const fn relaxing(self, relaxation: f64) -> Self {
        Self { relaxation, ..self }
    }

    /// Yield stress before any plastic strain \[Pa\].
    #[must_use]
    pub const fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    /// Whether the yield stress stays what it is.
    #[must_use]
    pub fn is_perfect(&self) -> bool {
        self.hardening == 0.0 && self.saturation == 0.0
    }

    /// Growth of the yield stress with the plastic strain \[Pa\]; softening scales with its band.
    fn slope(&self) -> f64 {
        if self.hardening < 0.0 {
            self.hardening * self.band.factor()
        } else {
            self.hardening
        }
    }

    /// Yield stress \[Pa\] at a plastic strain, and its slope.
    #[inline(always)]
    fn yield_stress_at<L: Lanes>(&self, strain: L) -> (L, L) {
        let hardening = L::splat(self.slope());
        let linear = hardening.mul_add(strain, L::splat(self.yield_stress));
        if self.saturation == 0.0 {
            return (linear, hardening);
        }
        let saturation = L::splat(self.saturation);
        let left = saturation * functions::exp(-(L::splat(self.rate) * strain));
        (
            linear + (saturation - left),
            L::splat(self.rate).mul_add(left, hardening),
        )
    }
}

/// Steps of Newton's method for a yield stress that is curved. It approaches the root from one side, and a step of the
/// cycle strains so little that the third changes nothing.
const ITERATIONS: usize = 3;

impl Yielding for VonMises {
    const CONSTANTS: &'static [Constant] = &[
        super::YOUNG,
        super::POISSON,
        Constant {
            key: "yield_stress",
            meaning: "Stress at which it yields in uniaxial tension",
            unit: "Pa",
            accepted: Accepted::Positive,
            given: Given::Needed,
        },
        Constant {
            key: "hardening",
            meaning: "Growth of the yield stress with the plastic strain; negative where it softens",
            unit: "Pa",
            accepted: Accepted::Finite,
            given: Given::Or(0.0),
        },
        Constant {
            key: "hardening.saturation",
            meaning: "Growth of the yield stress that saturates with the plastic strain (Voce)",
            unit: "Pa",
            accepted: Accepted::NotNegative,
            given: Given::Or(0.0),
        },
        Constant {
            key: "hardening.rate",
            meaning: "How fast it saturates: it lacks exp(-rate times plastic strain) of its end",
            unit: "",
            accepted: Accepted::NotNegative,
            given: Given::Or(0.0),
        },
        RELAXATION,
        band::WIDTH,
    ];

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        let elasticity = self.elastic.elasticity();
        vec![
            elasticity.young,
            elasticity.poisson,
            self.yield_stress,
            self.hardening,
            self.saturation,
            self.rate,
            self.relaxation,
            self.band.width,
        ]
    }

    fn problems(&self) -> Vec<Unfit> {
        // q falls by 3 G per plastic strain where the stress is held.
        let most = 3.0 * self.elastic.elasticity().shear;
        let steep = self.band.too_steep("hardening", -self.hardening, most);
        let steep = steep.map(|unfit| match unfit.key {
            "hardening" => Unfit {
                found: format!("{}, softening that no point can bear", self.hardening),
                accepted: format!("a number greater than -3 G = {} [Pa]", -most),
                ..unfit
            },
            _ => unfit,
        });
        self.band.problems().into_iter().chain(steep).collect()
    }

    fn warnings(&self) -> Vec<String> {
        let softens = self.hardening < 0.0;
        softens
            .then(|| self.band.warning())
            .flatten()
            .into_iter()
            .collect()
    }

    fn in_cells(&self, cell: f64) -> Option<Self> {
        Some(self.in_band(self.band.in_cells(cell)?))
    }

    fn elastic(&self) -> &LinearElastic {
        &self.elastic
    }

    fn relaxation(&self) -> f64 {
        self.relaxation
    }

    /// The return along the deviator: q = q_trial - 3 G dk on q = Y(k + dk).
    #[inline(always)]
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        variables: &[L],
    ) -> Option<([L; 6], L::Mask)> {
        let (mean, s) = deviator::<L, D>(trial);
        let q = (L::splat(3.0) * second_invariant::<L, D>(&s)).sqrt();
        let (limit, slope) = self.yield_stress_at(variables[0]);
        let yields = limit.lt(q);
        if L::bits(yields) == 0 {
            return None;
        }
        let stiffness = L::splat(3.0 * self.elastic.elasticity().shear);
        let mut strain = (q - limit) / (stiffness + slope);
        if self.saturation != 0.0 {
            for _ in 0..ITERATIONS {
                let (limit, slope) = self.yield_stress_at(variables[0] + strain);
                let beyond = q - stiffness * strain - limit;
                strain = strain + beyond / (stiffness + slope);
            }
        }
        let ratio = (q - stiffness * strain) / q;
        let mut out = *trial;
        for slot in 0..components(D) {
            out[slot] = if slot < 3 {
                s[slot].mul_add(ratio, mean)
            } else {
                s[slot] * ratio
            };
        }
        Some((out, yields))
    }
}

impl Readable for VonMises {
    const NAME: &'static str = "von_mises";
    const CHOICES: &'static [Choice] = &[band::REGULARISATION];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        Self::new(values[0], values[1], values[2], values[3])
            .saturating(values[4], values[5])
            .relaxing(values[6])
            .in_band(Band::read(choices[0], values[7]))
    }
}
