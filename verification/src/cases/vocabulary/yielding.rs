//! Solids that yield in confined compression: laws of the kernel, and their closed forms.
//!
//! All of them yield at about the same compression. Those with friction have a Poisson's ratio of 0.2: with a larger one
//! the stress across the axis holds them below the surface for ever (K_0 = nu/(1 - nu) must be less than K_a).

use proctor_laws::{AnyLaw, ConeMatch, DruckerPrager, MohrCoulomb, Tresca, VonMises};

use crate::exact::homogeneous::Surface;
use crate::exact::two_slopes::TwoSlopes;

/// Variants of the cases, one a law.
pub const VON_MISES: &str = "von Mises";
/// Mohr-Coulomb without friction.
pub const TRESCA: &str = "Tresca";
/// Mohr-Coulomb's law with less dilation than friction.
pub const MOHR_COULOMB: &str = "Mohr-Coulomb";
/// Drucker-Prager's law with friction and dilation of the same soil, matched in plane strain.
pub const DRUCKER_PRAGER: &str = "Drucker-Prager";

/// All variants.
pub const LAWS: [&str; 4] = [VON_MISES, TRESCA, MOHR_COULOMB, DRUCKER_PRAGER];

const POISSON: f64 = 0.3; // Poisson's ratio of laws without friction
const POISSON_OF_SOIL: f64 = 0.2; // Poisson's ratio of laws with friction
const HARDENING: f64 = 0.1; // Hardening modulus over Young's modulus
/// Angles of friction and dilation \[°\].
const ANGLES: [f64; 2] = [20.0, 5.0];
/// Shear strength of Tresca over the yield stress of von Mises: both yield at the same compression.
const SHEAR_STRENGTH: f64 = 0.5;
/// Cohesion over that yield stress: with friction the limit is nearly the same.
const COHESION: f64 = 0.3;

/// A solid of these cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticSolid {
    /// One of [`LAWS`].
    pub variant: &'static str,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Yield stress of von Mises \[Pa\]; the strengths of the others are in proportion to it.
    pub strength: f64,
}

impl PlasticSolid {
    /// Poisson's ratio.
    pub fn poisson(&self) -> f64 {
        match self.variant {
            MOHR_COULOMB | DRUCKER_PRAGER => POISSON_OF_SOIL,
            _ => POISSON,
        }
    }

    /// Friction, cohesion and dilation.
    fn soil(&self) -> [f64; 3] {
        [ANGLES[0], COHESION * self.strength, ANGLES[1]]
    }

    fn drucker_prager(&self) -> DruckerPrager {
        DruckerPrager::new(
            self.young,
            POISSON_OF_SOIL,
            self.soil(),
            ConeMatch::PlaneStrain,
        )
    }

    /// The law.
    pub fn law(&self) -> AnyLaw {
        match self.variant {
            TRESCA => Tresca::new(self.young, POISSON, SHEAR_STRENGTH * self.strength).into(),
            MOHR_COULOMB => MohrCoulomb::new(self.young, POISSON_OF_SOIL, self.soil()).into(),
            DRUCKER_PRAGER => self.drucker_prager().into(),
            _ => VonMises::new(self.young, POISSON, self.strength, HARDENING * self.young).into(),
        }
    }

    /// The law with the strength that it has at first: von Mises does not harden.
    pub fn perfect(&self) -> AnyLaw {
        match self.variant {
            VON_MISES => VonMises::new(self.young, POISSON, self.strength, 0.0).into(),
            _ => self.law(),
        }
    }

    /// Yield surface and flow of the law that does not harden.
    pub fn surface(&self) -> Surface {
        match self.variant {
            TRESCA => Surface::MohrCoulomb([0.0, SHEAR_STRENGTH * self.strength, 0.0]),
            MOHR_COULOMB => Surface::MohrCoulomb(self.soil()),
            DRUCKER_PRAGER => Surface::Cone(self.drucker_prager().cone()),
            _ => Surface::Cone([0.0, self.strength / 3.0_f64.sqrt(), 0.0]),
        }
    }

    /// Its closed form in confined compression.
    pub fn exact(&self) -> TwoSlopes {
        let young = self.young;
        match self.variant {
            TRESCA => {
                let strength = SHEAR_STRENGTH * self.strength;
                TwoSlopes::mohr_coulomb(young, POISSON, [0.0, strength, 0.0])
            }
            MOHR_COULOMB => TwoSlopes::mohr_coulomb(young, POISSON_OF_SOIL, self.soil()),
            DRUCKER_PRAGER => {
                let cone = self.drucker_prager().cone();
                TwoSlopes::drucker_prager(young, POISSON_OF_SOIL, cone)
            }
            _ => TwoSlopes::von_mises(young, POISSON, self.strength, HARDENING * young),
        }
    }
}
