//! Scenes and questions that the tests share.

// Every test binary uses a part of this.
#![allow(dead_code)]

use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_laws::{AnyLaw, LinearElastic, NeoHookean};
use proctor_scene::simulation::{InitialField, InitialState, Options, Phase, Simulation};
use proctor_scene::{
    Body, Damping, Dimension, DomainUpdate, GroundBeyond, InitialStress, Material, Mesh, Mortar,
    OnImbalance, Outside, PlaneCondition, Results, Scene, Shape, StressScheme, TimeStep, Transfer,
    TransferKind, Vector, VolumetricStrain, Weighting,
};
use std::sync::{Arc, Mutex};

pub const DIMENSIONS: [Dimension; 2] = [Dimension::Two, Dimension::Three];
pub const SCHEMES: [StressScheme; 3] = [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf];
pub const WEIGHTINGS: [Weighting; 6] = [
    Weighting::Linear,
    Weighting::UniformGimp,
    Weighting::ContiguousGimp(DomainUpdate::Determinant),
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
    Weighting::ContiguousGimp(DomainUpdate::LeftStretch),
    Weighting::QuadraticBSpline,
];
pub const FLIP: Transfer = Transfer {
    kind: TransferKind::Flip,
    pic_fraction: 0.0,
};
pub const BLEND: Transfer = Transfer {
    kind: TransferKind::Flip,
    pic_fraction: 0.25,
};
pub const APIC: Transfer = Transfer {
    kind: TransferKind::Apic,
    pic_fraction: 1.0,
};
pub const TPIC: Transfer = Transfer {
    kind: TransferKind::Tpic,
    pic_fraction: 1.0,
};
pub const MLS: Transfer = Transfer {
    kind: TransferKind::Mls,
    pic_fraction: 1.0,
};
/// Transfers that every weighting function takes.
pub const TRANSFERS: [Transfer; 4] = [FLIP, BLEND, APIC, TPIC];

/// Transfers that a weighting function takes.
pub fn transfers_of(weighting: Weighting) -> impl Iterator<Item = Transfer> {
    let least_squares = (weighting == Weighting::QuadraticBSpline).then_some(MLS);
    TRANSFERS.into_iter().chain(least_squares)
}

pub const YOUNG: f64 = 1.0e6;
pub const DENSITY: f64 = 1000.0;
pub const ELASTIC: LinearElastic = elastic(YOUNG, 0.3);
pub const NEO_HOOKEAN: NeoHookean = NeoHookean::new(YOUNG, 0.3);

pub const fn elastic(young: f64, poisson: f64) -> LinearElastic {
    LinearElastic::new(young, poisson)
}

/// Every pair of weighting function and stress scheme.
pub fn weightings_and_schemes() -> impl Iterator<Item = (Weighting, StressScheme)> {
    WEIGHTINGS
        .into_iter()
        .flat_map(|weighting| SCHEMES.map(|scheme| (weighting, scheme)))
}

/// The lanes of this machine.
pub fn lanes() -> Vec<LaneChoice> {
    [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar]
        .into_iter()
        .filter(|choice| SelectedLanes::new(*choice).is_ok())
        .collect()
}

/// The same, and lanes in plain Rust, which every machine has.
pub fn all_lanes() -> Vec<SelectedLanes> {
    let here = lanes()
        .into_iter()
        .filter_map(|c| SelectedLanes::new(c).ok());
    here.chain([SelectedLanes::plain()]).collect()
}

/// True if a light node of a linear function can throw particles about, whatever the time step.
pub fn light_nodes_act(scene: &Scene) -> bool {
    let acts = scene.scheme == StressScheme::Usl || scene.transfer.kind != TransferKind::Flip;
    scene.weighting == Weighting::Linear && acts
}

/// Takes a small constant step where no step is safe for every offset of a body on the grid (linear functions whose
/// light nodes act on the particles): C = 0.07 there, so that only nodes with less than 1e-3 of a full one could
/// grow.
pub fn calm(scene: &mut Scene) {
    if light_nodes_act(scene) {
        scene.time_step = TimeStep::Fixed {
            dt: 2.0e-4,
            allow_unstable: false,
        };
    }
}

/// A mesh of cubes without any condition on its planes.
pub fn mesh(dimension: Dimension, cells: [usize; 3], h: f64) -> Mesh {
    let flat = dimension == Dimension::Two;
    Mesh {
        axisymmetric: false,
        origin: [0.0; 3],
        cell: [h, h, if flat { 1.0 } else { h }],
        cells: [cells[0], cells[1], if flat { 1 } else { cells[2] }],
        planes: [[PlaneCondition::Free; 2]; 3],
    }
}

/// A scene without bodies, loads and conditions.
pub fn empty(dimension: Dimension, cells: [usize; 3], h: f64) -> Scene {
    Scene {
        name: "test".into(),
        dimension,
        time: 1.0,
        until: None,
        time_step: TimeStep::Automatic,
        gravity: [0.0; 3],
        mesh: mesh(dimension, cells, h),
        weighting: Weighting::UniformGimp,
        scheme: StressScheme::Usl,
        transfer: FLIP,
        volumetric_strain: VolumetricStrain::Particle,
        materials: vec![material(ELASTIC)],
        pore_water: vec![],
        water_planes: [[PlaneCondition::Sliding; 2]; 3],
        water_pressures: Default::default(),
        standing_waters: vec![],
        initial_pressures: vec![],
        held_pressures: vec![],
        bodies: vec![],
        initial_state: None,
        surfaces: vec![],
        damping: Damping::None,
        base_motion: None,
        ground_beyond: GroundBeyond::default(),
        held_boxes: vec![],
        point_loads: vec![],
        tractions: vec![],
        box_loads: vec![],
        contacts: vec![],
        contact_distance: None,
        mortar: Mortar::default(),
        outside: Outside::Stop,
        on_imbalance: OnImbalance::Tell,
        results: Results::NONE,
        probes: vec![],
        threads: None,
    }
}

pub fn material(law: impl Into<AnyLaw>) -> Material {
    Material {
        name: "solid".into(),
        id: 1,
        density: DENSITY,
        law: law.into(),
    }
}

/// A body of the first material with two particles per cell and axis, at rest.
pub fn body(id: i64, shape: Shape) -> Body {
    Body {
        name: format!("body {id}"),
        id,
        material: 0,
        shape,
        particles_per_cell: [2; 3],
        velocity: [0.0; 3],
        motion: None,
        initial_stress: InitialStress::None,
    }
}

pub fn cuboid(p1: Vector, p2: Vector) -> Shape {
    Shape::Cuboid { p1, p2 }
}

/// A block in the middle of a mesh of 0.1 m cells, its faces off the nodes.
pub fn block(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [9, 8, 7], 0.1);
    scene.bodies = vec![body(1, cuboid([0.21, 0.22, 0.23], [0.61, 0.52, 0.53]))];
    scene
}

pub fn options() -> Options {
    Options {
        threads: Some(1),
        ..Options::default()
    }
}

pub fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene, &options()).expect("the scene is sound")
}

pub fn simulation_from(scene: &Scene, initial: InitialField) -> Simulation {
    Simulation::new(
        scene,
        &Options {
            initial: Some(initial),
            ..options()
        },
    )
    .expect("the scene is sound")
}

/// A time that no test reaches \[s\].
pub const NEVER: f64 = 1.0e3;

pub fn run(simulation: &mut Simulation, steps: usize) {
    run_towards(simulation, steps, NEVER);
}

/// Steps that may not fail, with the scene in the message if one does.
pub fn run_towards(simulation: &mut Simulation, steps: usize, stop: f64) {
    for _ in 0..steps {
        if let Err(e) = simulation.step(stop) {
            let s = simulation.scene();
            panic!(
                "{:?} {:?} {:?} {:?} {:?}: {e}",
                s.dimension, s.weighting, s.scheme, s.transfer, s.damping
            );
        }
    }
}

/// A number in [-1, 1) from the bits of a position: rough on purpose, the same in every run.
pub fn noise(x: &Vector, seed: u64) -> f64 {
    let mut z = seed;
    for c in x {
        z = (z ^ c.to_bits()).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
    }
    (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Random velocities and stresses of the given size, in two dimensions without out-of-plane velocity.
pub fn rough(dimension: Dimension, speed: f64, stress: f64, seed: u64) -> InitialField {
    rough_drift(dimension, [0.0; 3], speed, stress, seed)
}

/// Drift of [`rough`] on top of a uniform velocity.
pub fn rough_drift(
    dimension: Dimension,
    drift: Vector,
    speed: f64,
    stress: f64,
    seed: u64,
) -> InitialField {
    let flat = dimension == Dimension::Two;
    Arc::new(move |x| InitialState {
        velocity_gradient: [[0.0; 3]; 3],
        velocity: std::array::from_fn(|axis| {
            if flat && axis == 2 {
                0.0
            } else {
                drift[axis] + speed * noise(x, seed + axis as u64)
            }
        }),
        stress: std::array::from_fn(|i| {
            if flat && (i == 3 || i == 4) {
                0.0
            } else {
                stress * noise(x, seed + 10 + i as u64)
            }
        }),
        deformation: IDENTITY,
    })
}

pub const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// All particles as identifier, position in the scene, velocity and stress, in order of the identifier.
pub fn particles(simulation: &Simulation) -> Vec<(u64, Vector, Vector, [f64; 6])> {
    let mut all = vec![];
    for (index, set) in simulation.sets().iter().enumerate() {
        for p in 0..set.len() {
            all.push((
                set.id[p],
                simulation.position(index, p),
                set.velocity(p),
                set.stress(p),
            ));
        }
    }
    all.sort_by_key(|particle| particle.0);
    all
}

/// Largest magnitude of the differences.
pub fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// Sum of m |v| over all particles, the scale of round-off in a momentum.
pub fn momentum_scale(simulation: &Simulation) -> f64 {
    let mut sum = 0.0;
    for (index, set) in simulation.sets().iter().enumerate() {
        for p in 0..set.len() {
            let v = set.velocity(p);
            sum += simulation.particle_mass(index, p) * v.iter().map(|c| c.abs()).sum::<f64>();
        }
    }
    sum
}

/// Number of cases of a property; failing seeds are printed, not stored beside the sources.
pub fn cases(count: u32) -> proptest::prelude::ProptestConfig {
    proptest::prelude::ProptestConfig {
        cases: count,
        failure_persistence: None,
        ..proptest::prelude::ProptestConfig::default()
    }
}

/// The error of the first of `most` steps that fails.
pub fn first_error(
    simulation: &mut Simulation,
    most: usize,
) -> proctor_scene::simulation::StepError {
    for _ in 0..most {
        if let Err(e) = simulation.step(NEVER) {
            assert_eq!(e.step, simulation.steps() + 1);
            assert_eq!(e.time, simulation.time());
            return e;
        }
    }
    panic!("no error in {most} steps");
}

/// Adds the phases of the steps that follow to a list.
pub fn observe(simulation: &mut Simulation) -> Arc<Mutex<Vec<Phase>>> {
    let phases = Arc::new(Mutex::new(vec![]));
    let list = Arc::clone(&phases);
    let observer = move |phase| list.lock().expect("no panic").push(phase);
    simulation.observe_phases(Some(Box::new(observer)));
    phases
}
