//! Parts of all rows of free bodies: scenes, methods, runs and readings. Cells are 1 m and densities 1 kg/m³
//! where a row does not say otherwise.

use std::fmt;
use std::sync::Arc;

use proctor_laws::AnyLaw;
use proctor_scene::simulation::{
    InitialField, InitialState, Options, Simulation, StepError, StepErrorKind,
};
use proctor_scene::{Body, Dimension, Mesh, PlaneCondition, Scene, Shape, Vector};

use super::Unexpected;
use crate::cases::{AT_REST, NO_RESULTS, body, cuboid, elastic_law, material};
use crate::settings::{Method, Settings};
use crate::stability::map::{LEAST_SQUARES, SCHEMES, TRANSFERS, WEIGHTINGS};

/// No end of a run: it is left after so many steps.
pub const NEVER: f64 = 1e30;

/// Young's modulus \[Pa\] and Poisson's ratio of what is soft, and its confined modulus over density: waves of 1 m/s.
pub const YOUNG: f64 = 0.75;
pub const POISSON: f64 = 0.3;

/// A confined modulus of 1 Pa within a per cent.
pub fn soft() -> AnyLaw {
    elastic_law(YOUNG, POISSON)
}

/// One thread.
pub fn options() -> Options {
    Options {
        threads: Some(1),
        ..Options::default()
    }
}

/// One thread, and a start of each particle by its place.
pub fn from(initial: InitialField) -> Options {
    Options {
        initial: Some(initial),
        ..options()
    }
}

/// A mesh without conditions and without bodies.
pub fn open(dimension: Dimension, cells: [usize; 3], law: AnyLaw) -> Scene {
    let mut mesh = Mesh::new(dimension, [0.0; 3], [1.0; 3], cells);
    mesh.planes[..dimension.axes()].fill([PlaneCondition::Free; 2]);
    let mut scene = Scene::new(dimension, mesh, 1.0);
    scene.materials = material("elastic", 1.0, law);
    scene.results = NO_RESULTS;
    scene
}

/// A body with two particles per cell and axis.
pub fn filled(dimension: Dimension, id: i64, shape: Shape) -> Body {
    let mut body = body(format!("body {id}"), id, shape);
    body.particles_per_cell[..dimension.axes()].fill(2);
    body
}

/// A block of the plane between two corners, two particles per cell and axis, in an open mesh.
pub fn block(cells: [usize; 2], low: [f64; 2], high: [f64; 2], law: AnyLaw) -> Scene {
    let mut scene = open(Dimension::Two, [cells[0], cells[1], 1], law);
    let shape = cuboid([low[0], low[1], 0.0], [high[0], high[1], 0.0]);
    scene.bodies = vec![filled(Dimension::Two, 1, shape)];
    scene
}

/// The same with another method; particles stay as they are.
pub fn with(scene: &Scene, method: Method) -> Scene {
    let mut scene = scene.clone();
    let own: Vec<[usize; 3]> = scene.bodies.iter().map(|b| b.particles_per_cell).collect();
    Settings::new(method).apply(&mut scene);
    for (body, own) in scene.bodies.iter_mut().zip(own) {
        body.particles_per_cell = own;
    }
    scene
}

/// All combinations of weighting function, scheme and transfer.
pub fn methods() -> Vec<Method> {
    let mut all = vec![];
    for weighting in WEIGHTINGS {
        for scheme in SCHEMES {
            all.extend(TRANSFERS.map(|transfer| Method {
                weighting,
                scheme,
                transfer,
            }));
        }
    }
    let (weighting, transfer) = LEAST_SQUARES;
    all.extend(SCHEMES.map(|scheme| Method {
        weighting,
        scheme,
        transfer,
    }));
    all
}

/// So many steps with a method that has a safe step, and two with one of which the kernel says that it has none.
pub fn count_of(method: Method, count: u64) -> u64 {
    if method.has_safe_step() { count } else { 2 }
}

/// An error where none should be.
pub fn unexpected(what: impl fmt::Display, error: impl fmt::Display) -> Unexpected {
    Unexpected(format!("{what}: {error}"))
}

/// Checks a scene and sets it in motion.
///
/// # Errors
/// Why it does not start.
pub fn start(what: &str, scene: &Scene, options: &Options) -> Result<Simulation, Unexpected> {
    scene.simulate(options).map_err(|e| unexpected(what, e))
}

/// Does so many steps.
///
/// # Errors
/// The first that fails.
pub fn steps(what: &str, simulation: &mut Simulation, count: u64) -> Result<(), Unexpected> {
    for _ in 0..count {
        simulation.step(NEVER).map_err(|e| unexpected(what, e))?;
    }
    Ok(())
}

/// Steps to a time \[s\].
///
/// # Errors
/// The first step that fails.
pub fn to_time(what: &str, simulation: &mut Simulation, time: f64) -> Result<(), Unexpected> {
    while simulation.time() < time * (1.0 - 1e-12) {
        simulation.step(time).map_err(|e| unexpected(what, e))?;
    }
    Ok(())
}

/// The error that ends a run within so many steps, and how many were done before.
pub fn first_error(simulation: &mut Simulation, most: u64) -> Option<StepError> {
    (0..most).find_map(|_| simulation.step(NEVER).err())
}

/// Whether an error says that a particle went wrong: it left, turned inside out or is no number any more.
pub fn is_blow_up(kind: &StepErrorKind) -> bool {
    matches!(
        kind,
        StepErrorKind::NotFinite(_)
            | StepErrorKind::Law { .. }
            | StepErrorKind::Inverted(_)
            | StepErrorKind::Outside(_)
            | StepErrorKind::OffAbsorbingPlane { .. }
            | StepErrorKind::Porosity { .. }
            | StepErrorKind::DomainTooLarge { .. }
    )
}

/// A number between -1 and 1 for each place and seed, the same on every machine: bits of the place, mixed (splitmix64).
pub fn noise(x: &Vector, seed: u64) -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for c in x {
        state ^= c.to_bits();
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        state ^= state >> 31;
    }
    (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A drift \[m/s\] with velocities that differ from particle to particle by up to `speed` \[m/s\], and stresses by up to
/// `stress` \[Pa\].
pub fn rough(dimension: Dimension, drift: Vector, speed: f64, stress: f64) -> InitialField {
    let axes = dimension.axes();
    Arc::new(move |x| {
        let mut state = InitialState {
            velocity: drift,
            ..AT_REST
        };
        for axis in 0..axes {
            state.velocity[axis] += speed * noise(x, 1 + axis as u64);
            state.stress[axis] = stress * noise(x, 11 + axis as u64);
        }
        state.stress[5] = stress * noise(x, 21);
        state
    })
}

/// A particle as it is read of a simulation.
pub struct Seen {
    pub id: u64,
    pub position: Vector,
    pub velocity: Vector,
    pub stress: [f64; 6],
}

impl Seen {
    /// All its numbers.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let vectors = self.position.iter().chain(&self.velocity);
        vectors.chain(&self.stress).copied()
    }
}

/// All particles in order of the identifier.
pub fn particles(simulation: &Simulation) -> Vec<Seen> {
    let mut all = vec![];
    for (set, columns) in simulation.sets().iter().enumerate() {
        all.extend((0..columns.len()).map(|p| Seen {
            id: columns.id[p],
            position: simulation.position(set, p),
            velocity: columns.velocity(p),
            stress: columns.stress(p),
        }));
    }
    all.sort_by_key(|seen| seen.id);
    all
}

/// Largest magnitude; infinite where there is something that is not a number.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            value.abs().max(most)
        }
    })
}

/// Largest component of the differences of two lists of vectors.
pub fn apart<'a, const N: usize>(
    a: impl IntoIterator<Item = &'a [f64; N]>,
    b: impl IntoIterator<Item = &'a [f64; N]>,
) -> f64 {
    let pairs = a.into_iter().zip(b);
    largest(pairs.flat_map(|(a, b)| (0..N).map(move |k| a[k] - b[k])))
}

/// Sum of the magnitudes of all components of all momenta \[kg m/s\].
pub fn momentum_scale(simulation: &Simulation) -> f64 {
    let sets = simulation.sets().iter().enumerate();
    sets.flat_map(|(set, columns)| {
        (0..columns.len()).map(move |p| {
            let mass = simulation.particle_mass(set, p);
            let velocity = columns.velocity(p);
            mass * velocity.iter().map(|c| c.abs()).sum::<f64>()
        })
    })
    .sum()
}
