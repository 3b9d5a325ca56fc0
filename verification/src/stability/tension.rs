//! Growth of a stressed start: a bar in uniform tension, with noise, at the step of a scene.
//!
//! The bar lies between two fixed planes, so that its stress is in balance on every mesh. Waves run at 1 m/s in cells of 1 m, and
//! velocities begin as noise that is far too small to change the stress. What a method lets grow from it (the geometric
//! stiffness of FLIP in tension, see the kernel's `simulation/tension.rs`) grows by the same factor in each step.

use std::sync::Arc;

use proctor_scene::plan::{AUTOMATIC_SHARE, ForeseenTension, foreseen_tension, stability_number};
use proctor_scene::simulation::{InitialState, Options};
use proctor_scene::{
    Dimension, Material, Mesh, PlaneCondition, Scene, StressScheme, TimeStep, Transfer,
    TransferKind, Vector,
};

use super::StabilityError;
use super::arnoldi::uniform;
use super::frozen::{fastest_wave, poisson, smallest_cell};
use super::scene::method_of;
use crate::cases::{NO_RESULTS, body, cuboid, elastic};
use crate::settings::Method;

/// Length of the bar in cells.
const LENGTH: f64 = 8.0;
/// Thickness of the bar in cells, along each of the other axes.
const THICKNESS: f64 = 3.0;
/// Cells beside the bar.
const ROOM: f64 = 2.0;
/// Velocity of the noise over that of waves.
const NOISE: f64 = 1e-9;
/// Steps of a run, of which the first quarter is left out.
const STEPS: usize = 3000;
/// Kinetic energy over that of the noise at which a run ends, long before velocities change the stress.
const ENOUGH: f64 = 1e10;
/// Growth per step that a run of so many steps tells from none.
pub const LEAST_GROWTH: f64 = 3e-4;
/// Tension, over the modulus of confined strain, below which a run would not tell the growth from none: it is measured with this
/// one, and less tension makes it less in proportion. A tension like the modulus itself would be another material.
const LEAST_TENSION: f64 = 0.05;
/// Factor by which noise must grow in a run to matter: what the kernel's plan warns of.
const FACTOR: f64 = 10.0;

/// A method with its step, and the bar's resolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressedBar {
    /// Weighting function and scheme; the transfer's kind is that of `transfer`.
    pub method: Method,
    /// Transfer with its share of PIC.
    pub transfer: Transfer,
    /// Number of dimensions.
    pub dimension: Dimension,
    /// Particles per cell and axis.
    pub particles_per_cell: [usize; 3],
    /// Poisson's ratio.
    pub poisson: f64,
    /// c dt/h.
    pub courant: f64,
}

impl StressedBar {
    /// The same bar with another method, at a step that the method bears without tension.
    #[must_use]
    pub fn with_method(self, method: Method) -> Self {
        let axes = self.dimension.axes();
        let per_cell = self.particles_per_cell[..axes].iter().max().copied();
        let half_length = 0.5 / per_cell.unwrap_or(1).max(1) as f64;
        let Method {
            weighting,
            scheme,
            transfer,
        } = method;
        let bound = stability_number(weighting, scheme, transfer, half_length);
        Self {
            method,
            transfer: Transfer::new(transfer),
            courant: self.courant.min(AUTOMATIC_SHARE * bound),
            ..self
        }
    }
}

/// The tension that a scene will have, and the methods that hold it.
#[derive(Clone, Debug, PartialEq)]
pub struct TensionReport {
    /// The tension, its cause and body.
    pub foreseen: ForeseenTension,
    /// Name of the body.
    pub name: String,
    /// Growth per step of the scene's own method; 0 where it holds.
    pub growth: f64,
    /// Steps of the whole scene.
    pub steps: f64,
    /// Methods with the scene's weighting function, and their growth.
    pub others: Vec<(Method, f64)>,
}

impl TensionReport {
    /// True where noise stays small to the end of the scene.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.growth * self.steps < libm::log(FACTOR)
    }
}

/// The largest tension that a scene will have by the estimates of the kernel's plan, and its growth at a step \[s\]; `None` where
/// no body will be in tension.
///
/// # Errors
/// A step of the bar that fails.
pub fn ask(scene: &Scene, dt: f64) -> Result<Option<TensionReport>, StabilityError> {
    let all = foreseen_tension(scene).into_iter();
    let Some(foreseen) = all.max_by(|a, b| a.strain.total_cmp(&b.strain)) else {
        return Ok(None);
    };
    let body = &scene.bodies[foreseen.body];
    let own = StressedBar {
        method: method_of(scene),
        transfer: scene.transfer,
        dimension: scene.dimension,
        particles_per_cell: body.particles_per_cell,
        poisson: poisson_at_rest(&scene.materials[body.material]),
        courant: dt * fastest_wave(scene) / smallest_cell(scene),
    };
    let growth = own.growth(foreseen.strain)?;
    let mut others = vec![];
    for (scheme, transfer) in [
        (StressScheme::Usl, TransferKind::Flip),
        (StressScheme::Usl, TransferKind::Apic),
        (own.method.scheme, TransferKind::Apic),
    ] {
        let method = Method {
            scheme,
            transfer,
            ..own.method
        };
        if method != own.method && growth > 0.0 {
            let growth = own.with_method(method).growth(foreseen.strain)?;
            others.push((method, growth));
        }
    }
    others.dedup();
    Ok(Some(TensionReport {
        name: body.name.clone(),
        foreseen,
        growth,
        steps: scene.time / dt,
        others,
    }))
}

/// Poisson's ratio of a law at rest.
fn poisson_at_rest(material: &Material) -> f64 {
    let speed = material.law.wave_speed(material.density);
    poisson(material.law.young() / (material.density * speed * speed))
}

impl StressedBar {
    /// The bar: density 1 kg/m³, modulus of confined strain 1 Pa.
    fn scene(&self) -> Scene {
        let axes = self.dimension.axes();
        let across = (THICKNESS + 2.0 * ROOM) as usize;
        let mut mesh = Mesh::new(
            self.dimension,
            [0.0; 3],
            [1.0; 3],
            [LENGTH as usize, across, across],
        );
        mesh.planes[..axes].fill([PlaneCondition::Free; 2]);
        mesh.planes[0] = [PlaneCondition::Fixed; 2];
        let corner = |along: f64, beside: f64| -> Vector {
            std::array::from_fn(|axis| match axis {
                0 => along,
                _ if axis < axes => beside,
                _ => 0.0,
            })
        };
        let mut scene = Scene::new(self.dimension, mesh, 1e9);
        let nu = self.poisson;
        let young = (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu);
        scene.materials = elastic(1.0, young, nu);
        scene.bodies = vec![body(
            "bar",
            1,
            cuboid(corner(0.0, ROOM), corner(LENGTH, ROOM + THICKNESS)),
        )];
        scene.bodies[0].particles_per_cell = self.particles_per_cell;
        (scene.weighting, scene.scheme) = (self.method.weighting, self.method.scheme);
        scene.transfer = self.transfer;
        scene.time_step = TimeStep::Fixed {
            dt: self.courant,
            allow_unstable: true,
        };
        scene.results = NO_RESULTS;
        scene
    }

    /// Growth per step of noise in a bar under a tension, over the modulus of confined strain; 0 where the method holds it.
    ///
    /// # Errors
    /// A step that fails.
    pub fn growth(&self, tension: f64) -> Result<f64, StabilityError> {
        let size = tension.abs().max(LEAST_TENSION);
        Ok(self.measured(size.copysign(tension))? * tension.abs() / size)
    }

    /// The same, by a run with that tension; 0 below [`LEAST_GROWTH`].
    fn measured(&self, tension: f64) -> Result<f64, StabilityError> {
        let axes = self.dimension.axes();
        let options = Options {
            threads: Some(1),
            initial: Some(Arc::new(move |x: &Vector| {
                // The bits of a place make noise that is the same every time.
                let seed = x
                    .iter()
                    .fold(0_u64, |seed, x| seed.rotate_left(21) ^ x.to_bits());
                let noise = |axis: usize| NOISE * uniform(seed.wrapping_add(axis as u64));
                InitialState {
                    velocity: std::array::from_fn(
                        |axis| if axis < axes { noise(axis) } else { 0.0 },
                    ),
                    stress: [tension, 0.0, 0.0, 0.0, 0.0, 0.0],
                    ..InitialState::default()
                }
            })),
            ..Options::default()
        };
        let mut bar = self.scene().simulate(&options)?;
        let start = bar.kinetic_energy();
        let mut first = None;
        let mut rate = 0.0;
        for step in 1..=STEPS {
            bar.step(f64::INFINITY)?;
            let energy = bar.kinetic_energy();
            let (before, reference) = *first.get_or_insert((step, energy));
            if step > before {
                rate = 0.5 * libm::log(energy / reference) / (step - before) as f64;
            }
            if energy > ENOUGH * start {
                break;
            }
            if step == STEPS / 4 {
                first = Some((step, energy));
            }
        }
        Ok(if rate > LEAST_GROWTH { rate } else { 0.0 })
    }
}
