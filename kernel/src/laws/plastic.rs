//! What laws with a yield surface have in common: an elastic trial stress, its return, and what the way back costs.
//!
//! The elastic increment of Hughes and Winget gives a trial stress; a law returns it to its yield surface by the implicit
//! (backward Euler) rule, sigma = sigma_trial - C : de_p. A particle that does not yield keeps the bits of the trial stress.

use super::linear_elastic::strain;
use super::principal::components;
use super::{
    Constant, Curve, Given, Increment, Isotropic, Law, LinearElastic, Particle, Rows, Unfit,
};
use crate::lanes::Lanes;
use crate::layout::Variable;
use std::fmt;

/// Plastic deviatoric strain, the sum of sqrt(2/3 e : e) over the deviators e of plastic strain increments.
pub const STRAIN: Variable = Variable::scalar("plastic strain", "");
/// Plastic work per initial volume.
pub const WORK: Variable = Variable::scalar("plastic work", "J/m³");
/// Algorithmic work per initial volume: see [`Law::algorithmic`].
pub const ALGORITHMIC: Variable = Variable::scalar("algorithmic work", "J/m³");
/// Plastic volume strain.
pub const VOLUME_STRAIN: Variable = Variable::scalar("plastic volume strain", "");

/// Time over which a stress outside the yield surface returns to it; zero returns it at once.
pub(super) const RELAXATION: Constant = Constant {
    key: "relaxation_time",
    meaning: "Time in which a stress beyond the yield surface returns to it (Duvaut and Lions 1972); 0 returns it at once",
    unit: "s",
    accepted: super::Accepted::NotNegative,
    given: Given::Or(0.0),
};

/// A law with a yield surface. Whoever has it is a [`Law`]: elastic until its trial stress lies beyond the surface.
pub trait Yielding: fmt::Debug + PartialEq + Send + Sync + 'static {
    /// See [`Law::CONSTANTS`].
    const CONSTANTS: &'static [Constant];

    /// See [`Law::CURVES`].
    const CURVES: &'static [Curve] = &[];

    /// See [`Law::VARIABLES`]. The first three are the plastic strain, the plastic work and the algorithmic work ([`STRAIN`],
    /// [`WORK`], [`ALGORITHMIC`]); a fourth one is the plastic volume strain ([`VOLUME_STRAIN`]).
    const VARIABLES: &'static [Variable] = &[STRAIN, WORK, ALGORITHMIC];

    /// See [`Law::name`].
    fn name(&self) -> &'static str;

    /// See [`Law::values`].
    fn values(&self) -> Vec<f64>;

    /// See [`Law::curves`].
    fn curves(&self) -> Vec<Rows> {
        vec![]
    }

    /// See [`Law::problems`].
    fn problems(&self) -> Vec<Unfit>;

    /// See [`Law::warnings`].
    fn warnings(&self) -> Vec<String>;

    /// See [`Law::in_cells`].
    fn in_cells(&self, _cell: f64) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Its elasticity.
    fn elastic(&self) -> &LinearElastic;

    /// Relaxation time \[s\], 0 for none.
    fn relaxation(&self) -> f64;

    /// The stress that the trial stress returns to, and where it does: `None` where no lane yields. Ordered as a law is
    /// given a stress. `variables` are those before the step. Must be `#[inline(always)]`.
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        variables: &[L],
    ) -> Option<([L; 6], L::Mask)>;
}

impl<Y: Yielding> Law for Y {
    const CONSTANTS: &'static [Constant] = Y::CONSTANTS;
    const CURVES: &'static [Curve] = Y::CURVES;
    const VARIABLES: &'static [Variable] = Y::VARIABLES;
    const YIELDS: bool = true;

    fn name(&self) -> &'static str {
        Yielding::name(self)
    }

    fn values(&self) -> Vec<f64> {
        Yielding::values(self)
    }

    fn curves(&self) -> Vec<Rows> {
        Yielding::curves(self)
    }

    fn problems(&self) -> Vec<Unfit> {
        Yielding::problems(self)
    }

    fn warnings(&self) -> Vec<String> {
        Yielding::warnings(self)
    }

    fn in_cells(&self, cell: f64) -> Option<Self> {
        Yielding::in_cells(self, cell)
    }

    fn young(&self) -> f64 {
        self.elastic().young()
    }

    fn wave_speed(&self, density: f64) -> f64 {
        self.elastic().wave_speed(density)
    }

    /// The square of the elastic wave speed, which is the fastest.
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut [L; 6],
        variables: &mut [L],
    ) -> L {
        let speed_squared = self.elastic().update::<L, D>(increment, stress, &mut []);
        if let Some((mut returned, yields)) = self.returned::<L, D>(stress, variables) {
            let tau = self.relaxation();
            if tau > 0.0 {
                // Implicit in time: sigma = (sigma_trial + (dt/tau) sigma_returned)/(1 + dt/tau).
                let share = L::splat(increment.dt / (tau + increment.dt));
                for slot in 0..components(D) {
                    returned[slot] = share.mul_add(returned[slot] - stress[slot], stress[slot]);
                }
            }
            let elasticity = self.elastic().elasticity();
            let strain = strain::<L, D>(increment);
            let way = way_back::<L, D>(&elasticity, stress, &returned, &strain);
            let volume = increment.volume / increment.mass * L::splat(increment.density);
            let zero = L::splat(0.0);
            variables[0] = variables[0] + L::select(yields, way.strain, zero);
            variables[1] = variables[1] + L::select(yields, way.work * volume, zero);
            variables[2] = variables[2] + L::select(yields, way.algorithmic * volume, zero);
            if let Some(dilation) = variables.get_mut(3) {
                *dilation = *dilation + L::select(yields, way.dilation, zero);
            }
            for slot in 0..components(D) {
                stress[slot] = L::select(yields, returned[slot], stress[slot]);
            }
        }
        speed_squared
    }

    #[inline]
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.elastic().energy(particle)
    }

    /// The plastic work.
    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[1] * particle.mass / particle.density
    }

    fn algorithmic(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[2] * particle.mass / particle.density
    }
}

/// What lies between a trial stress and the stress after it.
struct WayBack<L> {
    /// Plastic deviatoric strain, sqrt(2/3 e : e) of the deviator e of the plastic strain increment.
    strain: L,
    /// Plastic work per volume \[J/m³\], sigma : de_p with the stress after the step.
    work: L,
    /// (sigma_n - sigma) : de_p / 2 per volume \[J/m³\], sigma_n the stress before the step, turned with it.
    algorithmic: L,
    /// Plastic volume strain, tr de_p.
    dilation: L,
}

/// The plastic strain increment de_p = C^-1 : (sigma_trial - sigma) in numbers, for a strain increment de. What the stress
/// was before is sigma_trial - C : de, so that (sigma_n - sigma) : de_p is (sigma_trial - sigma) : (de_p - de).
#[inline(always)]
fn way_back<L: Lanes, const D: usize>(
    elasticity: &Isotropic,
    trial: &[L; 6],
    after: &[L; 6],
    strain: &[L; 6],
) -> WayBack<L> {
    let third = L::splat(1.0 / 3.0);
    let mut change = [L::splat(0.0); 6];
    for slot in 0..components(D) {
        change[slot] = trial[slot] - after[slot];
    }
    let (mean_change, mean) = (
        (change[0] + change[1] + change[2]) * third,
        (after[0] + after[1] + after[2]) * third,
    );
    let (mut square, mut product, mut whole) = (L::splat(0.0), L::splat(0.0), L::splat(0.0));
    for slot in 0..components(D) {
        let (e, s) = if slot < 3 {
            (change[slot] - mean_change, after[slot] - mean)
        } else {
            (change[slot], after[slot])
        };
        let twice = L::splat(if slot < 3 { 1.0 } else { 2.0 });
        square = (twice * e).mul_add(e, square);
        product = (twice * e).mul_add(s, product);
        whole = (twice * change[slot]).mul_add(strain[slot], whole);
    }
    let shear = elasticity.shear;
    let bulk = elasticity.bulk();
    let dilation = mean_change * L::splat(1.0 / bulk);
    let undone = square.mul_add(L::splat(1.0 / (2.0 * shear)), mean_change * dilation);
    WayBack {
        strain: square.sqrt() * L::splat((2.0_f64 / 3.0).sqrt() / (2.0 * shear)),
        work: product.mul_add(L::splat(1.0 / (2.0 * shear)), mean * dilation),
        algorithmic: L::splat(0.5) * (undone - whole),
        dilation,
    }
}

/// Mean stress and deviator of a stress, ordered as a law is given it.
#[inline(always)]
pub(super) fn deviator<L: Lanes, const D: usize>(s: &[L; 6]) -> (L, [L; 6]) {
    let mean = (s[0] + s[1] + s[2]) * L::splat(1.0 / 3.0);
    let mut deviator = *s;
    for entry in &mut deviator[..3] {
        *entry = *entry - mean;
    }
    (mean, deviator)
}

/// The second invariant of a deviator, s : s / 2.
#[inline(always)]
pub(super) fn second_invariant<L: Lanes, const D: usize>(s: &[L; 6]) -> L {
    let half = L::splat(0.5);
    let mut sum = half * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    for entry in &s[3..components(D)] {
        sum = entry.mul_add(*entry, sum);
    }
    sum
}
