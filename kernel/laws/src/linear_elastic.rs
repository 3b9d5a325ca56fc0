//! Linear elasticity in the rate of deformation (hypoelastic).

use super::tensor::{Configuration, Matrix, VOIGT, inverse, one_plus, product, rotate};
use super::{Choice, Constant, Increment, Isotropic, Law, Particle, Readable, StrainRange, Stress};
use proctor_kernel::lanes::Lanes;

/// Objective stress rate of the hypoelastic law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectiveRate {
    /// Hughes and Winget 1980: exact for rigid rotation increments.
    HughesWinget,
    /// Jaumann rate, forward Euler, as in the manuals; grows under rotation. For comparison.
    JaumannForward,
}

/// Isotropic elasticity, linear in the rate of deformation: sigma' = C : D with an objective rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearElastic {
    elasticity: Isotropic,
    rate: ObjectiveRate,
}

impl LinearElastic {
    /// Largest |J - 1| at which the law may be taken for one with an energy. In a change of volume alone the stress is K ln J,
    /// whose work is K (J ln J - J + 1), and half of stress times logarithmic strain is off by a share of (J - 1)/3 of it: 3 %
    /// there.
    pub const MOST_VOLUME_CHANGE: f64 = 0.1;

    /// The share by which the strain energy of a pure change of volume is off at this J: see
    /// [`MOST_VOLUME_CHANGE`](Self::MOST_VOLUME_CHANGE).
    #[must_use]
    pub fn energy_error(jacobian: f64) -> f64 {
        let ln_j = libm::log(jacobian);
        let work = jacobian * ln_j - jacobian + 1.0;
        if work > 0.0 {
            (0.5 * ln_j * ln_j * jacobian / work - 1.0).abs()
        } else {
            0.0
        }
    }

    /// Law of Young's modulus \[Pa\], Poisson's ratio and the rate of Hughes and Winget.
    #[must_use]
    pub const fn new(young: f64, poisson: f64) -> Self {
        Self::with_rate(young, poisson, ObjectiveRate::HughesWinget)
    }

    /// The same with another objective rate.
    #[must_use]
    pub const fn with_rate(young: f64, poisson: f64, rate: ObjectiveRate) -> Self {
        Self {
            elasticity: Isotropic::new(young, poisson),
            rate,
        }
    }

    /// Law of a shear modulus \[Pa\] and no resistance to a change of volume.
    pub(super) const fn of_shear(shear: f64) -> Self {
        Self {
            elasticity: Isotropic {
                young: 0.0,
                poisson: -1.0,
                lambda: -2.0 / 3.0 * shear,
                shear,
            },
            rate: ObjectiveRate::HughesWinget,
        }
    }

    /// Objective rate.
    #[must_use]
    pub fn rate(&self) -> ObjectiveRate {
        self.rate
    }

    /// Its constants.
    #[must_use]
    pub const fn elasticity(&self) -> Isotropic {
        self.elasticity
    }

    /// Strain energy density of a stress state, sigma : C^-1 : sigma / 2 \[J/m³\]; stress xx, yy, zz, yz, xz, xy.
    #[inline]
    #[must_use]
    pub fn energy_density(&self, s: &[f64; 6]) -> f64 {
        let trace = s[0] + s[1] + s[2];
        let square = s[0] * s[0]
            + s[1] * s[1]
            + s[2] * s[2]
            + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
        let bulk3 = 3.0 * self.elasticity.lambda + 2.0 * self.elasticity.shear;
        (square - self.elasticity.lambda / bulk3 * trace * trace) / (4.0 * self.elasticity.shear)
    }
}

impl Law for LinearElastic {
    fn strain_range(&self) -> Option<StrainRange> {
        Some(StrainRange {
            most_volume_change: Self::MOST_VOLUME_CHANGE,
            energy_error: Self::energy_error,
            law: Self::NAME,
            instead: "`neo_hookean` and `hencky` have an energy at any strain",
            cause: "`elastic` at large strain, which has no energy: use `neo_hookean` or `hencky`",
        })
    }

    const CONSTANTS: &'static [Constant] = &[super::YOUNG, super::POISSON];

    crate::compiled_here!();

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        vec![self.elasticity.young, self.elasticity.poisson]
    }

    fn young(&self) -> f64 {
        self.elasticity.young
    }

    /// Wave speed as every step forms it, from the volume of a unit of mass.
    fn wave_speed(&self, density: f64) -> f64 {
        ((self.elasticity.lambda + 2.0 * self.elasticity.shear) * (1.0 / density)).sqrt()
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        _: &mut [L],
    ) -> L {
        let stress = stress.packed_mut();
        *stress = hypoelastic::<L, D>(self, &increment.gradient, increment.configuration, stress);
        L::splat(self.elasticity.lambda + 2.0 * self.elasticity.shear)
            * (increment.volume / increment.mass)
    }

    #[inline]
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.energy_density(&particle.stress) * particle.volume
    }
}

impl Readable for LinearElastic {
    const NAME: &'static str = "elastic";
    const MEANING: &'static str = "elasticity in rate form, for strains of some percent; it has no energy, so that a cycle of large strain gains or loses work: take `neo_hookean` or `hencky` there";
    const CHOICES: &'static [Choice] = &[Choice {
        key: "objective_rate",
        words: &["hughes_winget", "jaumann"],
        meaning: "Objective stress rate of an elastic material.",
        elsewhere: "an objective rate for a {law} material, which is no rate law",
    }];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        let rates = [ObjectiveRate::HughesWinget, ObjectiveRate::JaumannForward];
        Self::with_rate(values[0], values[1], rates[choices[0]])
    }
}

/// Stress of the hypoelastic laws after the step. `s` is xx, yy, zz, yz, xz, xy in 3D and xx, yy, zz, xy in its
/// first four entries in 2D.
#[inline(always)]
fn hypoelastic<L: Lanes, const D: usize>(
    law: &LinearElastic,
    g: &Matrix<L>,
    at: Configuration,
    s: &[L; 6],
) -> [L; 6] {
    if law.rate == ObjectiveRate::JaumannForward {
        return jaumann_forward::<L, D>(law, g, s);
    }
    let g_mid = midpoint::<L, D>(g, at);
    let rotated = rotate::<L, D>(&g_mid, s);
    add_elastic::<L, D>(law, &g_mid, &rotated)
}

/// Velocity gradient times time step on the midpoint configuration (Hughes and Winget 1980): its symmetric part is the
/// strain increment, the other the spin. G_mid = 2 (f - 1)(f + 1)^-1, which is G (1 + G/2)^-1 or G (1 - G/2)^-1.
#[inline(always)]
pub(super) fn midpoint<L: Lanes, const D: usize>(g: &Matrix<L>, at: Configuration) -> Matrix<L> {
    let half = match at {
        Configuration::Beginning => 0.5,
        Configuration::End => -0.5,
    };
    product::<L, D>(g, &inverse::<L, D>(&one_plus::<L, D>(g, half)))
}

/// The strain increment in the configuration half way, ordered as a law is given a stress.
#[inline(always)]
pub(super) fn strain<L: Lanes, const D: usize>(increment: &Increment<L>) -> [L; 6] {
    let g = midpoint::<L, D>(&increment.gradient, increment.configuration);
    let half = L::splat(0.5);
    let mut e = [L::splat(0.0); 6];
    for i in 0..D {
        e[i] = g[i][i];
    }
    if D == 2 {
        e[3] = half * (g[0][1] + g[1][0]);
    } else {
        e[3] = half * (g[1][2] + g[2][1]);
        e[4] = half * (g[0][2] + g[2][0]);
        e[5] = half * (g[0][1] + g[1][0]);
    }
    e
}

/// sigma + lambda tr(e) 1 + 2 G e with e = sym(g).
#[inline(always)]
fn add_elastic<L: Lanes, const D: usize>(law: &LinearElastic, g: &Matrix<L>, s: &[L; 6]) -> [L; 6] {
    let shear = L::splat(law.elasticity.shear);
    let shear2 = L::splat(2.0 * law.elasticity.shear);
    let mut trace = g[0][0] + g[1][1];
    if D == 3 {
        trace = trace + g[2][2];
    }
    let pressure = L::splat(law.elasticity.lambda) * trace;
    let mut out = *s;
    for i in 0..3 {
        out[i] = s[i] + pressure;
        if i < D {
            out[i] = shear2.mul_add(g[i][i], out[i]);
        }
    }
    if D == 2 {
        out[3] = shear.mul_add(g[0][1] + g[1][0], s[3]);
    } else {
        out[3] = shear.mul_add(g[1][2] + g[2][1], s[3]);
        out[4] = shear.mul_add(g[0][2] + g[2][0], s[4]);
        out[5] = shear.mul_add(g[0][1] + g[1][0], s[5]);
    }
    out
}

/// sigma + (W sigma - sigma W) + C : D, all at the beginning of the step (technical manual, algorithm 2,
/// lines 19-22). The in-plane deviator grows by about 8 pi²/N per turn of N steps.
#[inline(always)]
fn jaumann_forward<L: Lanes, const D: usize>(
    law: &LinearElastic,
    g: &Matrix<L>,
    s: &[L; 6],
) -> [L; 6] {
    let half = L::splat(0.5);
    let two = L::splat(2.0);
    let mut out = add_elastic::<L, D>(law, g, s);
    if D == 2 {
        let w = half * (g[0][1] - g[1][0]);
        out[0] = out[0] + two * w * s[3];
        out[1] = out[1] - two * w * s[3];
        out[3] = out[3] + w * (s[1] - s[0]);
    } else {
        let m = [[s[0], s[5], s[4]], [s[5], s[1], s[3]], [s[4], s[3], s[2]]];
        let mut w = *g;
        for i in 0..3 {
            for j in 0..3 {
                w[i][j] = half * (g[i][j] - g[j][i]);
            }
        }
        for (slot, (i, j)) in VOIGT.into_iter().enumerate() {
            let mut turned = w[i][0] * m[0][j] + w[j][0] * m[0][i];
            for k in 1..3 {
                turned = turned + w[i][k] * m[k][j] + w[j][k] * m[k][i];
            }
            out[slot] = out[slot] + turned;
        }
    }
    out
}
