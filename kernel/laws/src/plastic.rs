//! Plastic laws: an elastic trial stress, its return to the yield surface, and the plastic work of the return.
//!
//! The elastic increment of Hughes and Winget gives a trial stress; a law returns it to its yield surface by the implicit
//! (backward Euler) rule, sigma = sigma_trial - C : de_p. A particle that does not yield keeps the bits of the trial stress.

use super::gap::{self, TensionApex};
use super::linear_elastic::strain;
use super::tensor::components;
use super::{
    Constant, ConstantDefault, Curve, Increment, InvalidConstant, Isotropic, Law, LinearElastic,
    Rows, Stress,
};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;
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
    accepted: super::ConstantRange::NotNegative,
    given: ConstantDefault::Or(0.0),
};

/// The stress after a return to a yield surface.
#[derive(Clone, Copy, Debug)]
pub struct ReturnedStress<L: Lanes> {
    /// The stress that the trial stress returns to, ordered as a law is given a stress \[Pa\].
    pub stress: [L; 6],
    /// The lanes that yield.
    pub yields: L::Mask,
    /// The part of the plastic volume strain that opens a gap: not negative, and zero for a law that does not part.
    pub opened: L,
}

/// A yield surface. The macro [`yielding_law`](crate::yielding_law) makes a [`Law`] of a type that has it: elastic until its
/// trial stress lies beyond the surface.
pub trait YieldSurface: fmt::Debug + PartialEq + Send + Sync + 'static {
    /// See [`Law::CONSTANTS`].
    const CONSTANTS: &'static [Constant];

    /// See [`Law::CURVES`].
    const CURVES: &'static [Curve] = &[];

    /// See [`Law::VARIABLES`]. The first three are the plastic strain, the plastic work and the algorithmic work ([`STRAIN`],
    /// [`WORK`], [`ALGORITHMIC`]).
    const VARIABLES: &'static [Variable] = &[STRAIN, WORK, ALGORITHMIC];

    /// Index of the plastic volume strain among them ([`VOLUME_STRAIN`]), that of the gap included.
    const VOLUME: Option<usize> = None;

    /// Index of the gap among them ([`GAP`](super::GAP)), for a law that parts where it would bear too much tension.
    const GAP: Option<usize> = None;

    /// See [`Law::name`].
    fn name(&self) -> &'static str;

    /// See [`Law::values`].
    fn values(&self) -> Vec<f64>;

    /// See [`Law::curves`].
    fn curves(&self) -> Vec<Rows> {
        vec![]
    }

    /// See [`Law::problems`].
    fn problems(&self) -> Vec<InvalidConstant>;

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

    /// Lets the stress before the first step set internal variables. Must be `#[inline(always)]`.
    #[inline(always)]
    fn begin<L: Lanes, const D: usize>(&self, _stress: &[L; 6], _variables: &mut [L]) {}

    /// The stress that the trial stress returns to: `None` where no lane yields. `trial` is ordered as a law is given a
    /// stress; `variables` are those before the step. Must be `#[inline(always)]`.
    fn returned<L: Lanes, const D: usize>(
        &self,
        trial: &[L; 6],
        variables: &[L],
    ) -> Option<ReturnedStress<L>>;

    /// The end of the surface on the side of tension, for a law with a [`YieldSurface::GAP`]. Must be `#[inline(always)]`.
    fn tip<L: Lanes>(&self, _variables: &[L]) -> TensionApex<L> {
        TensionApex {
            tension: L::splat(0.0),
            radius: L::splat(0.0),
        }
    }
}

/// Makes a type with a yield surface ([`YieldSurface`]) a [`Law`].
///
/// Elastic until the trial stress lies beyond the surface, and then as [`update`] returns it.
#[macro_export]
macro_rules! yielding_law {
    ($law:ty) => {
        impl $crate::Law for $law {
            const CONSTANTS: &'static [$crate::Constant] =
                <Self as $crate::YieldSurface>::CONSTANTS;
            const CURVES: &'static [$crate::Curve] = <Self as $crate::YieldSurface>::CURVES;
            const VARIABLES: &'static [$crate::kernel::layout::Variable] =
                <Self as $crate::YieldSurface>::VARIABLES;
            const YIELDS: bool = true;

            $crate::compiled_here!();

            fn name(&self) -> &'static str {
                $crate::YieldSurface::name(self)
            }

            fn values(&self) -> Vec<f64> {
                $crate::YieldSurface::values(self)
            }

            fn curves(&self) -> Vec<$crate::Rows> {
                $crate::YieldSurface::curves(self)
            }

            fn problems(&self) -> Vec<$crate::InvalidConstant> {
                $crate::YieldSurface::problems(self)
            }

            fn warnings(&self) -> Vec<String> {
                $crate::YieldSurface::warnings(self)
            }

            fn in_cells(&self, cell: f64) -> Option<Self> {
                $crate::YieldSurface::in_cells(self, cell)
            }

            fn young(&self) -> f64 {
                $crate::Law::young($crate::YieldSurface::elastic(self))
            }

            fn wave_speed(&self, density: f64) -> f64 {
                $crate::Law::wave_speed($crate::YieldSurface::elastic(self), density)
            }

            fn parts(&self) -> bool {
                <Self as $crate::YieldSurface>::GAP.is_some()
            }

            #[inline(always)]
            fn update<L: $crate::kernel::lanes::Lanes, const D: usize>(
                &self,
                increment: &$crate::Increment<L>,
                stress: &mut $crate::Stress<L, D>,
                variables: &mut [L],
            ) -> L {
                $crate::plastic::update::<Self, L, D>(self, increment, stress, variables)
            }

            #[inline]
            fn energy(&self, particle: &$crate::Particle<'_>) -> f64 {
                $crate::Law::energy($crate::YieldSurface::elastic(self), particle)
            }

            /// The plastic work.
            fn dissipated(&self, particle: &$crate::Particle<'_>) -> f64 {
                particle.variables[1] * particle.mass / particle.density
            }

            fn algorithmic(&self, particle: &$crate::Particle<'_>) -> f64 {
                particle.variables[2] * particle.mass / particle.density
            }
        }
    };
}

/// Stress and internal variables of a law with a yield surface after a strain increment: see [`Law::update`]. Returns the square of the
/// elastic wave speed, which is the fastest; of a material that has parted that of the volume at which
/// its gap closes.
#[inline(always)]
pub fn update<Y: YieldSurface, L: Lanes, const D: usize>(
    law: &Y,
    increment: &Increment<L>,
    stress: &mut Stress<L, D>,
    variables: &mut [L],
) -> L {
    let zero = L::splat(0.0);
    let elasticity = law.elastic().elasticity();
    law.begin::<L, D>(stress.packed(), variables);
    let mut speed_squared = law.elastic().update::<L, D>(increment, stress, &mut []);
    let stress = stress.packed_mut();
    let begins_parted = parted::<L, Y>(variables);
    let (mut closed, mut before) = (zero, zero);
    if let (true, Some(gap)) = (begins_parted, Y::GAP) {
        before = (stress[0] + stress[1] + stress[2]) * L::splat(1.0 / 3.0);
        closed = gap::close(stress, variables[gap], elasticity.bulk());
        variables[gap] = variables[gap] - closed;
    }
    let mut returned = law.returned::<L, D>(stress, variables);
    if let (true, Some(gap)) = (begins_parted, Y::GAP) {
        returned = Some(opened::<L, Y, D>(law, stress, variables, gap, returned));
    }
    let volume = increment.volume / increment.mass * L::splat(increment.density);
    if let Some(ReturnedStress {
        stress: mut after,
        yields,
        mut opened,
    }) = returned
    {
        let tau = law.relaxation();
        if tau > 0.0 {
            // Implicit in time: sigma = (sigma_trial + (dt/tau) sigma_returned)/(1 + dt/tau).
            let share = L::splat(increment.dt / (tau + increment.dt));
            opened = share * opened;
            for slot in 0..components(D) {
                after[slot] = share.mul_add(after[slot] - stress[slot], stress[slot]);
            }
        }
        let mut strain = strain::<L, D>(increment);
        if begins_parted {
            // The strain without that of the gap that closed.
            for entry in &mut strain[..3] {
                *entry = closed.mul_add(L::splat(1.0 / 3.0), *entry);
            }
        }
        let way = way_back::<L, D>(&elasticity, stress, &after, &strain);
        variables[0] = variables[0] + L::select(yields, way.strain, zero);
        variables[1] = variables[1] + L::select(yields, way.work * volume, zero);
        variables[2] = variables[2] + L::select(yields, way.algorithmic * volume, zero);
        if let Some(dilation) = Y::VOLUME {
            variables[dilation] = variables[dilation] + L::select(yields, way.dilation, zero);
        }
        if let Some(gap) = Y::GAP {
            // Shear of what is afloat is no flow along the surface: all of its volume is that of the gap.
            let afloat = zero.lt(variables[gap]);
            let more = L::select(afloat, way.dilation.max(-variables[gap]), opened);
            variables[gap] = variables[gap] + L::select(yields, more, zero);
        }
        for slot in 0..components(D) {
            stress[slot] = L::select(yields, after[slot], stress[slot]);
        }
    }
    if begins_parted {
        // A gap closes under no pressure: nothing is dissipated, and the trapezoidal work of its strain is algorithmic.
        let e = strain::<L, D>(increment);
        let trace = e[0] + e[1] + e[2];
        let turned = before - L::splat(elasticity.bulk()) * trace;
        let after = (stress[0] + stress[1] + stress[2]) * L::splat(1.0 / 3.0);
        let work = L::splat(0.5) * closed * (turned + after) * volume;
        variables[2] = variables[2] - work;
        if let Some(dilation) = Y::VOLUME {
            variables[dilation] = variables[dilation] - closed;
        }
    }
    if let (true, Some(gap)) = (parted::<L, Y>(variables), Y::GAP) {
        let confined = elasticity.lambda + 2.0 * elasticity.shear;
        let at_rest = speed_squared.min(L::splat(confined / increment.density));
        speed_squared = L::select(zero.lt(variables[gap]), at_rest, speed_squared);
    }
    speed_squared
}

/// True if a gap of a group is open.
#[inline(always)]
fn parted<L: Lanes, Y: YieldSurface>(variables: &[L]) -> bool {
    match Y::GAP {
        Some(gap) => L::bits(L::splat(0.0).lt(variables[gap])) != 0,
        None => false,
    }
}

/// The return of a group in which gaps were open: lanes whose gap still is carry what the tip does, others return as they
/// would.
#[inline(always)]
fn opened<L: Lanes, Y: YieldSurface, const D: usize>(
    law: &Y,
    trial: &[L; 6],
    variables: &[L],
    gap: usize,
    returned: Option<ReturnedStress<L>>,
) -> ReturnedStress<L> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let afloat = zero.lt(variables[gap]);
    let mut stress = gap::carried::<L, D>(trial, &law.tip(variables));
    let (mut yields, mut opened) = (afloat, zero);
    if let Some(otherwise) = returned {
        for slot in 0..components(D) {
            stress[slot] = L::select(afloat, stress[slot], otherwise.stress[slot]);
        }
        let either = L::select(otherwise.yields, one, zero) + L::select(afloat, one, zero);
        yields = zero.lt(either);
        opened = otherwise.opened;
    }
    ReturnedStress {
        stress,
        yields,
        opened,
    }
}

/// Path from a trial stress to the stress after the return.
struct ReturnPath<L> {
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
) -> ReturnPath<L> {
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
    ReturnPath {
        strain: square.sqrt() * L::splat((2.0_f64 / 3.0).sqrt() / (2.0 * shear)),
        work: product.mul_add(L::splat(1.0 / (2.0 * shear)), mean * dilation),
        algorithmic: L::splat(0.5) * (undone - whole),
        dilation,
    }
}
