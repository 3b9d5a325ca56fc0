//! Elasticity that yields by the criterion of Tresca: Mohr and Coulomb without friction.

use super::gap::TensionApex;
use super::plastic::{RELAXATION, ReturnedStress, YieldSurface};
use super::strength::{COHESION, TENSILE};
use super::{Constant, InvalidConstant, LinearElastic, MohrCoulomb, Readable};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Tresca: s_1 - s_3 <= 2 c and s_1 <= t, for clay that is not drained; c is its shear strength s_u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tresca(MohrCoulomb);

impl Tresca {
    /// Law of Young's modulus \[Pa\], Poisson's ratio and shear strength \[Pa\].
    #[must_use]
    pub fn new(young: f64, poisson: f64, cohesion: f64) -> Self {
        Self(MohrCoulomb::new(young, poisson, [0.0, cohesion, 0.0]))
    }

    /// The same with a tensile strength \[Pa\]; 0 for none.
    #[must_use]
    pub fn with_tensile(self, tensile: f64) -> Self {
        Self(self.0.with_tensile(tensile))
    }

    /// Shear strength \[Pa\].
    #[must_use]
    pub const fn cohesion(&self) -> f64 {
        self.0.peak()[1]
    }

    /// The same with a relaxation time \[s\].
    #[must_use]
    pub const fn relaxing(self, relaxation: f64) -> Self {
        Self(self.0.relaxing(relaxation))
    }
}

crate::yielding_law!(Tresca);

impl YieldSurface for Tresca {
    const CONSTANTS: &'static [Constant] =
        &[super::YOUNG, super::POISSON, COHESION, TENSILE, RELAXATION];
    const VARIABLES: &'static [Variable] = <MohrCoulomb as YieldSurface>::VARIABLES;
    const VOLUME: Option<usize> = <MohrCoulomb as YieldSurface>::VOLUME;
    const GAP: Option<usize> = <MohrCoulomb as YieldSurface>::GAP;

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        let of = YieldSurface::values(&self.0);
        vec![of[0], of[1], of[3], of[5], of[7]]
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        YieldSurface::problems(&self.0)
    }

    fn warnings(&self) -> Vec<String> {
        YieldSurface::warnings(&self.0)
    }

    fn elastic(&self) -> &LinearElastic {
        self.0.elastic()
    }

    fn relaxation(&self) -> f64 {
        self.0.relaxation()
    }

    #[inline(always)]
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        variables: &[L],
    ) -> Option<ReturnedStress<L>> {
        self.0.returned::<L, D>(trial, variables)
    }

    #[inline(always)]
    fn tip<L: Lanes>(&self, variables: &[L]) -> TensionApex<L> {
        self.0.tip(variables)
    }
}

impl Readable for Tresca {
    const NAME: &'static str = "tresca";
    const MEANING: &'static str = "clay that is not drained";

    fn read(values: &[f64], _: &[usize]) -> Self {
        Self::new(values[0], values[1], values[2])
            .with_tensile(values[3])
            .relaxing(values[4])
    }
}
