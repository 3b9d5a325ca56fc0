//! Laws of the kernel as a mill needs them: the law itself, and what its stress is along a motion.
//!
//! Neo-Hookean and Hencky's elasticity are functions of F, Newton's fluid of F and its rate; they stand here once more, in other
//! forms than the kernel's. Laws with a memory are integrated along the exact motion by their own update
//! ([`path`](super::path)).

use proctor_laws::{
    AnyLaw, Bingham, ConeMatch, DruckerPrager, EquationOfState, Hencky, Isotropic, LinearElastic,
    MohrCoulomb, NeoHookean, Newtonian, Tresca, VonMises,
};

use super::motion::{Matrix, matrix};
use crate::exact::jet::{Jet, Scalar};

/// Angle of friction of the soil that mills draw \[degrees\].
pub const FRICTION: f64 = 25.0;
/// Its angle of dilation \[degrees\]: the same, since with less what yields everywhere has waves of no real speed, and no
/// mesh has a solution (Rudnicki and Rice 1975).
pub const DILATION: f64 = 25.0;
/// Exponent of the pressure of Newton's fluid, that of water (Tait).
const EXPONENT: usize = 7;
/// Shear modulus of a Bingham fluid that does not flow, over its bulk modulus.
const SHEAR_OF_FLUID: f64 = 0.4;

/// A kind of law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Neo-Hookean elasticity.
    NeoHookean,
    /// Elasticity in the logarithmic strain.
    Hencky,
    /// Elasticity in the rate of deformation.
    Elastic,
    /// Von Mises with linear hardening.
    VonMises,
    /// Drucker and Prager, matched in plane strain.
    DruckerPrager,
    /// Tresca without hardening, in the plane.
    Tresca,
    /// Mohr and Coulomb without softening, in the plane.
    MohrCoulomb,
    /// Newton's fluid.
    Newtonian,
    /// Bingham's fluid, where all of it flows.
    Bingham,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::NeoHookean,
        Self::Hencky,
        Self::Elastic,
        Self::Newtonian,
        Self::VonMises,
        Self::DruckerPrager,
        Self::Bingham,
        Self::Tresca,
        Self::MohrCoulomb,
    ];
    /// Number of materials that are drawn in space: a face of a pyramid of yield is left there where a stress across it grows.
    pub const IN_SPACE: usize = 7;

    /// The word of scene files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::NeoHookean => "neo_hookean",
            Self::Hencky => "hencky",
            Self::Elastic => "elastic",
            Self::VonMises => "von_mises",
            Self::DruckerPrager => "drucker_prager",
            Self::Tresca => "tresca",
            Self::MohrCoulomb => "mohr_coulomb",
            Self::Newtonian => "newtonian",
            Self::Bingham => "bingham",
        }
    }

    /// True where its stress depends on the way to F.
    #[must_use]
    pub fn remembers(self) -> bool {
        !matches!(self, Self::NeoHookean | Self::Hencky | Self::Newtonian)
    }

    /// True where it has a yield surface.
    #[must_use]
    pub fn yields(self) -> bool {
        self.remembers() && self != Self::Elastic
    }

    /// True where its yield surface has edges, which a stress must not reach.
    #[must_use]
    pub fn has_edges(self) -> bool {
        matches!(self, Self::Tresca | Self::MohrCoulomb)
    }
}

/// A law with its constants, its density and the uniform stress of the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Kind of law.
    pub kind: Kind,
    /// Young's modulus, bulk modulus of a fluid \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Yield stress of von Mises, cohesion of Drucker and Prager, Tresca, and Mohr and Coulomb, shear stress at which a Bingham
    /// fluid flows \[Pa\].
    pub strength: f64,
    /// Growth of the yield stress with the plastic strain \[Pa\].
    pub hardening: f64,
    /// Viscosity of a fluid \[Pa s\].
    pub viscosity: f64,
    /// Initial density \[kg/m³\].
    pub density: f64,
    /// Stress of the start xx, yy, zz, yz, xz, xy \[Pa\].
    pub stress: [f64; 6],
}

impl Material {
    /// Lamé's constants at small strain.
    #[must_use]
    pub fn elasticity(&self) -> Isotropic {
        Isotropic::new(self.young, self.poisson)
    }

    /// Von Mises of these constants.
    #[must_use]
    pub fn von_mises(&self) -> VonMises {
        VonMises::new(self.young, self.poisson, self.strength, self.hardening)
    }

    /// Drucker and Prager of these constants.
    #[must_use]
    pub fn drucker_prager(&self) -> DruckerPrager {
        let angles = [FRICTION, self.strength, DILATION];
        DruckerPrager::new(self.young, self.poisson, angles, ConeMatch::PlaneStrain)
    }

    /// Tresca of these constants.
    #[must_use]
    pub fn tresca(&self) -> Tresca {
        Tresca::new(self.young, self.poisson, self.strength)
    }

    /// Mohr and Coulomb of these constants.
    #[must_use]
    pub fn mohr_coulomb(&self) -> MohrCoulomb {
        let angles = [FRICTION, self.strength, DILATION];
        MohrCoulomb::new(self.young, self.poisson, angles)
    }

    /// Bingham's fluid of these constants.
    #[must_use]
    pub fn bingham(&self) -> Bingham {
        let shear = SHEAR_OF_FLUID * self.young;
        Bingham::new(self.young, self.viscosity, self.strength, shear)
    }

    /// Half the difference of the principal stresses in the plane \[Pa\] on the pyramid of Mohr and Coulomb, c cos phi - p sin
    /// phi at a mean p of both \[Pa\].
    #[must_use]
    pub fn pyramid_radius(&self, mean: f64) -> f64 {
        let (sin, cos) = libm::sincos(FRICTION.to_radians());
        cos * self.strength - sin * mean
    }

    /// sqrt(J_2) \[Pa\] on the cone of Drucker and Prager at a mean stress \[Pa\], matched in plane strain: xi c - eta p with
    /// eta = sin phi / A, xi = cos phi / A, A = sqrt(1 - e²/3) + e sin phi / 3 and e = 3 sin psi / sqrt(9 + 3 sin² psi).
    #[must_use]
    pub fn cone_radius(&self, mean: f64) -> f64 {
        let (sin, cos) = libm::sincos(FRICTION.to_radians());
        let flow = libm::sin(DILATION.to_radians());
        let e = 3.0 * flow / (9.0 + 3.0 * flow * flow).sqrt();
        let a = (1.0 - e * e / 3.0).sqrt() + e * sin / 3.0;
        (cos * self.strength - sin * mean) / a
    }

    /// The law of the kernel.
    #[must_use]
    pub fn law(&self) -> AnyLaw {
        let (young, poisson) = (self.young, self.poisson);
        match self.kind {
            Kind::NeoHookean => NeoHookean::new(young, poisson).into(),
            Kind::Hencky => Hencky::new(young, poisson).into(),
            Kind::Elastic => LinearElastic::new(young, poisson).into(),
            Kind::VonMises => self.von_mises().into(),
            Kind::DruckerPrager => self.drucker_prager().into(),
            Kind::Tresca => self.tresca().into(),
            Kind::MohrCoulomb => self.mohr_coulomb().into(),
            Kind::Newtonian => (Newtonian::new(young, self.viscosity))
                .with_state(EquationOfState {
                    bulk: young,
                    exponent: EXPONENT as f64,
                    carries_tension: true,
                })
                .into(),
            Kind::Bingham => self.bingham().into(),
        }
    }

    /// Speed of waves that shear and swell a body of Young's modulus and density, sqrt(E/rho) \[m/s\].
    #[must_use]
    pub fn speed(&self) -> f64 {
        (self.young / self.density).sqrt()
    }

    /// Kirchhoff stress tau = J sigma \[Pa\] of a law without memory, of F and its rate \[1/s\]: mu (b - 1) + lambda ln J 1 of
    /// the neo-Hookean law, mu ln b + lambda ln J 1 of Hencky's, with b = F F^T, and K/n (J - J^(1-n)) 1 + 2 J mu dev D of
    /// Newton's fluid. In the plane (`D` = 2) b_zz is 1.
    pub fn kirchhoff<T: Scalar, const D: usize>(
        &self,
        f: &Matrix<T>,
        rate: &Matrix<T>,
    ) -> Matrix<T> {
        if self.kind == Kind::Newtonian {
            return self.of_fluid::<T, D>(f, rate);
        }
        let elasticity = self.elasticity();
        let (mu, lambda) = (T::of(elasticity.shear), T::of(elasticity.lambda));
        let one = |i: usize, j: usize| T::of(f64::from(u8::from(i == j)));
        let b = block::<T, D>(|i, j| inner::<T, D>(&f[i], &f[j]));
        let swelling = lambda * determinant_of::<T, D>(f).ln();
        let strain = if self.kind == Kind::Hencky {
            logarithm::<T, D>(&b)
        } else {
            block::<T, D>(|i, j| b[i][j] - one(i, j))
        };
        matrix(|i, j| {
            let volumetric = swelling * one(i, j);
            if i < D && j < D {
                mu * strain[i][j] + volumetric
            } else {
                volumetric
            }
        })
    }

    /// Stress of Newton's fluid.
    fn of_fluid<T: Scalar, const D: usize>(&self, f: &Matrix<T>, rate: &Matrix<T>) -> Matrix<T> {
        let jacobian = determinant_of::<T, D>(f);
        let gradient = product_of::<T, D>(rate, &inverse_of::<T, D>(f));
        let trace = (1..D).fold(gradient[0][0], |sum, i| sum + gradient[i][i]);
        let viscous = jacobian * T::of(self.viscosity);
        let bulk = T::of(self.young / EXPONENT as f64);
        let volumetric = bulk * (jacobian - T::of(1.0) / jacobian.power(EXPONENT - 1))
            - viscous * trace * T::of(2.0 / 3.0);
        matrix(|i, j| {
            let shear = viscous * (gradient[i][j] + gradient[j][i]);
            shear + volumetric * T::of(f64::from(u8::from(i == j)))
        })
    }
}

/// Terms of the series in space: (1/3)^33 is below round-off, and 1/3 is reached at a stretch of 1.41.
const TERMS: usize = 17;
/// Terms of that in the plane, where the square of r/m is 0.36 there.
const TERMS_IN_PLANE: usize = 32;

/// Matrix logarithm ln b of a matrix near 1.
fn logarithm<T: Scalar, const D: usize>(b: &Matrix<T>) -> Matrix<T> {
    if D == 2 {
        logarithm_in_plane(b)
    } else {
        gregory(b)
    }
}

/// With the mean m of the principal values, their distance r from it and the deviator b - m 1: ln b is ln(det b)/2 1 +
/// artanh(r/m)/r (b - m 1), smooth also where r = 0: artanh(x)/x = 1 + x²/3 + x⁴/5 + ...
fn logarithm_in_plane<T: Scalar>(b: &Matrix<T>) -> Matrix<T> {
    let mean = (b[0][0] + b[1][1]) * T::of(0.5);
    let determinant = determinant_of::<T, 2>(b);
    let square = T::of(1.0) - determinant / (mean * mean);
    let mut sum = T::of(0.0);
    for k in (0..TERMS_IN_PLANE).rev() {
        sum = sum * square + T::of(1.0 / (2 * k + 1) as f64);
    }
    let (share, volumetric) = (sum / mean, determinant.ln() * T::of(0.5));
    block::<T, 2>(|i, j| {
        if i == j {
            volumetric + share * (b[i][j] - mean)
        } else {
            share * b[i][j]
        }
    })
}

/// ln b = 2 (Z + Z³/3 + Z⁵/5 + ...) with Z = (b - 1)(b + 1)^-1 (Gregory).
fn gregory<T: Scalar>(b: &Matrix<T>) -> Matrix<T> {
    let one = |i: usize, j: usize| T::of(f64::from(u8::from(i == j)));
    let above = matrix(|i, j| b[i][j] + one(i, j));
    let below = matrix(|i, j| b[i][j] - one(i, j));
    let z = product_of::<T, 3>(&below, &inverse_of::<T, 3>(&above));
    let square = product_of::<T, 3>(&z, &z);
    let mut sum = matrix(|i, j| one(i, j) * T::of(2.0 / (2 * TERMS - 1) as f64));
    for k in (0..TERMS - 1).rev() {
        let term = T::of(2.0 / (2 * k + 1) as f64);
        let higher = product_of::<T, 3>(&sum, &square);
        sum = matrix(|i, j| higher[i][j] + one(i, j) * term);
    }
    product_of::<T, 3>(&sum, &z)
}

/// A matrix whose leading D x D block has these entries, and 0 beyond it.
fn block<T: Scalar, const D: usize>(entry: impl Fn(usize, usize) -> T) -> Matrix<T> {
    matrix(|i, j| {
        if i < D && j < D {
            entry(i, j)
        } else {
            T::of(0.0)
        }
    })
}

/// Inner product of the first D entries.
fn inner<T: Scalar, const D: usize>(a: &[T; 3], b: &[T; 3]) -> T {
    (1..D).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

/// Product of leading blocks.
pub fn product_of<T: Scalar, const D: usize>(a: &Matrix<T>, b: &Matrix<T>) -> Matrix<T> {
    block::<T, D>(|i, j| (1..D).fold(a[i][0] * b[0][j], |sum, k| sum + a[i][k] * b[k][j]))
}

/// Determinant of the leading block.
pub fn determinant_of<T: Scalar, const D: usize>(m: &Matrix<T>) -> T {
    if D == 2 {
        m[0][0] * m[1][1] - m[0][1] * m[1][0]
    } else {
        super::motion::determinant(m)
    }
}

/// Inverse of the leading block.
pub fn inverse_of<T: Scalar, const D: usize>(m: &Matrix<T>) -> Matrix<T> {
    if D == 3 {
        return super::motion::inverse(m);
    }
    let share = T::of(1.0) / determinant_of::<T, 2>(m);
    let zero = T::of(0.0);
    [
        [m[1][1] * share, -(m[0][1] * share), zero],
        [-(m[1][0] * share), m[0][0] * share, zero],
        [zero; 3],
    ]
}

/// Divergence of the first Piola-Kirchhoff stress P = tau F^-T by X, of the first D axes \[N/m³\].
#[must_use]
pub fn divergence<const D: usize>(
    kirchhoff: &Matrix<Jet<D>>,
    deformation: &Matrix<Jet<D>>,
) -> [f64; 3] {
    let inverse = inverse_of::<_, D>(deformation);
    std::array::from_fn(|i| {
        if i >= D {
            return 0.0;
        }
        // Of P_iJ = tau_ik F^-1_Jk the derivative by X_J alone.
        let of = |j: usize| {
            (0..D)
                .map(|k| {
                    let (a, b) = (&kirchhoff[i][k], &inverse[j][k]);
                    a.partials[j] * b.value + a.value * b.partials[j]
                })
                .sum::<f64>()
        };
        (0..D).map(of).sum()
    })
}
