//! Constitutive laws: stress and internal variables after a strain increment, wave speeds, energies.
//!
//! A law is a type with the trait [`Law`], written once for all lanes and dimensions. The cycle knows it as [`AnyLaw`] and
//! names none: those that scene files name are in the package `proctor-laws`, and implement the trait as a program's own do.

mod any;
mod constants;
mod stored_particle;
mod strain;
mod stress;
pub mod tensor;

pub use any::AnyLaw;
pub use constants::{Constant, ConstantDefault, ConstantRange, Curve, InvalidConstant, Rows};
pub use stored_particle::StoredParticle;
pub use strain::{BLOCK, Block, BlockStrain, Gradients, Strain};
pub(crate) use strain::{HOOP, MOST_LANES};
pub use stress::{Component, Stress};

use crate::lanes::Lanes;
use crate::layout::Variable;
use std::fmt;
use tensor::{Configuration, Matrix};

/// Volume without pressure over the volume at the start: the variable of a law that is pressed at the start ([`Law::pressed`]).
pub const UNPRESSED: Variable = Variable {
    initial: 1.0,
    ..Variable::scalar("volume without pressure", "")
};

/// A constitutive law.
///
/// It is asked once per step for groups of particles in lanes, each lane for itself; so it must do the same operations
/// whatever the values, and choose between results with [`Lanes::select`]. Then its bits do not depend on the machine.
pub trait Law: fmt::Debug + PartialEq + Send + Sync + 'static {
    /// Its constants, in the order of [`Law::values`]; a scene whose values are not accepted is refused.
    const CONSTANTS: &'static [Constant] = &[];

    /// Curves that it may be given, in the order of [`Law::curves`].
    const CURVES: &'static [Curve] = &[];

    /// Internal variables that each particle carries. Layout, sort, checkpoint, frames, probes and plan know them from here;
    /// no two may have the same name.
    const VARIABLES: &'static [Variable] = &[];

    /// True if it has a yield surface, so that the work of its strain is stored, plastic or algorithmic.
    const YIELDS: bool = false;

    /// True if the stress follows from the deformation gradient, not from the stress before. Such a law is given F and J = det
    /// F but no stress, and volumes are V_0 J; any other is given the stress before, and must not use F.
    const NEEDS_DEFORMATION: bool = false;

    /// Name in plans and messages.
    fn name(&self) -> &'static str;

    /// Values of the constants.
    fn values(&self) -> Vec<f64> {
        vec![]
    }

    /// Rows of [`Law::CURVES`], each without any where it is not given.
    fn curves(&self) -> Vec<Rows> {
        vec![]
    }

    /// Combinations of its constants that are refused; each constant by itself is accepted.
    fn problems(&self) -> Vec<InvalidConstant> {
        vec![]
    }

    /// Warnings of constants that run but may give a poor result, each a sentence.
    fn warnings(&self) -> Vec<String> {
        vec![]
    }

    /// The law in cells of that size \[m\], where softening gathers in a band of a given width.
    fn in_cells(&self, _cell: f64) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Young's modulus at rest \[Pa\]: the scale of stiffness, of viscous damping for one.
    fn young(&self) -> f64;

    /// Speed of the fastest wave at rest \[m/s\] for an initial density \[kg/m³\]. The first time step depends on it.
    fn wave_speed(&self, density: f64) -> f64;

    /// Speed of a wave of shear at rest \[m/s\] for an initial density \[kg/m³\], on which absorbing planes depend. It follows from
    /// Young's modulus and the speed of the fastest wave where the law is isotropic; a fluid has none.
    fn shear_wave_speed(&self, density: f64) -> f64 {
        shear_wave_speed(self.young(), self.wave_speed(density), density)
    }

    /// Longitudinal viscosity \[Pa s\], 4 mu/3, of a stress that follows the rate of deformation at once; the time step
    /// depends on it.
    fn viscosity(&self) -> f64 {
        0.0
    }

    /// Volume over the volume without stress, under a mean stress at the start \[Pa\]: 1 where the stress of the start is
    /// remembered and does not follow from the volume.
    fn initial_volume_ratio(&self, _mean_stress: f64) -> f64 {
        1.0
    }

    /// The law of a body that has a stress at the start, for one whose stress follows from the volume: it remembers the volume
    /// that each particle has without pressure ([`UNPRESSED`]). Particles of a law without one weigh what is pressed into them.
    fn pressed(&self) -> Option<AnyLaw> {
        None
    }

    /// Strains up to which it may be taken for a law with an energy; `None` for one that has an energy at any strain.
    fn strain_range(&self) -> Option<StrainRange> {
        None
    }

    /// True if it parts where it would be in tension, and carries nothing then, however far its volume grows: nothing of it
    /// stiffens as it does.
    fn parts(&self) -> bool {
        false
    }

    /// Stress and internal variables after a strain increment; returns the square of the speed of the fastest wave
    /// \[m²/s²\], on which the next time step depends. Must be `#[inline(always)]`.
    ///
    /// A component of `stress` has the same name in the plane and in space: `stress[Component::XY]` is the in-plane shear.
    /// `variables` are the components of [`Law::VARIABLES`] one after the other.
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L;

    /// Energy stored in a particle \[J\].
    fn energy(&self, particle: &Particle<'_>) -> f64;

    /// Energy that has been dissipated in a particle so far \[J\].
    fn dissipated(&self, _particle: &Particle<'_>) -> f64 {
        0.0
    }

    /// The law as one of any type. A law that writes `AnyLaw::new(self)` here itself, in a function that is not inlined, is compiled for
    /// all lanes in its own package alone; by default it is compiled again in each package that makes one.
    fn into_any(self) -> AnyLaw
    where
        Self: Sized,
    {
        AnyLaw::new(self)
    }

    /// Work of the strain so far that is neither stored nor dissipated \[J\], for a law that yields: the trapezoidal work of a
    /// step, (sigma_n + sigma)/2 : de with sigma_n turned, is what it stores, what it dissipates, sigma : de_p, and
    /// (sigma_n - sigma)/2 : de_p, which is of the order of the step.
    fn algorithmic(&self, _particle: &Particle<'_>) -> f64 {
        0.0
    }
}

/// Speed of a wave of shear \[m/s\] in an isotropic elastic solid, from Young's modulus \[Pa\], the speed of compression \[m/s\]
/// and the density \[kg/m³\]: k = (lambda + 2 mu)/E gives Poisson's ratio, the positive root of k (1 + nu)(1 - 2 nu) = 1 - nu.
fn shear_wave_speed(young: f64, compression: f64, density: f64) -> f64 {
    let k = density * compression * compression / young;
    let over = (k - 1.0).max(0.0);
    let poisson = ((over * over + 8.0 * k * over).sqrt() - over) / (4.0 * k);
    (young / (2.0 * (1.0 + poisson) * density)).sqrt()
}

/// Strains up to which a law without an energy may be taken for one with an energy, with the words of warnings beyond.
#[derive(Clone, Copy, Debug)]
pub struct StrainRange {
    /// Largest |J - 1|.
    pub most_volume_change: f64,
    /// The share by which the strain energy of a pure change of volume is off, as a function of J.
    pub energy_error: fn(f64) -> f64,
    /// Name of the law in scene files.
    pub law: &'static str,
    /// Laws that have an energy at any strain: "`a` and `b` have an energy at any strain".
    pub instead: &'static str,
    /// The law as the cause of energy that is missing or came from nowhere, with what to do.
    pub cause: &'static str,
}

impl PartialEq for StrainRange {
    /// Ranges of laws of one name.
    fn eq(&self, other: &Self) -> bool {
        self.law == other.law && self.most_volume_change == other.most_volume_change
    }
}

impl StrainRange {
    /// True for a change of volume J - 1 beyond the range.
    #[must_use]
    pub fn is_exceeded(&self, volume_change: f64) -> bool {
        volume_change.abs() > self.most_volume_change
    }
}

/// Input of a law in a step, in lanes.
#[derive(Clone, Copy, Debug)]
pub struct Increment<L> {
    /// Velocity gradient times time step, G = dt L; the leading D x D block counts.
    pub gradient: Matrix<L>,
    /// Configuration of its gradient: the positions at the beginning or the end of the step.
    pub configuration: Configuration,
    /// Time step \[s\].
    pub dt: f64,
    /// Deformation gradient after the step, and its determinant; see [`Law::NEEDS_DEFORMATION`].
    pub deformation: Matrix<L>,
    /// J.
    pub jacobian: L,
    /// Mass \[kg\].
    pub mass: L,
    /// Volume after the step \[m³\].
    pub volume: L,
    /// Initial density of the material \[kg/m³\].
    pub density: f64,
}

/// The deformation gradient of a particle that has not deformed.
pub const UNDEFORMED: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The state of one particle, for its energy.
#[derive(Clone, Copy, Debug)]
pub struct Particle<'a> {
    /// Mass \[kg\].
    pub mass: f64,
    /// Volume \[m³\].
    pub volume: f64,
    /// Initial density of the material \[kg/m³\].
    pub density: f64,
    /// Cauchy stress \[Pa\]: xx, yy, zz, yz, xz, xy.
    pub stress: [f64; 6],
    /// Deformation gradient; 1 where it is not kept.
    pub deformation: [[f64; 3]; 3],
    /// Internal variables.
    pub variables: &'a [f64],
}
