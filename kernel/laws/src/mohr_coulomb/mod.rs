//! Elasticity that yields by the criterion of Mohr and Coulomb, with tension cut-off and softening.

mod region;
mod softening;

pub use softening::{Residual, Softening};

use super::gap::{GAP, TensionApex};
use super::plastic::{
    ALGORITHMIC, RELAXATION, ReturnedStress, STRAIN, VOLUME_STRAIN, WORK, YieldSurface,
};
use super::principal::spectrum;
use super::strength::{self, COHESION, DILATION, FRICTION, TENSILE};
use super::tensor::components;
use super::tensor::{deviator, second_invariant};
use super::{
    Band, Choice, Constant, ConstantDefault, ConstantRange, InvalidConstant, LinearElastic,
    Readable, band,
};
use crate::functions;
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;
use region::Strength;

/// Mohr-Coulomb: (1 + sin phi) s_1 - (1 - sin phi) s_3 <= 2 c cos phi and s_1 <= t for principal stresses s_1 >= s_2 >= s_3,
/// with flow along (1 + sin psi) s_1 - (1 - sin psi) s_3, and along s_1 at the tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MohrCoulomb {
    elastic: LinearElastic,
    /// Angle of friction \[°\], cohesion \[Pa\], angle of dilation \[°\] and tensile strength \[Pa\] at their peak.
    peak: [f64; 4],
    /// Plastic volume strain at which dilation ends; 0 for none.
    end_of_dilation: f64,
    relaxation: f64,
    softening: Softening,
    residual: Residual,
    band: Band,
    /// sin phi, 2 c cos phi \[Pa\], sin psi and t \[Pa\] at their peak.
    at_peak: [f64; 4],
}

impl MohrCoulomb {
    /// Law of Young's modulus \[Pa\], Poisson's ratio, friction \[°\], cohesion \[Pa\] and dilation \[°\].
    #[must_use]
    pub fn new(young: f64, poisson: f64, [friction, cohesion, dilation]: [f64; 3]) -> Self {
        Self {
            elastic: LinearElastic::new(young, poisson),
            peak: [friction, cohesion, dilation, 0.0],
            end_of_dilation: 0.0,
            relaxation: 0.0,
            softening: Softening::None,
            residual: Residual::default(),
            band: Band::NONE,
            at_peak: [0.0; 4],
        }
        .with_tensile(0.0)
    }

    /// The same with a tensile strength \[Pa\]; 0 stands for c cot phi.
    #[must_use]
    pub fn with_tensile(self, tensile: f64) -> Self {
        let [friction, cohesion, dilation, _] = self.peak;
        let (sine, cosine) = strength::sine_and_cosine(friction);
        let (flow, _) = strength::sine_and_cosine(dilation);
        let tension = strength::largest_tension(tensile, sine, cosine, cohesion);
        Self {
            peak: [friction, cohesion, dilation, tensile],
            at_peak: [sine, 2.0 * cohesion * cosine, flow, tension],
            ..self
        }
    }

    /// The same with strength that softens.
    #[must_use]
    pub const fn softening(self, softening: Softening, residual: Residual) -> Self {
        Self {
            softening,
            residual,
            ..self
        }
    }

    /// The same with softening that knows the width of its band.
    #[must_use]
    pub const fn in_band(self, band: Band) -> Self {
        Self { band, ..self }
    }

    /// The same with dilation that ends at a plastic volume strain.
    #[must_use]
    pub const fn dilating_until(self, end_of_dilation: f64) -> Self {
        Self {
            end_of_dilation,
            ..self
        }
    }

    /// The same with a relaxation time \[s\].
    #[must_use]
    pub const fn relaxing(self, relaxation: f64) -> Self {
        Self { relaxation, ..self }
    }

    /// Angle of friction \[°\], cohesion \[Pa\], angle of dilation \[°\] and tensile strength \[Pa\] at their peak.
    #[must_use]
    pub const fn peak(&self) -> [f64; 4] {
        self.peak
    }

    /// Softening of the strength.
    #[must_use]
    pub const fn softens(&self) -> Softening {
        self.softening
    }

    /// Cohesion and tension that fall faster than the elasticity of a point lets its stress fall. On the plane of shear the
    /// multiplier is F/(A + 2 c' cos phi dk), A = 4 G (1 + s d) + 4 lambda s d with the sines of friction and dilation and
    /// dk = 2/sqrt(3) sqrt(1 + d²/3) the plastic strain per multiplier; at the tension it is (s_1 - t)/(lambda + 2 G + 2/3 t').
    fn too_steep(&self) -> Vec<InvalidConstant> {
        let slope = |i: usize, left: Option<f64>| {
            let way = self.peak[i] - left.unwrap_or(self.peak[i]);
            self.softening.steepest() * way
        };
        let elasticity = self.elastic.elasticity();
        let least = |i: usize, left: Option<f64>| {
            strength::sine_and_cosine(left.unwrap_or(self.peak[i]).min(self.peak[i]))
        };
        let ((s, cosine), (d, _)) = (
            least(0, self.residual.friction),
            least(2, self.residual.dilation),
        );
        let stiffness = 4.0 * elasticity.shear * (1.0 + s * d) + 4.0 * elasticity.lambda * s * d;
        let (flow, _) = strength::sine_and_cosine(self.peak[2]);
        let strain = 2.0 / 3.0_f64.sqrt() * (1.0 + flow * flow / 3.0).sqrt();
        let of_cohesion = stiffness / (2.0 * cosine * strain);
        let of_tension = 1.5 * (elasticity.lambda + 2.0 * elasticity.shear);
        let cohesion = slope(1, self.residual.cohesion);
        let tensile = slope(3, self.residual.tensile);
        [
            (softening::CONSTANTS[4].key, cohesion, of_cohesion),
            (softening::CONSTANTS[6].key, tensile, of_tension),
        ]
        .into_iter()
        .filter_map(|(key, slope, most)| self.band.too_steep(key, slope, most))
        .collect()
    }

    /// Strength at a plastic strain, with dilation that has ended where the plastic volume strain says so.
    #[inline(always)]
    fn strength<L: Lanes>(&self, strain: L, dilated: L) -> Strength<L> {
        let [sine, cohesive, flow, tension] = self.at_peak;
        let mut strength = Strength {
            sine: L::splat(sine),
            cohesive: L::splat(cohesive),
            flow: L::splat(flow),
            tension: L::splat(tension),
        };
        if self.softening != Softening::None {
            let left = self.softening.left(strain * L::splat(self.band.factor()));
            self.soften(&mut strength, left);
        }
        if self.end_of_dilation > 0.0 {
            let dilates = dilated.lt(L::splat(self.end_of_dilation));
            strength.flow = L::select(dilates, strength.flow, L::splat(0.0));
        }
        strength
    }

    /// Strength with a share of the way from residual to peak that is left.
    #[inline(always)]
    fn soften<L: Lanes>(&self, strength: &mut Strength<L>, left: L) {
        let [friction, cohesion, dilation, tensile] = self.peak;
        let two = L::splat(2.0);
        let angle = between(
            friction.to_radians(),
            self.residual.friction.map(f64::to_radians),
            left,
        );
        let (sine, cosine) = functions::sine_and_cosine(angle);
        let cohesion = between(cohesion, self.residual.cohesion, left);
        strength.sine = sine;
        strength.cohesive = two * cohesion * cosine;
        if let Some(residual) = self.residual.dilation {
            let angle = between(dilation.to_radians(), Some(residual.to_radians()), left);
            let (flow, _) = functions::sine_and_cosine(angle.abs());
            let negative = angle.lt(L::splat(0.0));
            strength.flow = L::select(negative, -flow, flow);
        }
        // What softens may not let the flow be steeper than the surface.
        strength.flow = strength.flow.min(sine);
        let none = strength::largest_tension(0.0, 0.0, 1.0, 0.0);
        let tiny = L::splat(1e-300);
        let apex = L::splat(none).min(cohesion * cosine / sine.max(tiny));
        strength.tension = if tensile > 0.0 {
            between(tensile, self.residual.tensile, left).min(apex)
        } else {
            apex
        };
    }
}

/// A value that softens from its peak to its residual.
#[inline(always)]
fn between<L: Lanes>(peak: f64, residual: Option<f64>, left: L) -> L {
    match residual {
        None => L::splat(peak),
        Some(residual) => L::splat(peak - residual).mul_add(left, L::splat(residual)),
    }
}

crate::yielding_law!(MohrCoulomb);

impl YieldSurface for MohrCoulomb {
    const CONSTANTS: &'static [Constant] = &[
        super::YOUNG,
        super::POISSON,
        FRICTION,
        COHESION,
        DILATION,
        TENSILE,
        Constant {
            key: "dilation.until",
            meaning: "Plastic volume strain at which dilation ends; 0 for no end",
            unit: "",
            accepted: ConstantRange::NotNegative,
            given: ConstantDefault::Or(0.0),
        },
        RELAXATION,
        softening::CONSTANTS[0],
        softening::CONSTANTS[1],
        softening::CONSTANTS[2],
        softening::CONSTANTS[3],
        softening::CONSTANTS[4],
        softening::CONSTANTS[5],
        softening::CONSTANTS[6],
        band::WIDTH,
    ];
    const VARIABLES: &'static [Variable] = &[STRAIN, WORK, ALGORITHMIC, VOLUME_STRAIN, GAP];
    const VOLUME: Option<usize> = Some(3);
    const GAP: Option<usize> = Some(4);

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        let elasticity = self.elastic.elasticity();
        let [friction, cohesion, dilation, tensile] = self.peak;
        let mut values = vec![
            elasticity.young,
            elasticity.poisson,
            friction,
            cohesion,
            dilation,
            tensile,
            self.end_of_dilation,
            self.relaxation,
        ];
        values.extend(softening::values(self.softening, &self.residual, self.peak));
        values.push(self.band.width);
        values
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        let [friction, cohesion, dilation, tensile] = self.peak;
        let mut found = strength::problems(friction, dilation, cohesion, tensile);
        found.extend(softening::problems(
            self.softening,
            &self.residual,
            self.peak,
        ));
        found.extend(self.band.problems());
        found.extend(self.too_steep());
        found
    }

    fn in_cells(&self, cell: f64) -> Option<Self> {
        Some(self.in_band(self.band.in_cells(cell)?))
    }

    fn warnings(&self) -> Vec<String> {
        let mut all = strength::warnings(self.peak[0], self.peak[2]);
        if self.softening != Softening::None {
            all.extend(self.band.warning());
        }
        all
    }

    fn elastic(&self) -> &LinearElastic {
        &self.elastic
    }

    fn relaxation(&self) -> f64 {
        self.relaxation
    }

    #[inline(always)]
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        variables: &[L],
    ) -> Option<ReturnedStress<L>> {
        let dilated = variables[3] - variables[4];
        let mut strength = self.strength(variables[0], dilated);
        if L::bits(may_yield::<L, D>(&strength, trial)) == 0 {
            return None;
        }
        let elasticity = self.elastic.elasticity();
        let spectrum = spectrum::<L, D>(trial);
        let yields = L::splat(0.0).lt(strength.excess(&spectrum.values));
        let mut after = region::returned(&elasticity, &strength, &spectrum.values);
        if self.softening != Softening::None {
            // Once more with the strength after the step: a fixed number of passes, so that lanes do the same.
            let way = deviatoric(&spectrum.values, &after)
                * L::splat((2.0_f64 / 3.0).sqrt() / (2.0 * elasticity.shear));
            strength = self.strength(variables[0] + way, dilated);
            after = region::returned(&elasticity, &strength, &spectrum.values);
        }
        // As a correction: what the directions lack of round-off then counts for the correction alone.
        let opened = region::opened(&elasticity, &strength, &spectrum.values, &after);
        let change = [
            after[0] - spectrum.values[0],
            after[1] - spectrum.values[1],
            after[2] - spectrum.values[2],
        ];
        let change = spectrum.with::<D>(&change);
        let mut out = *trial;
        for slot in 0..components(D) {
            out[slot] = trial[slot] + change[slot];
        }
        Some(ReturnedStress {
            stress: out,
            yields,
            opened,
        })
    }

    /// All three principal stresses are at the tension there.
    #[inline(always)]
    fn tip<L: Lanes>(&self, variables: &[L]) -> TensionApex<L> {
        TensionApex {
            tension: self.strength(variables[0], variables[3]).tension,
            radius: L::splat(0.0),
        }
    }
}

/// The return of a law without friction whose shear strength each particle has of its own \[Pa\]; it bears any tension.
#[inline(always)]
pub(super) fn by_shear_strength<L: Lanes, const D: usize>(
    elastic: &LinearElastic,
    shear_strength: L,
    trial: &[L; 6],
) -> Option<ReturnedStress<L>> {
    let zero = L::splat(0.0);
    let strength = Strength {
        sine: zero,
        cohesive: shear_strength + shear_strength,
        flow: zero,
        tension: L::splat(strength::apex(0.0, 1.0, 0.0)),
    };
    if L::bits(may_yield::<L, D>(&strength, trial)) == 0 {
        return None;
    }
    let spectrum = spectrum::<L, D>(trial);
    let yields = zero.lt(strength.excess(&spectrum.values));
    let after = region::returned(&elastic.elasticity(), &strength, &spectrum.values);
    let change = [
        after[0] - spectrum.values[0],
        after[1] - spectrum.values[1],
        after[2] - spectrum.values[2],
    ];
    let change = spectrum.with::<D>(&change);
    let mut out = *trial;
    for slot in 0..components(D) {
        out[slot] = trial[slot] + change[slot];
    }
    Some(ReturnedStress {
        stress: out,
        yields,
        opened: zero,
    })
}

/// Bounds of a stress beyond the surface, by its invariants alone: sqrt(J_2) sqrt(1 + sin² phi/3) + p sin phi and p + 2
/// sqrt(J_2/3) bound the shear and the tension from above.
#[inline(always)]
fn may_yield<L: Lanes, const D: usize>(strength: &Strength<L>, trial: &[L; 6]) -> L::Mask {
    let (mean, s) = deviator::<L, D>(trial);
    let radius = second_invariant::<L, D>(&s).sqrt();
    let sine = strength.sine;
    let steep = (sine * sine)
        .mul_add(L::splat(1.0 / 3.0), L::splat(1.0))
        .sqrt();
    let shear = radius * steep + mean * sine - L::splat(0.5) * strength.cohesive;
    let tension = radius.mul_add(L::splat(2.0 / 3.0_f64.sqrt()), mean) - strength.tension;
    // A margin for round-off: who is asked for nothing stays as it is.
    let margin = L::splat(1e-12) * (radius + mean.abs());
    L::splat(0.0).lt(shear.max(tension) + margin)
}

/// Norm of the deviator of the way between two sets of principal stresses.
#[inline(always)]
fn deviatoric<L: Lanes>(from: &[L; 3], to: &[L; 3]) -> L {
    let way = [from[0] - to[0], from[1] - to[1], from[2] - to[2]];
    let mean = (way[0] + way[1] + way[2]) * L::splat(1.0 / 3.0);
    let mut square = L::splat(0.0);
    for entry in way {
        square = (entry - mean).mul_add(entry - mean, square);
    }
    square.sqrt()
}

impl Readable for MohrCoulomb {
    const NAME: &'static str = "mohr_coulomb";
    const MEANING: &'static str =
        "soil or rock with friction, dilation, tension cut-off and softening";
    const CHOICES: &'static [Choice] = &[
        softening::CHOICES[0],
        softening::CHOICES[1],
        softening::CHOICES[2],
        softening::CHOICES[3],
        softening::CHOICES[4],
        band::REGULARISATION,
    ];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        let (softening, residual) = softening::read(&values[8..], choices);
        Self::new(values[0], values[1], [values[2], values[3], values[4]])
            .with_tensile(values[5])
            .dilating_until(values[6])
            .relaxing(values[7])
            .softening(softening, residual)
            .in_band(Band::read(choices[5], values[15]))
    }
}
