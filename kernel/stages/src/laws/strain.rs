//! The strain increment of a block of particles: deformation, volume, stress and internal variables; compiled for all
//! lanes from one [`Law`].

use super::tensor::{
    Configuration, Matrix, determinant, product, relative_deformation, volume_ratio,
};
use super::{
    Constant, Curve, Increment, InvalidConstant, Law, Particle, Rows, StoredParticle, StrainRange,
    Stress,
};
use crate::lanes::{Backend, Kernel, Lanes, SelectedLanes, load, store};
use crate::layout::{Layout, Variable};
use std::any::Any;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Particles whose velocity gradients are gathered before their law is asked: few enough for the fastest cache.
pub const BLOCK: usize = 64;
/// Most components of internal variables that a law may have.
pub(super) const MOST_VARIABLES: usize = 16;

/// Component of [`Gradients`] that is the hoop strain rate where the first of two axes is a radius.
pub(crate) const HOOP: usize = 4;

/// Velocity gradients of a block \[1/s\]: component D a + b of particle i at `[D * a + b][i]`, and that around
/// the axis of revolution at `[4][i]`. A whole group of
/// lanes may be written behind the last particle.
pub struct Gradients(pub [[f64; BLOCK + MOST_LANES]; 9]);

/// The widest group.
pub(crate) const MOST_LANES: usize = 8;

impl Gradients {
    /// All zero.
    #[inline(always)]
    #[must_use]
    pub fn zero() -> Self {
        Self([[0.0; BLOCK + MOST_LANES]; 9])
    }

    /// Columns of a group that begins at particle `at` of the block.
    #[inline(always)]
    #[must_use]
    pub(crate) fn load<L: Lanes, const D: usize>(&self, at: usize) -> Matrix<L> {
        // One bound for all components.
        let at = at.min(BLOCK);
        let mut gradient = [[L::splat(0.0); 3]; 3];
        for a in 0..D {
            for b in 0..D {
                gradient[a][b] = L::load(&self.0[D * a + b][at..at + MOST_LANES]);
            }
        }
        gradient
    }
}

/// Particles of one body, and how fast they deform.
pub struct Block<'a, 'b> {
    /// Columns of the particles of the call.
    pub columns: &'a mut [&'b mut [f64]],
    /// Layout of the columns.
    pub layout: &'a Layout,
    /// The block among these particles.
    pub range: Range<usize>,
    /// Velocity gradients.
    pub gradients: &'a Gradients,
    /// Time step \[s\].
    pub dt: f64,
    /// Configuration of the gradients: the positions at the beginning or the end of the step.
    pub configuration: Configuration,
    /// Initial density \[kg/m³\].
    pub density: f64,
    /// True if volumes are V_0 det F although the law has no use for F.
    pub volume_of_deformation: bool,
}

/// Findings in a block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlockStrain {
    /// Largest square of a wave speed \[m²/s²\].
    pub speed_squared: f64,
    /// Largest |dt grad v|² of a particle.
    pub increment_squared: f64,
    /// First particle of the call whose volume is not positive, or whose stress or internal variables are not finite.
    pub fault: Option<usize>,
}

/// Interface of the cycle to a [`Law`] of a type that it does not know. Every law has it.
pub trait Strain: Any + fmt::Debug + Send + Sync {
    /// See [`Law::name`].
    fn name(&self) -> &'static str;
    /// See [`Law::CONSTANTS`].
    fn constants(&self) -> Vec<(Constant, f64)>;
    /// See [`Law::CURVES`].
    fn curves(&self) -> Vec<(Curve, Rows)>;
    /// See [`Law::VARIABLES`].
    fn variables(&self) -> &'static [Variable];
    /// See [`Law::YIELDS`].
    fn yields(&self) -> bool;
    /// See [`Law::NEEDS_DEFORMATION`].
    fn needs_deformation(&self) -> bool;
    /// See [`Law::problems`].
    fn problems(&self) -> Vec<InvalidConstant>;
    /// See [`Law::warnings`].
    fn warnings(&self) -> Vec<String>;
    /// See [`Law::in_cells`].
    fn in_cells(&self, cell: f64) -> Option<Arc<dyn Strain>>;
    /// See [`Law::young`].
    fn young(&self) -> f64;
    /// See [`Law::wave_speed`].
    fn wave_speed(&self, density: f64) -> f64;
    /// See [`Law::shear_wave_speed`].
    fn shear_wave_speed(&self, density: f64) -> f64;
    /// See [`Law::viscosity`].
    fn viscosity(&self) -> f64;
    /// See [`Law::initial_volume_ratio`].
    fn initial_volume_ratio(&self, mean_stress: f64) -> f64;
    /// See [`Law::pressed`].
    fn pressed(&self) -> Option<Arc<dyn Strain>>;
    /// See [`Law::strain_range`].
    fn strain_range(&self) -> Option<StrainRange>;
    /// See [`Law::parts`].
    fn parts(&self) -> bool;
    /// See [`Law::energy`].
    fn energy(&self, particle: &Particle<'_>) -> f64;
    /// The same of a particle where it is stored.
    fn energy_of(&self, particle: &StoredParticle<'_>) -> f64;
    /// See [`Law::dissipated`].
    fn dissipated(&self, particle: &Particle<'_>) -> f64;
    /// See [`Law::algorithmic`].
    fn algorithmic(&self, particle: &Particle<'_>) -> f64;
    /// Square of the speed of the fastest wave of a particle at rest \[m²/s²\].
    fn speed_squared(&self, particle: &Particle<'_>) -> f64;
    /// True if another law is the same.
    fn equals(&self, other: &dyn Strain) -> bool;
    /// Strains a block of particles.
    fn strain(&self, lanes: SelectedLanes, block: Block<'_, '_>) -> BlockStrain;
}

impl<M: Law> Strain for M {
    fn name(&self) -> &'static str {
        Law::name(self)
    }
    fn constants(&self) -> Vec<(Constant, f64)> {
        M::CONSTANTS.iter().copied().zip(self.values()).collect()
    }
    fn curves(&self) -> Vec<(Curve, Rows)> {
        M::CURVES.iter().copied().zip(Law::curves(self)).collect()
    }
    fn variables(&self) -> &'static [Variable] {
        M::VARIABLES
    }
    fn yields(&self) -> bool {
        M::YIELDS
    }
    fn needs_deformation(&self) -> bool {
        M::NEEDS_DEFORMATION
    }
    fn problems(&self) -> Vec<InvalidConstant> {
        Law::problems(self)
    }
    fn warnings(&self) -> Vec<String> {
        Law::warnings(self)
    }
    fn in_cells(&self, cell: f64) -> Option<Arc<dyn Strain>> {
        let law = Law::in_cells(self, cell)?;
        Some(Arc::new(law))
    }
    fn young(&self) -> f64 {
        Law::young(self)
    }
    fn wave_speed(&self, density: f64) -> f64 {
        Law::wave_speed(self, density)
    }
    fn shear_wave_speed(&self, density: f64) -> f64 {
        Law::shear_wave_speed(self, density)
    }
    fn viscosity(&self) -> f64 {
        Law::viscosity(self)
    }
    fn initial_volume_ratio(&self, mean_stress: f64) -> f64 {
        Law::initial_volume_ratio(self, mean_stress)
    }
    fn pressed(&self) -> Option<Arc<dyn Strain>> {
        let law = Law::pressed(self)?;
        Some(law.into_strain())
    }
    fn strain_range(&self) -> Option<StrainRange> {
        Law::strain_range(self)
    }
    fn parts(&self) -> bool {
        Law::parts(self)
    }
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        Law::energy(self, particle)
    }
    fn energy_of(&self, particle: &StoredParticle<'_>) -> f64 {
        particle.ask(|particle| Law::energy(self, particle))
    }
    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        Law::dissipated(self, particle)
    }
    fn algorithmic(&self, particle: &Particle<'_>) -> f64 {
        Law::algorithmic(self, particle)
    }
    fn speed_squared(&self, particle: &Particle<'_>) -> f64 {
        SelectedLanes::any().run(RestWaveSpeed(self, particle))
    }
    fn equals(&self, other: &dyn Strain) -> bool {
        let other: &dyn Any = other;
        other.downcast_ref() == Some(self)
    }
    fn strain(&self, lanes: SelectedLanes, block: Block<'_, '_>) -> BlockStrain {
        match (block.layout.axes, block.layout.axisymmetric) {
            (2, false) => lanes.run(StrainKernel::<M, 2, 2>(self, block)),
            (2, true) => lanes.run(StrainKernel::<M, 2, 3>(self, block)),
            _ => lanes.run(StrainKernel::<M, 3, 3>(self, block)),
        }
    }
}

/// The wave speed of one particle that does not strain.
struct RestWaveSpeed<'a, M>(&'a M, &'a Particle<'a>);

impl<M: Law> Kernel for RestWaveSpeed<'_, M> {
    type Output = f64;

    #[inline(always)]
    fn run<B: Backend>(self) -> f64 {
        let Self(law, particle) = self;
        let zero = B::Native::splat(0.0);
        // Loops, not `map`, which the compiler may leave as a call, and with it each `splat`.
        let mut deformation = [[zero; 3]; 3];
        for (row, given) in deformation.iter_mut().zip(&particle.deformation) {
            for (value, given) in row.iter_mut().zip(given) {
                *value = B::Native::splat(*given);
            }
        }
        let mut stress = Stress::of_packed([zero; 6]);
        for (value, given) in stress.packed_mut().iter_mut().zip(&particle.stress) {
            *value = B::Native::splat(*given);
        }
        let mut variables = [zero; MOST_VARIABLES];
        for (value, given) in variables.iter_mut().zip(particle.variables) {
            *value = B::Native::splat(*given);
        }
        let increment = Increment {
            gradient: [[zero; 3]; 3],
            configuration: Configuration::Beginning,
            dt: 0.0,
            deformation,
            jacobian: determinant::<B::Native, 3>(&deformation),
            mass: B::Native::splat(particle.mass),
            volume: B::Native::splat(particle.volume),
            density: particle.density,
        };
        let count = const { components(M::VARIABLES) };
        let speed_squared =
            law.update::<B::Native, 3>(&increment, &mut stress, &mut variables[..count]);
        let mut all = [0.0; 8];
        speed_squared.store(&mut all);
        all[0]
    }
}

/// Number of components of internal variables.
const fn components(variables: &[Variable]) -> usize {
    let (mut count, mut i) = (0, 0);
    while i < variables.len() {
        count += variables[i].components;
        i += 1;
    }
    assert!(
        count <= MOST_VARIABLES,
        "a law has too many internal variables"
    );
    count
}

/// The strain of a block as a kernel, for laws of one type: particles keep `D` axes, the law has `E`. Three of a law and two of
/// particles are radius, height and hoop.
struct StrainKernel<'a, 'b, 'm, M, const D: usize, const E: usize>(pub &'m M, pub Block<'a, 'b>);

impl<M: Law, const D: usize, const E: usize> Kernel for StrainKernel<'_, '_, '_, M, D, E> {
    type Output = BlockStrain;

    #[inline(always)]
    fn run<B: Backend>(self) -> BlockStrain {
        let Self(law, mut block) = self;
        let mut most = [B::Native::splat(0.0); 2];
        let mut fault = None;
        let mut at = block.range.start;
        while at < block.range.end {
            let count = (block.range.end - at).min(B::Native::WIDTH);
            // Written twice, so that nothing is masked in full groups.
            let bad = if count == B::Native::WIDTH {
                group::<B::Native, M, D, E>(law, &mut block, at, B::Native::WIDTH, &mut most)
            } else {
                group::<B::Native, M, D, E>(law, &mut block, at, count, &mut most)
            };
            if bad != 0 && fault.is_none() {
                fault = Some(at + bad.trailing_zeros() as usize);
            }
            at += count;
        }
        BlockStrain {
            speed_squared: most[0].largest(),
            increment_squared: most[1].largest(),
            fault,
        }
    }
}

/// Strains the particles of one group of lanes; returns the lanes that went wrong.
#[inline(always)]
fn group<L: Lanes, M: Law, const D: usize, const E: usize>(
    law: &M,
    block: &mut Block<'_, '_>,
    at: usize,
    count: usize,
    most: &mut [L; 2],
) -> u32 {
    let zero = L::splat(0.0);
    let live = L::first(count);
    let dt = L::splat(block.dt);
    let configuration = block.configuration;
    let mut gradient = block.gradients.load::<L, D>(at - block.range.start);
    let mut square = zero;
    for a in 0..D {
        for b in 0..D {
            gradient[a][b] = gradient[a][b] * dt;
            square = gradient[a][b].mul_add(gradient[a][b], square);
        }
    }
    let axisymmetric = D < E;
    if axisymmetric {
        let at = (at - block.range.start).min(BLOCK);
        let hoop = L::load(&block.gradients.0[HOOP][at..at + MOST_LANES]) * dt;
        gradient[2][2] = hoop;
        square = hoop.mul_add(hoop, square);
    }
    most[1] = most[1].max(L::select(live, square, zero));
    let mass: L = load(block.columns[Layout::MASS], at, count);
    let mut deformation = [[zero; 3]; 3];
    let mut jacobian = L::splat(1.0);
    if let Some(first) = block.layout.deformation {
        deformation = deform::<L, D>(block.columns, first, at, count, &gradient, configuration);
        jacobian = determinant::<L, D>(&deformation);
        if axisymmetric {
            let column = &mut *block.columns[first + D * D];
            let hoop = hoop_ratio(gradient[2][2], configuration) * load(column, at, count);
            store(hoop, column, at, count);
            deformation[2][2] = hoop;
            jacobian = jacobian * hoop;
        }
    }
    // Where F has a use in the cycle the volume is V_0 det F, so that volume, density and F agree to round-off;
    // an F that is only written must not change a bit.
    let volume = if M::NEEDS_DEFORMATION || block.volume_of_deformation {
        mass * L::splat(1.0 / block.density) * jacobian
    } else {
        let volume = load::<L>(block.columns[Layout::VOLUME], at, count)
            * volume_ratio::<L, D>(&gradient, configuration);
        if axisymmetric {
            volume * hoop_ratio(gradient[2][2], configuration)
        } else {
            volume
        }
    };
    store(volume, block.columns[Layout::VOLUME], at, count);

    let components_of_stress = const { Layout::stress_components_of(D) };
    let of_stress = Layout::stress(D)..Layout::stress(D) + components_of_stress;
    let mut stress = Stress::of_packed([zero; 6]);
    if !M::NEEDS_DEFORMATION {
        let columns = &block.columns[of_stress.clone()];
        for i in 0..components_of_stress {
            stress.packed_mut()[place_of::<D, E>(i)] = load(columns[i], at, count);
        }
    }
    let count_of_variables = const { components(M::VARIABLES) };
    let mut variables = [zero; MOST_VARIABLES];
    for i in 0..count_of_variables {
        variables[i] = load(block.columns[block.layout.variables + i], at, count);
    }
    let increment = Increment {
        gradient,
        configuration,
        dt: block.dt,
        deformation,
        jacobian,
        mass,
        volume,
        density: block.density,
    };
    let speed_squared = law.update::<L, E>(
        &increment,
        &mut stress,
        &mut variables[..count_of_variables],
    );
    most[0] = most[0].max(L::select(live, speed_squared, zero));
    let mut finite = zero;
    let columns = &mut block.columns[of_stress];
    for i in 0..components_of_stress {
        let component = stress.packed()[place_of::<D, E>(i)];
        store(component, columns[i], at, count);
        finite = component.mul_add(zero, finite);
    }
    for i in 0..count_of_variables {
        store(
            variables[i],
            block.columns[block.layout.variables + i],
            at,
            count,
        );
        finite = variables[i].mul_add(zero, finite);
    }
    let good = L::bits(zero.lt(volume)) & L::bits(finite.eq(zero));
    !good & L::bits(live)
}

/// Place in the stress of a law with `E` axes of a component that particles with `D` keep: xy is the last of six in space.
#[inline(always)]
const fn place_of<const D: usize, const E: usize>(component: usize) -> usize {
    if D < E && component == 3 {
        5
    } else {
        component
    }
}

/// Hoop stretch of the step.
#[inline(always)]
fn hoop_ratio<L: Lanes>(rate: L, configuration: Configuration) -> L {
    let one = L::splat(1.0);
    match configuration {
        Configuration::Beginning => one + rate,
        Configuration::End => one / (one - rate),
    }
}

/// F after the step, f F, which is kept.
#[inline(always)]
fn deform<L: Lanes, const D: usize>(
    columns: &mut [&mut [f64]],
    first: usize,
    at: usize,
    count: usize,
    gradient: &Matrix<L>,
    configuration: Configuration,
) -> Matrix<L> {
    let mut f = [[L::splat(0.0); 3]; 3];
    for a in 0..D {
        for b in 0..D {
            f[a][b] = load(columns[first + a * D + b], at, count);
        }
    }
    f = product::<L, D>(&relative_deformation::<L, D>(gradient, configuration), &f);
    for a in 0..D {
        for b in 0..D {
            store(f[a][b], columns[first + a * D + b], at, count);
        }
    }
    f
}
