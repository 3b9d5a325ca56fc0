//! Clay that is not drained, whose strength is a share of the vertical stress at the start.

use super::mohr_coulomb::by_shear_strength;
use super::plastic::{ALGORITHMIC, ReturnedStress, STRAIN, WORK, YieldSurface};
use super::{Constant, ConstantDefault, ConstantRange, InvalidConstant, LinearElastic, Readable};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Shear strength `s_u` \[Pa\]. 0 until a stress has been seen, from which it follows then.
pub const STRENGTH: Variable = Variable::scalar("shear strength", "Pa");

/// Tresca, s_1 - s_3 <= 2 `s_u`, with a strength `s_u` = r `sigma_v'` of the vertical effective stress at the start: that along
/// the last axis, compression positive (Ladd and Foott 1974). It is no less than a least strength, and stays what it was as the
/// stress changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UndrainedClay {
    elastic: LinearElastic,
    ratio: f64,
    least: f64,
}

impl UndrainedClay {
    /// Law of Young's modulus \[Pa\], Poisson's ratio, and the ratio of strength to vertical stress.
    #[must_use]
    pub const fn new(young: f64, poisson: f64, ratio: f64) -> Self {
        Self {
            elastic: LinearElastic::new(young, poisson),
            ratio,
            least: 0.0,
        }
    }

    /// The same with a least strength \[Pa\].
    #[must_use]
    pub const fn no_weaker(self, least: f64) -> Self {
        Self { least, ..self }
    }

    /// Shear strength under a vertical stress at the start, tension positive \[Pa\].
    #[must_use]
    pub fn strength(&self, vertical: f64) -> f64 {
        (-self.ratio * vertical).max(self.least)
    }
}

crate::yielding_law!(UndrainedClay);

impl YieldSurface for UndrainedClay {
    const CONSTANTS: &'static [Constant] = &[
        super::YOUNG,
        super::POISSON,
        Constant {
            key: "su_vertical_stress",
            meaning: "Shear strength of undrained clay over the vertical effective stress at the start, that along the last axis",
            unit: "",
            accepted: ConstantRange::Between(0.0, 10.0),
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "least_strength",
            meaning: "Least shear strength, where the vertical stress at the start gives less",
            unit: "Pa",
            accepted: ConstantRange::NotNegative,
            given: ConstantDefault::Or(0.0),
        },
    ];
    const VARIABLES: &'static [Variable] = &[STRAIN, WORK, ALGORITHMIC, STRENGTH];

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        let mut all = super::Law::values(&self.elastic);
        all.truncate(2);
        all.extend([self.ratio, self.least]);
        all
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        vec![]
    }

    fn warnings(&self) -> Vec<String> {
        vec![]
    }

    fn elastic(&self) -> &LinearElastic {
        &self.elastic
    }

    fn relaxation(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn begin<L: Lanes, const D: usize>(&self, stress: &[L; 6], variables: &mut [L]) {
        // Something, so that what had no stress is not asked again when it has.
        let least = L::splat(self.least.max(f64::MIN_POSITIVE));
        let first = (L::splat(-self.ratio) * stress[D - 1]).max(least);
        variables[3] = L::select(L::splat(0.0).lt(variables[3]), variables[3], first);
    }

    #[inline(always)]
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        variables: &[L],
    ) -> Option<ReturnedStress<L>> {
        by_shear_strength::<L, D>(&self.elastic, variables[3], trial)
    }
}

impl Readable for UndrainedClay {
    const NAME: &'static str = "undrained_clay";
    const MEANING: &'static str =
        "clay that is not drained, whose strength is a share of the vertical stress at the start";

    fn read(values: &[f64], _: &[usize]) -> Self {
        Self::new(values[0], values[1], values[2]).no_weaker(values[3])
    }
}
