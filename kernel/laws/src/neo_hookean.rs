//! Compressible neo-Hookean elasticity.

use super::tensor::{Matrix, inner};
use super::{Constant, Increment, Isotropic, Law, Particle, Readable, Stress};
use crate::functions::ln;
use proctor_kernel::lanes::Lanes;

/// Compressible neo-Hookean elasticity: sigma = (mu (F F^T - 1) + lambda ln J 1) / J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    elasticity: Isotropic,
}

impl NeoHookean {
    /// Law of Young's modulus \[Pa\] and Poisson's ratio at small strain.
    #[must_use]
    pub const fn new(young: f64, poisson: f64) -> Self {
        Self {
            elasticity: Isotropic::new(young, poisson),
        }
    }

    /// Its constants, at small strain.
    #[must_use]
    pub const fn elasticity(&self) -> Isotropic {
        self.elasticity
    }

    /// Strain energy per initial volume, mu/2 (tr F F^T - 3) - mu ln J + lambda/2 (ln J)² \[J/m³\].
    #[must_use]
    pub fn energy_density(&self, trace_b: f64, j: f64) -> f64 {
        let ln_j = libm::log(j);
        0.5 * self.elasticity.shear * (trace_b - 3.0) - self.elasticity.shear * ln_j
            + 0.5 * self.elasticity.lambda * ln_j * ln_j
    }
}

impl Law for NeoHookean {
    const CONSTANTS: &'static [Constant] = &[super::YOUNG, super::POISSON];
    const NEEDS_DEFORMATION: bool = true;

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

    fn wave_speed(&self, density: f64) -> f64 {
        ((self.elasticity.lambda + 2.0 * self.elasticity.shear) / density).sqrt()
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        _: &mut [L],
    ) -> L {
        let (f, j) = (&increment.deformation, increment.jacobian);
        let ln_j = ln(j);
        *stress.packed_mut() = stress_of::<L, D>(self, f, (j, ln_j));
        speed_squared::<L, D>(self, f, ln_j, increment.density)
    }

    #[inline]
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        let f = &particle.deformation;
        let trace: f64 = f.iter().flatten().map(|x| x * x).sum();
        let initial = particle.mass / particle.density;
        self.energy_density(trace, particle.volume / initial) * initial
    }
}

impl Readable for NeoHookean {
    const NAME: &'static str = "neo_hookean";
    const MEANING: &'static str = "hyperelasticity for large strain, with an energy";

    fn read(values: &[f64], _: &[usize]) -> Self {
        Self::new(values[0], values[1])
    }
}

/// Stress of the neo-Hookean law, sigma = (mu (F F^T - 1) + lambda ln J 1)/J, plane strain in 2D.
#[inline(always)]
fn stress_of<L: Lanes, const D: usize>(
    law: &NeoHookean,
    f: &Matrix<L>,
    (j, ln_j): (L, L),
) -> [L; 6] {
    let zero = L::splat(0.0);
    let mut out = [zero; 6];
    let r = L::splat(1.0) / j;
    let mu = L::splat(law.elasticity.shear) * r;
    let volumetric = L::splat(law.elasticity.lambda) * ln_j * r - mu;
    out[0] = mu.mul_add(inner::<L, D>(&f[0], &f[0]), volumetric);
    out[1] = mu.mul_add(inner::<L, D>(&f[1], &f[1]), volumetric);
    if D == 2 {
        out[2] = mu + volumetric;
        out[3] = mu * inner::<L, D>(&f[0], &f[1]);
    } else {
        out[2] = mu.mul_add(inner::<L, D>(&f[2], &f[2]), volumetric);
        out[3] = mu * inner::<L, D>(&f[1], &f[2]);
        out[4] = mu * inner::<L, D>(&f[0], &f[2]);
        out[5] = mu * inner::<L, D>(&f[0], &f[1]);
    }
    out
}

/// Squared wave speed of the neo-Hookean law, bounded from above for every direction:
/// c² <= (mu b_max + max(lambda (1 - ln J) + mu, 0))/rho_0, the spatial speed along the largest principal stretch
/// of a longitudinal wave or, beyond J = exp(1 + mu/lambda), of a transverse one, with
/// b_max <= m + s sqrt(D - 1) from mean and spread of the eigenvalues of b = F F^T
/// (Wolkowicz and Styan 1980).
#[inline(always)]
fn speed_squared<L: Lanes, const D: usize>(
    law: &NeoHookean,
    f: &Matrix<L>,
    ln_j: L,
    density: f64,
) -> L {
    let mut trace = L::splat(0.0);
    let mut trace_of_square = L::splat(0.0);
    for a in 0..D {
        for b in 0..D {
            let entry = inner::<L, D>(&f[a], &f[b]);
            if a == b {
                trace = trace + entry;
            }
            trace_of_square = entry.mul_add(entry, trace_of_square);
        }
    }
    let share = L::splat(1.0 / D as f64);
    let mean = trace * share;
    let spread = (trace_of_square * share - mean * mean)
        .max(L::splat(0.0))
        .sqrt();
    let largest = L::splat((D as f64 - 1.0).sqrt()).mul_add(spread, mean);
    let (mu, lambda) = (
        L::splat(law.elasticity.shear),
        L::splat(law.elasticity.lambda),
    );
    let longitudinal = (lambda * (L::splat(1.0) - ln_j) + mu).max(L::splat(0.0));
    mu.mul_add(largest, longitudinal) / L::splat(density)
}
