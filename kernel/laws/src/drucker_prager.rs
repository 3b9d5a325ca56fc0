//! Elasticity that yields by the criterion of Drucker and Prager, with tension cut-off.

use super::gap::{GAP, TensionApex};
use super::plastic::{ALGORITHMIC, RELAXATION, ReturnedStress, STRAIN, WORK, YieldSurface};
use super::strength::{self, COHESION, DILATION, FRICTION, TENSILE};
use super::tensor::components;
use super::tensor::{deviator, second_invariant};
use super::{Choice, Constant, InvalidConstant, LinearElastic, Readable};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Matching of Drucker and Prager's cone to Mohr and Coulomb's pyramid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConeMatch {
    /// Matched in plane strain at flow.
    PlaneStrain,
    /// Matched at the edges of triaxial compression.
    Outer,
    /// Matched at the edges of triaxial extension.
    Inner,
}

/// Drucker-Prager: sqrt(J_2) + eta p <= xi c with p = tr sigma / 3 and flow along sqrt(J_2) + eta_psi p; p <= t.
///
/// eta, xi and eta_psi follow from friction, cohesion and dilation of Mohr and Coulomb by [`ConeMatch`]. In plane strain flow has
/// no part across the plane, so that eta_psi = 3 sin psi / sqrt(9 + 3 sin² psi), and with
/// A = sqrt(1 - eta_psi²/3) + eta_psi sin phi / 3 both criteria agree where eta = sin phi / A and xi = cos phi / A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DruckerPrager {
    elastic: LinearElastic,
    friction: f64,
    cohesion: f64,
    dilation: f64,
    tensile: f64,
    relaxation: f64,
    matched: ConeMatch,
    /// eta, xi c and eta_psi.
    cone: [f64; 3],
    /// Largest mean stress \[Pa\].
    most: f64,
}

impl DruckerPrager {
    /// Law of Young's modulus \[Pa\], Poisson's ratio, friction \[°\], cohesion \[Pa\] and dilation \[°\] of Mohr and Coulomb.
    #[must_use]
    pub fn new(
        young: f64,
        poisson: f64,
        [friction, cohesion, dilation]: [f64; 3],
        matched: ConeMatch,
    ) -> Self {
        let (sine, cosine) = strength::sine_and_cosine(friction);
        let (of_flow, _) = strength::sine_and_cosine(dilation);
        let root = 3.0_f64.sqrt();
        let (eta, xi, eta_psi) = match matched {
            ConeMatch::PlaneStrain => {
                let eta_psi = 3.0 * of_flow / (9.0 + 3.0 * of_flow * of_flow).sqrt();
                let a = (1.0 - eta_psi * eta_psi / 3.0).sqrt() + eta_psi * sine / 3.0;
                (sine / a, cosine / a, eta_psi)
            }
            ConeMatch::Outer => (
                6.0 * sine / (root * (3.0 - sine)),
                6.0 * cosine / (root * (3.0 - sine)),
                6.0 * of_flow / (root * (3.0 - of_flow)),
            ),
            ConeMatch::Inner => (
                6.0 * sine / (root * (3.0 + sine)),
                6.0 * cosine / (root * (3.0 + sine)),
                6.0 * of_flow / (root * (3.0 + of_flow)),
            ),
        };
        Self {
            elastic: LinearElastic::new(young, poisson),
            friction,
            cohesion,
            dilation,
            tensile: 0.0,
            relaxation: 0.0,
            matched,
            cone: [eta, xi * cohesion, eta_psi],
            most: strength::apex(sine, cosine, cohesion),
        }
    }

    /// The same with another largest mean stress \[Pa\]; 0 for that of the apex, c cot phi.
    #[must_use]
    pub fn with_tensile(self, tensile: f64) -> Self {
        let (sine, cosine) = strength::sine_and_cosine(self.friction);
        Self {
            tensile,
            most: strength::largest_tension(tensile, sine, cosine, self.cohesion),
            ..self
        }
    }

    /// The same with a relaxation time \[s\].
    #[must_use]
    pub const fn relaxing(self, relaxation: f64) -> Self {
        Self { relaxation, ..self }
    }

    /// Radius of the disc that ends the cone, sqrt(J_2) \[Pa\].
    fn edge(&self) -> f64 {
        let [eta, limit, _] = self.cone;
        (limit - eta * self.most).max(0.0)
    }

    /// eta, xi c \[Pa\] and eta_psi of the cone.
    #[must_use]
    pub const fn cone(&self) -> [f64; 3] {
        self.cone
    }
}

crate::yielding_law!(DruckerPrager);

impl YieldSurface for DruckerPrager {
    const CONSTANTS: &'static [Constant] = &[
        super::YOUNG,
        super::POISSON,
        FRICTION,
        COHESION,
        DILATION,
        TENSILE,
        RELAXATION,
    ];
    const VARIABLES: &'static [Variable] = &[STRAIN, WORK, ALGORITHMIC, GAP];
    const GAP: Option<usize> = Some(3);

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        let elasticity = self.elastic.elasticity();
        vec![
            elasticity.young,
            elasticity.poisson,
            self.friction,
            self.cohesion,
            self.dilation,
            self.tensile,
            self.relaxation,
        ]
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        strength::problems(self.friction, self.dilation, self.cohesion, self.tensile)
    }

    fn warnings(&self) -> Vec<String> {
        strength::warnings(self.friction, self.dilation)
    }

    fn elastic(&self) -> &LinearElastic {
        &self.elastic
    }

    fn relaxation(&self) -> f64 {
        self.relaxation
    }

    /// The return to the cone; beyond the largest mean stress that to the disc which ends it, along the axis or to its edge.
    #[inline(always)]
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        _: &[L],
    ) -> Option<ReturnedStress<L>> {
        let zero = L::splat(0.0);
        let [eta, limit, eta_psi] = self.cone;
        let (shear, bulk) = {
            let elasticity = self.elastic.elasticity();
            (elasticity.shear, elasticity.bulk())
        };
        let (mean, s) = deviator::<L, D>(trial);
        let radius = second_invariant::<L, D>(&s).sqrt();
        let beyond = L::splat(eta).mul_add(mean, radius) - L::splat(limit);
        let most = L::splat(self.most);
        let yields = zero.lt(beyond.max(mean - most));
        if L::bits(yields) == 0 {
            return None;
        }
        let multiplier = beyond.max(zero) * L::splat(1.0 / (shear + bulk * eta * eta_psi));
        let on_cone = (
            radius - multiplier * L::splat(shear),
            mean - multiplier * L::splat(bulk * eta_psi),
        );
        // The edge of the disc, which is its centre where the cone ends there.
        let edge = L::splat(self.edge());
        let too_far = most.lt(on_cone.1);
        let is_turned = on_cone.0.lt(zero);
        let (new_radius, new_mean) = (
            L::select(
                too_far,
                radius.min(edge),
                L::select(is_turned, zero, on_cone.0),
            ),
            L::select(
                too_far,
                most,
                L::select(is_turned, most.min(on_cone.1), on_cone.1),
            ),
        );
        let ratio = L::select(zero.lt(radius), new_radius / radius, zero);
        let mut out = *trial;
        for slot in 0..components(D) {
            out[slot] = if slot < 3 {
                s[slot].mul_add(ratio, new_mean)
            } else {
                s[slot] * ratio
            };
        }
        // What of the volume is no flow from the cone.
        let swollen = (mean - new_mean) * L::splat(1.0 / bulk);
        let sheared = (radius - new_radius) * L::splat(eta_psi / shear);
        Some(ReturnedStress {
            stress: out,
            yields,
            opened: L::select(too_far, (swollen - sheared).max(zero), zero),
        })
    }

    #[inline(always)]
    fn tip<L: Lanes>(&self, _: &[L]) -> TensionApex<L> {
        TensionApex {
            tension: L::splat(self.most),
            radius: L::splat(self.edge()),
        }
    }
}

impl Readable for DruckerPrager {
    const NAME: &'static str = "drucker_prager";
    const MEANING: &'static str = "soil with friction on a cone";
    const CHOICES: &'static [Choice] = &[Choice {
        key: "match",
        words: &["plane_strain", "outer", "inner"],
        meaning: "Where the cone touches the pyramid of Mohr and Coulomb: in plane strain, at triaxial compression, at triaxial extension.",
        elsewhere: "a match with Mohr and Coulomb for a {law} material, which has no cone",
    }];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        let matches = [ConeMatch::PlaneStrain, ConeMatch::Outer, ConeMatch::Inner];
        Self::new(
            values[0],
            values[1],
            [values[2], values[3], values[4]],
            matches[choices[0]],
        )
        .with_tensile(values[5])
        .relaxing(values[6])
    }
}
