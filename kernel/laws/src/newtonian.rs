//! A weakly compressible fluid whose shear stress follows its rate of deformation.

use super::linear_elastic::strain;
use super::pressurized_fluid::VISCOUS_WORK;
use super::state::{BULK, EXPONENT, EquationOfState};
use super::tensor::components;
use super::tensor::{deviator, second_invariant};
use super::{
    AnyLaw, Choice, Constant, ConstantDefault, ConstantRange, Increment, Law, Particle,
    PressurizedFluid, Readable, Stress,
};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Viscosity.
pub(super) const VISCOSITY: Constant = Constant {
    key: "viscosity",
    meaning: "Dynamic viscosity",
    unit: "Pa s",
    accepted: ConstantRange::NotNegative,
    given: ConstantDefault::Needed,
};

/// Behaviour of a fluid that is drawn apart.
pub(super) const TENSION: Choice = Choice {
    key: "tension",
    words: &["carried", "none"],
    meaning: "Whether a fluid carries tension; one that does not parts at no pressure.",
    elsewhere: "whether a {law} material carries tension, which its strength says",
};

/// Newton's fluid: sigma = -p(J) 1 + 2 mu dev D, with D of the velocities half way between the positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newtonian {
    state: EquationOfState,
    viscosity: f64,
}

impl Newtonian {
    /// Law of a bulk modulus \[Pa\] and a viscosity \[Pa s\], with p = -K ln J, in tension too.
    #[must_use]
    pub const fn new(bulk: f64, viscosity: f64) -> Self {
        let state = EquationOfState {
            bulk,
            exponent: 0.0,
            carries_tension: true,
        };
        Self { state, viscosity }
    }

    /// The same with another pressure.
    #[must_use]
    pub const fn with_state(self, state: EquationOfState) -> Self {
        Self { state, ..self }
    }

    /// Its pressure.
    #[must_use]
    pub const fn state(&self) -> EquationOfState {
        self.state
    }
}

impl Law for Newtonian {
    const CONSTANTS: &'static [Constant] = &[BULK, VISCOSITY, EXPONENT];
    const VARIABLES: &'static [Variable] = &[VISCOUS_WORK];

    crate::compiled_here!();

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        vec![self.state.bulk, self.viscosity, self.state.exponent]
    }

    /// The bulk modulus.
    fn young(&self) -> f64 {
        self.state.bulk
    }

    fn wave_speed(&self, density: f64) -> f64 {
        self.state.sound_squared(density).sqrt()
    }

    fn shear_wave_speed(&self, _density: f64) -> f64 {
        0.0
    }

    /// 4 mu/3, of a wave along its own direction.
    fn viscosity(&self) -> f64 {
        4.0 / 3.0 * self.viscosity
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
        let stress = stress.packed_mut();
        *stress = [L::splat(0.0); 6];
        if self.viscosity > 0.0 && increment.dt > 0.0 {
            let e = strain::<L, D>(increment);
            let (_, e) = deviator::<L, D>(&e);
            let mut twice = L::splat(2.0 * self.viscosity / increment.dt);
            if !self.state.carries_tension {
                twice = twice * self.state.share(j);
            }
            for slot in 0..components(D) {
                stress[slot] = twice * e[slot];
            }
            // s : e = (4 mu/dt) J_2(e).
            let work = twice * L::splat(2.0) * second_invariant::<L, D>(&e);
            variables[0] = work.mul_add(j, variables[0]);
        }
        for entry in &mut stress[..3] {
            *entry = *entry - pressure;
        }
        slope * self.state.specific_volume(increment)
    }

    #[inline]
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        let initial = particle.mass / particle.density;
        self.state.energy_density(particle.volume / initial) * initial
    }

    /// Energy that viscosity has dissipated.
    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[0] * particle.mass / particle.density
    }
}

impl Readable for Newtonian {
    const NAME: &'static str = "newtonian";
    const MEANING: &'static str = "a weakly compressible fluid with a viscosity";
    const CHOICES: &'static [Choice] = &[TENSION];

    fn read(values: &[f64], choices: &[usize]) -> Self {
        Self::new(values[0], values[1]).with_state(EquationOfState {
            bulk: values[0],
            exponent: values[2],
            carries_tension: choices[0] == 0,
        })
    }
}
