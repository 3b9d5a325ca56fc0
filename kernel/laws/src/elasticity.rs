//! Constants of isotropic elasticity.

use proctor_kernel::laws::{Constant, ConstantDefault, ConstantRange};

/// Young's modulus.
pub(crate) const YOUNG: Constant = Constant {
    key: "young",
    meaning: "Young's modulus",
    unit: "Pa",
    accepted: ConstantRange::Positive,
    given: ConstantDefault::Needed,
};

/// Poisson's ratio.
pub(crate) const POISSON: Constant = Constant {
    key: "poisson",
    meaning: "Poisson's ratio",
    unit: "",
    accepted: ConstantRange::Between(-1.0, 0.5),
    given: ConstantDefault::Needed,
};

/// Isotropic elasticity: four constants, of which two follow from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isotropic {
    /// Young's modulus E \[Pa\].
    pub young: f64,
    /// Poisson's ratio nu.
    pub poisson: f64,
    /// First Lamé parameter, lambda = E nu / ((1 + nu)(1 - 2 nu)) \[Pa\].
    pub lambda: f64,
    /// Shear modulus, G = E / (2 (1 + nu)) \[Pa\].
    pub shear: f64,
}

impl Isotropic {
    /// Law of Young's modulus \[Pa\] and Poisson's ratio.
    #[must_use]
    pub const fn new(young: f64, poisson: f64) -> Self {
        Self {
            young,
            poisson,
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            shear: young / (2.0 * (1.0 + poisson)),
        }
    }

    /// Bulk modulus, K = lambda + 2 G/3 \[Pa\].
    #[must_use]
    pub const fn bulk(&self) -> f64 {
        self.lambda + 2.0 * self.shear / 3.0
    }
}
