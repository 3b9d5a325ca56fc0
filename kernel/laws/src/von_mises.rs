//! Elasticity that yields by the criterion of von Mises, with isotropic hardening.

use super::marks::{CURVE, Marks};
use super::plastic::{RELAXATION, ReturnedStress, YieldSurface};
use super::tensor::components;
use super::tensor::{deviator, second_invariant};
use super::{
    Band, Choice, Constant, ConstantDefault, ConstantRange, Curve, InvalidConstant, LinearElastic,
    Readable, Rows, band,
};
use crate::functions;
use proctor_kernel::lanes::Lanes;

/// Von Mises: sqrt(3 J_2) <= Y(k) with the yield stress Y(k) = Y_0 + H k + Q (1 - exp(-b k)) of the plastic strain k
/// (Voce 1955 where Q > 0), or along straight lines between marks. It is zero where softening would make it less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VonMises {
    elastic: LinearElastic,
    yield_stress: f64,
    hardening: f64,
    saturation: f64,
    rate: f64,
    relaxation: f64,
    band: Band,
    marks: Marks,
}

impl VonMises {
    /// Law of Young's modulus \[Pa\], Poisson's ratio, yield stress \[Pa\] and hardening modulus \[Pa\].
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
            marks: Marks::NONE,
        }
    }

    /// The same with a yield stress that goes from its first value along straight lines through rows of plastic strain and
    /// yield stress \[Pa\], strains rising, and on from the last with the hardening modulus. A scene is refused more than 16.
    #[must_use]
    pub fn along(self, rows: &[[f64; 2]]) -> Self {
        Self {
            marks: Marks::new(rows),
            ..self
        }
        .placed()
    }

    /// The same with the pieces between its marks.
    fn placed(self) -> Self {
        let ends = [self.yield_stress, self.hardening];
        let factor = self.band.factor();
        Self {
            marks: self.marks.placed(ends, self.stiffness(), factor),
            ..self
        }
    }

    /// The same with softening that knows the width of its band.
    #[must_use]
    pub fn in_band(self, band: Band) -> Self {
        Self { band, ..self }.placed()
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

    /// True if the yield stress is constant.
    #[must_use]
    pub fn is_perfect(&self) -> bool {
        self.hardening == 0.0 && self.saturation == 0.0 && self.marks.is_empty()
    }

    /// Fall of q per plastic strain where the strain is held, 3 G \[Pa\].
    fn stiffness(&self) -> f64 {
        3.0 * self.elastic.elasticity().shear
    }

    /// True if the yield stress falls anywhere.
    fn softens(&self) -> bool {
        self.hardening < 0.0 || self.marks.steepest(self.yield_stress) > 0.0
    }

    /// Growth of the yield stress with the plastic strain \[Pa\]; softening scales with its band.
    fn slope(&self) -> f64 {
        if self.hardening < 0.0 {
            self.hardening * self.band.factor()
        } else {
            self.hardening
        }
    }

    /// Yield stress \[Pa\] at a plastic strain, and its slope, of a law without marks.
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

crate::yielding_law!(VonMises);

impl YieldSurface for VonMises {
    const CONSTANTS: &'static [Constant] = &[
        super::YOUNG,
        super::POISSON,
        Constant {
            key: "yield_stress",
            meaning: "Stress at which it yields in uniaxial tension",
            unit: "Pa",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "hardening",
            meaning: "Growth of the yield stress with the plastic strain; negative where it softens",
            unit: "Pa",
            accepted: ConstantRange::Finite,
            given: ConstantDefault::Or(0.0),
        },
        Constant {
            key: "hardening.saturation",
            meaning: "Growth of the yield stress that saturates with the plastic strain (Voce)",
            unit: "Pa",
            accepted: ConstantRange::NotNegative,
            given: ConstantDefault::Or(0.0),
        },
        Constant {
            key: "hardening.rate",
            meaning: "How fast it saturates: it lacks exp(-rate times plastic strain) of its end",
            unit: "",
            accepted: ConstantRange::NotNegative,
            given: ConstantDefault::Or(0.0),
        },
        RELAXATION,
        band::WIDTH,
    ];
    const CURVES: &'static [Curve] = &[CURVE];

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

    fn curves(&self) -> Vec<Rows> {
        vec![self.marks.rows().to_vec()]
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        let most = self.stiffness();
        let rows = self.marks.problem();
        let falls = (rows.is_none()).then(|| self.marks.steepest(self.yield_stress));
        let steep = |key, fall: f64| {
            let unfit = self.band.too_steep(key, fall, most)?;
            let slope = |slope: f64| match key {
                "hardening" => slope.to_string(),
                _ => format!("rows with a slope of {slope}"),
            };
            Some(if unfit.key == key {
                InvalidConstant {
                    found: format!("{}, softening that no point can bear", slope(-fall)),
                    accepted: format!("a number greater than -3 G = {} [Pa]", -most),
                    ..unfit
                }
            } else {
                unfit
            })
        };
        let both = (!self.marks.is_empty() && self.saturation != 0.0).then(|| InvalidConstant {
            key: CURVE.key,
            found: "rows beside a growth that saturates".to_owned(),
            accepted: "no rows, or a `hardening.saturation` of 0".to_owned(),
        });
        let found = [
            self.band.problems(),
            steep("hardening", -self.hardening),
            rows,
            falls.and_then(|fall| steep(CURVE.key, fall)),
            both,
        ];
        found.into_iter().flatten().collect()
    }

    fn warnings(&self) -> Vec<String> {
        let softens = self.softens();
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
    ) -> Option<ReturnedStress<L>> {
        let (mean, s) = deviator::<L, D>(trial);
        let q = (L::splat(3.0) * second_invariant::<L, D>(&s)).sqrt();
        let zero = L::splat(0.0);
        let (mut limit, slope) = if self.marks.is_empty() {
            self.yield_stress_at(variables[0])
        } else {
            (self.marks.stress_at(variables[0]), zero)
        };
        // What softens has no less than no strength.
        let ends = self.hardening < 0.0;
        if ends {
            limit = limit.max(zero);
        }
        let yields = limit.lt(q);
        if L::bits(yields) == 0 {
            return None;
        }
        let stiffness = L::splat(self.stiffness());
        let mut strain = if self.marks.is_empty() {
            (q - limit) / (stiffness + slope)
        } else {
            self.marks.strain_of_return(q, variables[0], stiffness)
        };
        if self.saturation != 0.0 {
            for _ in 0..ITERATIONS {
                let (limit, slope) = self.yield_stress_at(variables[0] + strain);
                let beyond = q - stiffness * strain - limit;
                strain = strain + beyond / (stiffness + slope);
            }
        }
        let mut ratio = (q - stiffness * strain) / q;
        if ends {
            ratio = ratio.max(zero);
        }
        let mut out = *trial;
        for slot in 0..components(D) {
            out[slot] = if slot < 3 {
                s[slot].mul_add(ratio, mean)
            } else {
                s[slot] * ratio
            };
        }
        Some(ReturnedStress {
            stress: out,
            yields,
            opened: zero,
        })
    }
}

impl Readable for VonMises {
    const NAME: &'static str = "von_mises";
    const MEANING: &'static str = "metal that yields and hardens";
    const CHOICES: &'static [Choice] = &[band::REGULARISATION];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        Self::new(values[0], values[1], values[2], values[3])
            .saturating(values[4], values[5])
            .relaxing(values[6])
            .in_band(Band::read(choices[0], values[7]))
    }

    fn with_curves(self, curves: &[Rows]) -> Self {
        curves.first().map_or(self, |rows| self.along(rows))
    }
}
