//! A fluid that is under pressure at the start.
//!
//! The density of a scene is that of the body as it lies there: mass is density times volume. The pressure of a fluid follows
//! from its volume; so each particle remembers the volume that it has without pressure, and its law sees that volume as the
//! one at the start.

use super::{Constant, Increment, Law, Particle, Stress, UNPRESSED};
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Work that viscosity has dissipated, per initial volume.
pub(super) const VISCOUS_WORK: Variable = Variable::scalar("viscous work", "J/m³");

/// A fluid whose particles have a pressure at the start. Its one variable is the viscous work.
#[derive(Clone, Debug, PartialEq)]
pub struct PressurizedFluid<F>(pub F);

/// Index of the variable [`UNPRESSED`].
const PLACE: usize = 1;

impl<F: Law> PressurizedFluid<F> {
    /// The particle as the law of the fluid sees it: with the mass that would fill the volume without pressure at the density
    /// of the scene.
    fn unpressed<'a>(particle: &Particle<'a>) -> Particle<'a> {
        Particle {
            mass: particle.mass * particle.variables[PLACE],
            ..*particle
        }
    }
}

impl<F: Law> Law for PressurizedFluid<F> {
    const CONSTANTS: &'static [Constant] = F::CONSTANTS;
    const VARIABLES: &'static [Variable] = &[VISCOUS_WORK, UNPRESSED];

    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn values(&self) -> Vec<f64> {
        self.0.values()
    }

    fn young(&self) -> f64 {
        self.0.young()
    }

    fn wave_speed(&self, density: f64) -> f64 {
        self.0.wave_speed(density)
    }

    fn shear_wave_speed(&self, density: f64) -> f64 {
        self.0.shear_wave_speed(density)
    }

    fn viscosity(&self) -> f64 {
        self.0.viscosity()
    }

    fn parts(&self) -> bool {
        self.0.parts()
    }

    fn initial_volume_ratio(&self, mean_stress: f64) -> f64 {
        self.0.initial_volume_ratio(mean_stress)
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let unpressed = variables[PLACE];
        let increment = Increment {
            mass: increment.mass * unpressed,
            ..*increment
        };
        let own = &mut variables[..PLACE];
        // A wave speed is that of the mass that there is.
        unpressed * self.0.update::<L, D>(&increment, stress, own)
    }

    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.0.energy(&Self::unpressed(particle))
    }

    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        self.0.dissipated(&Self::unpressed(particle))
    }
}
