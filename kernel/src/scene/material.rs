//! Materials and their constitutive laws.

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Initial mass density \[kg/m³\].
    pub density: f64,
    /// Constitutive law.
    pub law: Law,
}

/// Constitutive law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Hypoelastic, linear in the rate of deformation.
    LinearElastic {
        /// Young's modulus \[Pa\].
        young: f64,
        /// Poisson's ratio.
        poisson: f64,
        /// Objective rate.
        rate: ObjectiveRate,
    },
    /// Compressible neo-Hookean: sigma = (mu (F F^T - 1) + lambda ln J 1) / J.
    NeoHookean {
        /// Young's modulus at small strain \[Pa\].
        young: f64,
        /// Poisson's ratio at small strain.
        poisson: f64,
    },
}

impl Law {
    /// Young's modulus \[Pa\] and Poisson's ratio.
    #[must_use]
    pub fn young_poisson(self) -> (f64, f64) {
        match self {
            Self::LinearElastic { young, poisson, .. } | Self::NeoHookean { young, poisson } => {
                (young, poisson)
            }
        }
    }

    /// First Lamé parameter lambda = E nu / ((1 + nu)(1 - 2 nu)) \[Pa\].
    #[must_use]
    pub fn lambda(self) -> f64 {
        let (e, nu) = self.young_poisson();
        e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus G = E / (2 (1 + nu)) \[Pa\].
    #[must_use]
    pub fn shear(self) -> f64 {
        let (e, nu) = self.young_poisson();
        e / (2.0 * (1.0 + nu))
    }
}

/// Objective stress rate of the hypoelastic law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectiveRate {
    /// Hughes and Winget 1980: exact for rigid rotation increments.
    HughesWinget,
    /// Jaumann rate, forward Euler, as in the manuals; grows under rotation. For comparison.
    JaumannForward,
}
