//! A weakly compressible fluid that flows where its shear stress is above a yield stress.

use super::linear_elastic::strain;
use super::newtonian::{TENSION, VISCOSITY};
use super::pressurized_fluid::VISCOUS_WORK;
use super::state::{BULK, EXPONENT, EquationOfState};
use super::tensor::components;
use super::tensor::volume_ratio;
use super::tensor::{deviator, second_invariant};
use super::{
    AnyLaw, Choice, Constant, ConstantDefault, ConstantRange, Increment, Law, LinearElastic,
    Particle, PressurizedFluid, Readable, Stress,
};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Bingham's fluid as a visco-plastic solid without regularisation: elastic in shear with a modulus G up to
/// tau = sqrt(J_2) = tau_y, above it flowing at (tau - tau_y)/mu, implicitly in time. Steady shear at a rate g' carries
/// tau_y + mu g'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bingham {
    state: EquationOfState,
    viscosity: f64,
    yield_stress: f64,
    elastic: LinearElastic,
}

impl Bingham {
    /// Law of a bulk modulus \[Pa\], a viscosity \[Pa s\], a yield stress in shear \[Pa\] and the shear modulus \[Pa\] of the
    /// part that does not flow, with p = -K ln J, in tension too.
    #[must_use]
    pub const fn new(bulk: f64, viscosity: f64, yield_stress: f64, shear: f64) -> Self {
        let state = EquationOfState {
            bulk,
            exponent: 0.0,
            carries_tension: true,
        };
        Self {
            state,
            viscosity,
            yield_stress,
            elastic: LinearElastic::of_shear(shear),
        }
    }

    /// The same with another pressure.
    #[must_use]
    pub const fn with_state(self, state: EquationOfState) -> Self {
        Self { state, ..self }
    }

    fn shear(&self) -> f64 {
        self.elastic.elasticity().shear
    }
}

impl Law for Bingham {
    const CONSTANTS: &'static [Constant] = &[
        BULK,
        VISCOSITY,
        Constant {
            key: "yield_stress",
            meaning: "Shear stress up to which the fluid does not flow",
            unit: "Pa",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "shear",
            meaning: "Shear modulus of the fluid where it does not flow; the bulk modulus where it is not given",
            unit: "Pa",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::As("bulk"),
        },
        EXPONENT,
    ];
    const VARIABLES: &'static [Variable] = &[VISCOUS_WORK];

    crate::compiled_here!();

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        vec![
            self.state.bulk,
            self.viscosity,
            self.yield_stress,
            self.shear(),
            self.state.exponent,
        ]
    }

    /// The bulk modulus.
    fn young(&self) -> f64 {
        self.state.bulk
    }

    fn wave_speed(&self, density: f64) -> f64 {
        (self.state.sound_squared(density) + 4.0 / 3.0 * self.shear() / density).sqrt()
    }

    fn shear_wave_speed(&self, density: f64) -> f64 {
        (self.shear() / density).sqrt()
    }

    fn pressed(&self) -> Option<AnyLaw> {
        Some(PressurizedFluid(*self).into())
    }

    fn parts(&self) -> bool {
        !self.state.carries_tension
    }

    fn initial_volume_ratio(&self, mean_stress: f64) -> f64 {
        self.state.volume_ratio(mean_stress)
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let j = increment.volume / increment.mass * L::splat(increment.density);
        let (pressure, slope) = self.state.pressure(j);
        self.elastic.update::<L, D>(increment, stress, &mut []);
        let stress = stress.packed_mut();
        let (_, mut s) = deviator::<L, D>(stress);
        let mut limit = L::splat(self.yield_stress);
        let mut softness = L::splat(1.0 / self.shear());
        if !self.state.carries_tension {
            // What has parted is as stiff and as strong as its share of fluid, and carries what that share did.
            let share = self.state.share(j);
            let grown = volume_ratio::<L, D>(&increment.gradient, increment.configuration);
            let thinned = share / self.state.share(j / grown) - L::splat(1.0);
            let missing = L::splat(1.0) - share;
            let (_, e) = deviator::<L, D>(&strain::<L, D>(increment));
            for slot in 0..components(D) {
                let added = L::splat(2.0 * self.shear()) * e[slot];
                s[slot] = s[slot] + (thinned * (s[slot] - added) - missing * added);
            }
            limit = limit * share;
            softness = softness / share;
        }
        let trial = second_invariant::<L, D>(&s).sqrt();
        // The implicit rule tau = tau_trial - G dt (tau - tau_y)/mu.
        let remains = L::splat(self.viscosity / (self.viscosity + self.shear() * increment.dt));
        let beyond = trial - limit;
        let flows = limit.lt(trial);
        let after = remains.mul_add(beyond, limit);
        let ratio = L::select(flows, after / trial, L::splat(1.0));
        // s : e_v with e_v = (s_trial - s)/(2 G), and s : s = 2 tau².
        let work = after * (trial - after) * softness;
        variables[0] = L::select(flows, work, L::splat(0.0)).mul_add(j, variables[0]);
        for slot in 0..components(D) {
            stress[slot] = s[slot] * ratio;
        }
        for entry in &mut stress[..3] {
            *entry = *entry - pressure;
        }
        (slope + L::splat(4.0 / 3.0 * self.shear())) * self.state.specific_volume(increment)
    }

    #[inline]
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        let initial = particle.mass / particle.density;
        let s = &particle.stress;
        let mean = (s[0] + s[1] + s[2]) / 3.0;
        let normal: f64 = s[..3].iter().map(|x| (x - mean) * (x - mean)).sum();
        let sheared: f64 = s[3..].iter().map(|x| x * x).sum();
        let j = particle.volume / initial;
        let share = if self.state.carries_tension {
            1.0
        } else {
            1.0 / j.max(1.0)
        };
        self.state.energy_density(j) * initial
            + (normal + 2.0 * sheared) / (4.0 * share * self.shear()) * particle.volume
    }

    /// Energy that the flow has dissipated.
    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[0] * particle.mass / particle.density
    }
}

impl Readable for Bingham {
    const NAME: &'static str = "bingham";
    const MEANING: &'static str = "a fluid that flows beyond a yield stress";
    const CHOICES: &'static [Choice] = &[TENSION];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        Self::new(values[0], values[1], values[2], values[3]).with_state(EquationOfState {
            bulk: values[0],
            exponent: values[4],
            carries_tension: choices[0] == 0,
        })
    }
}
