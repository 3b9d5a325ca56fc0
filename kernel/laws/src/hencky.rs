//! Hyperelasticity in the logarithmic strain (Hencky).

use super::principal::spectrum;
use super::tensor::{Matrix, inner};
use super::{Constant, Increment, Isotropic, Law, Particle, Readable, Stress};
use crate::functions;
use proctor_kernel::lanes::{Backend, Kernel, Lanes, SelectedLanes};

/// Hencky's elasticity: Kirchhoff stress tau = J sigma = lambda tr(e) 1 + 2 mu e of the logarithmic strain e = ln(F F^T)/2.
///
/// Its energy per initial volume is lambda/2 tr(e)² + mu e : e, whatever the way to F. Waves have a speed in every direction
/// while principal stretches lie between 0.21 and 1.40 (Bruhns, Xiao and Meyers 2001); in tension beyond that it softens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hencky {
    elasticity: Isotropic,
}

impl Hencky {
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

    /// Strain energy per initial volume \[J/m³\] of principal logarithmic strains.
    #[must_use]
    pub fn energy_density(&self, strain: &[f64; 3]) -> f64 {
        let trace: f64 = strain.iter().sum();
        let square: f64 = strain.iter().map(|e| e * e).sum();
        0.5 * self.elasticity.lambda * trace * trace + self.elasticity.shear * square
    }

    /// Upper bound of the square of a wave speed \[m²/s²\] for principal logarithmic strains, the largest first.
    ///
    /// With y = e_i - e_j and tau_i = lambda ln J + 2 mu e_i a wave of normal n and polarisation m has
    /// `rho_0` c² = sum s_ij n_i² m_j² + sum c_ij (m_i n_i)(m_j n_j), where s_ij = mu (y + y coth y) and
    /// c_ij = lambda (1 - ln J) + mu (y coth y - e_i - e_j): at most the largest s_ij and the largest |c_ij| together.
    #[inline(always)]
    fn speed_squared<L: Lanes>(&self, strain: &[L; 3], density: f64) -> L {
        let (zero, one, two) = (L::splat(0.0), L::splat(1.0), L::splat(2.0));
        let (mu, lambda) = (
            L::splat(self.elasticity.shear),
            L::splat(self.elasticity.lambda),
        );
        // y coth y is at most 1 + y²/3, and at most 1 + |y|.
        let y = strain[0] - strain[2];
        let sheared = y + (one + y).min((y * y).mul_add(L::splat(1.0 / 3.0), one));
        let swelling = lambda * (one - (strain[0] + strain[1] + strain[2]));
        let most = mu.mul_add(one - two * strain[2], swelling);
        let least = mu.mul_add(one - two * strain[0], swelling);
        mu.mul_add(sheared, most.max(-least).max(zero)) * L::splat(1.0 / density)
    }
}

impl Law for Hencky {
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
        ((self.elasticity.lambda + 2.0 * self.elasticity.shear) * (1.0 / density)).sqrt()
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        _: &mut [L],
    ) -> L {
        let b = spectrum::<L, D>(&left_cauchy_green::<L, D>(&increment.deformation));
        let strain = logarithmic(&b.values);
        let one = L::splat(1.0);
        let swelling = L::splat(self.elasticity.lambda) * (strain[0] + strain[1] + strain[2]);
        let mu2 = L::splat(2.0 * self.elasticity.shear);
        let share = one / increment.jacobian;
        let mut values = strain;
        for value in &mut values {
            *value = mu2.mul_add(*value, swelling) * share;
        }
        *stress.packed_mut() = b.with::<D>(&values);
        self.speed_squared(&strain, increment.density)
    }

    fn energy(&self, particle: &Particle<'_>) -> f64 {
        let strain = SelectedLanes::any().run(Strains(&particle.deformation));
        self.energy_density(&strain) * particle.mass / particle.density
    }
}

impl Readable for Hencky {
    const NAME: &'static str = "hencky";
    const MEANING: &'static str = "hyperelasticity in the logarithmic strain, with an energy; near `elastic` at strains of some percent";

    fn read(values: &[f64], _: &[usize]) -> Self {
        Self::new(values[0], values[1])
    }
}

/// F F^T, ordered as a law is given a stress.
#[inline(always)]
fn left_cauchy_green<L: Lanes, const D: usize>(f: &Matrix<L>) -> [L; 6] {
    let mut b = [L::splat(0.0); 6];
    b[0] = inner::<L, D>(&f[0], &f[0]);
    b[1] = inner::<L, D>(&f[1], &f[1]);
    if D == 2 {
        b[2] = L::splat(1.0);
        b[3] = inner::<L, D>(&f[0], &f[1]);
    } else {
        b[2] = inner::<L, D>(&f[2], &f[2]);
        b[3] = inner::<L, D>(&f[1], &f[2]);
        b[4] = inner::<L, D>(&f[0], &f[2]);
        b[5] = inner::<L, D>(&f[0], &f[1]);
    }
    b
}

/// ln(b)/2 of principal values.
#[inline(always)]
fn logarithmic<L: Lanes>(values: &[L; 3]) -> [L; 3] {
    let mut strain = *values;
    for value in &mut strain {
        *value = L::splat(0.5) * functions::ln(*value);
    }
    strain
}

/// Principal logarithmic strains of one deformation gradient.
struct Strains<'a>(&'a [[f64; 3]; 3]);

impl Kernel for Strains<'_> {
    type Output = [f64; 3];

    #[inline(always)]
    fn run<B: Backend>(self) -> [f64; 3] {
        let mut f = [[B::Native::splat(0.0); 3]; 3];
        for (row, given) in f.iter_mut().zip(self.0) {
            for (value, given) in row.iter_mut().zip(given) {
                *value = B::Native::splat(*given);
            }
        }
        let b = left_cauchy_green::<B::Native, 3>(&f);
        let strain = logarithmic(&spectrum::<B::Native, 3>(&b).values);
        let mut found = [0.0; 3];
        for (found, strain) in found.iter_mut().zip(strain) {
            let mut all = [0.0; 8];
            strain.store(&mut all);
            *found = all[0];
        }
        found
    }
}
