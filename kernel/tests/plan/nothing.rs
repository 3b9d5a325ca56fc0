//! Features that are given and do nothing: the plan lists them, and they change no bit.
//!
//! Three signs show that a feature is really given: the scene differs from the one without it, the plan has an entry for it,
//! and the same feature with other numbers, where it has any, changes the result.

use crate::common::{
    APIC, DIMENSIONS, FLIP, NEO_HOOKEAN, SCHEMES, WEIGHTINGS, body, calm, cuboid, empty, material,
    options, rough, run,
};
use crate::plan::{contact, entry};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{
    BaseMotion, BodyBoundary, BoxLoad, Damping, Dimension, Enforcement, Field, HeldBox, History,
    MortarContact, Motion, PlaneCondition, PointLoad, Probe, Results, RigidSurface, Scene,
    StressScheme, Traction, Vector, Vertices,
};
use std::sync::Arc;

type Give = fn(&mut Scene, &mut Options);

/// A feature, and what the plan says of it.
#[derive(Clone, Copy)]
struct Feature {
    /// Name for messages.
    name: &'static str,
    /// Name of its entry in the plan.
    entry: &'static str,
    /// True if the plan keeps it. What it leaves out also leaves all other decisions as they are.
    kept: bool,
    /// True if it adds columns to the particles, so that the hash, which runs over all columns, cannot be the same.
    columns: bool,
    /// Gives it so that it does nothing.
    idle: Give,
    /// Gives it so that it acts; `None` where it never changes the motion, or only where a body is near.
    nodal: Option<Give>,
}

const fn left_out(
    name: &'static str,
    entry: &'static str,
    idle: Give,
    nodal: Option<Give>,
) -> Feature {
    Feature {
        name,
        entry,
        kept: false,
        columns: false,
        idle,
        nodal,
    }
}

const fn kept(name: &'static str, entry: &'static str, idle: Give, nodal: Option<Give>) -> Feature {
    Feature {
        kept: true,
        ..left_out(name, entry, idle, nodal)
    }
}

/// Kept, with columns of its own.
const fn carried(
    name: &'static str,
    entry: &'static str,
    idle: Give,
    nodal: Option<Give>,
) -> Feature {
    Feature {
        columns: true,
        ..kept(name, entry, idle, nodal)
    }
}

/// Two blocks in a mesh of 0.1 m cells that is free all around: one in motion, one at rest and far away.
fn two_blocks(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [20, 8, 7], 0.1);
    let at = |x: f64, y: f64, z: f64| [x, y, if dimension == Dimension::Two { 0.0 } else { z }];
    scene.bodies = vec![
        body(1, cuboid(at(0.21, 0.22, 0.23), at(0.61, 0.52, 0.53))),
        body(2, cuboid(at(1.5, 0.22, 0.23), at(1.7, 0.42, 0.43))),
    ];
    for body in &mut scene.bodies {
        if dimension == Dimension::Two {
            body.particles_per_cell[2] = 1;
        }
    }
    scene
}

/// State after some steps from a rough start of the first block.
fn after(scene: &Scene, add: &Options) -> Simulation {
    let all = rough(scene.dimension, 0.5, 1.0e3, 11);
    let initial: InitialField = Arc::new(move |x| {
        let mut state = all(x);
        if x[0] > 1.0 {
            (state.velocity, state.stress) = ([0.0; 3], [0.0; 6]);
        }
        state
    });
    let all = Options {
        initial: Some(initial),
        ..add.clone()
    };
    let mut simulation = Simulation::new(scene, &all).expect("the scene is sound");
    run(&mut simulation, 25);
    simulation
}

/// Masses, volumes, positions, velocities and stresses as bits: what every scene has.
fn bits(simulation: &Simulation) -> Vec<u64> {
    let mut all: Vec<(u64, Vec<u64>)> = vec![];
    for (index, set) in simulation.sets().iter().enumerate() {
        for p in 0..set.len() {
            let (m, v) = (
                simulation.particle_mass(index, p),
                simulation.particle_volume(index, p),
            );
            let numbers = [m, v].into_iter().chain(set.position(p));
            let numbers = numbers.chain(set.velocity(p)).chain(set.stress(p));
            all.push((set.id[p], numbers.map(f64::to_bits).collect()));
        }
    }
    all.sort();
    all.into_iter().flat_map(|(_, bits)| bits).collect()
}

fn steady(velocity: Vector) -> History {
    History {
        times: vec![0.0],
        values: vec![velocity],
    }
}

/// A record on the plane X0 that lasts for ever.
fn record(scene: &mut Scene, motion: fn(History) -> Motion, value: f64) {
    scene.base_motion = Some(BaseMotion {
        axis: 0,
        side: 0,
        motion: motion(History {
            times: vec![0.0, 1.0e3],
            values: vec![[value, 0.0, 0.0]; 2],
        }),
    });
}

fn box_load(scene: &mut Scene, force: f64) {
    let deep = if scene.dimension == Dimension::Two {
        0.0
    } else {
        1.0
    };
    scene.box_loads = vec![BoxLoad {
        p1: [0.0; 3],
        p2: [1.0, 1.0, deep],
        force: [force, 0.0, 0.0],
    }];
}

/// Holds the nodes of a plane across the first axis.
fn held(scene: &mut Scene, x: f64) {
    let deep = if scene.dimension == Dimension::Two {
        0.0
    } else {
        0.6
    };
    scene.held_boxes = vec![HeldBox {
        p1: [x, 0.0, 0.0],
        p2: [x, 0.7, deep],
    }];
}

fn point_load(scene: &mut Scene, force: f64) {
    let deep = if scene.dimension == Dimension::Two {
        0.0
    } else {
        0.4
    };
    scene.point_loads = vec![PointLoad {
        position: [0.4, 0.4, deep],
        force: [force, 0.0, 0.0],
    }];
}

fn traction(scene: &mut Scene, traction: f64) {
    let flat = scene.dimension == Dimension::Two;
    let [low, high] = if flat { [0.0; 2] } else { [0.3, 0.5] };
    scene.tractions = vec![Traction {
        p1: [0.3, 0.4, low],
        p2: [0.5, 0.4, high],
        traction: [0.0, traction, 0.0].into(),
    }];
}

/// Boundaries of both bodies and a pair of them.
fn mortar(scene: &mut Scene) {
    scene.mortar.boundaries = [1, 2]
        .map(|id| BodyBoundary {
            body: id,
            vertices: Vertices::Spacing(0.1),
            follow: FollowMode::Velocity,
        })
        .to_vec();
    scene.mortar.contacts = vec![MortarContact {
        name: "pair".into(),
        id: 6,
        master: 1,
        slave: 2,
        friction: 0.3,
        critical_gap: 0.03,
        normal_stiffness: 1.0e6,
        tangential_stiffness: 1.0e7,
        enforcement: Enforcement::Barrier,
        detection: Detection::Mortar,
    }];
}

/// A rigid plane below the mesh, which moves a little.
fn surface(scene: &mut Scene) {
    let at = |x: f64, y: f64| [x, y, -0.5];
    let corners = [
        [at(-9.0, -9.0), at(9.0, -9.0), at(9.0, 9.0)],
        [at(-9.0, -9.0), at(9.0, 9.0), at(-9.0, 9.0)],
    ];
    scene.surfaces = vec![RigidSurface {
        name: "floor".into(),
        surface: Arc::new(Surface::new(&corners).expect("a plane")),
        friction: 0.5,
        distance_threshold: 0.1,
        penalty_stiffness: Some(1.0e3),
        motion: Some(steady([0.1, 0.0, 0.1])),
    }];
}

/// Features that scenes of both dimensions can have.
const FEATURES: [Feature; 23] = [
    left_out(
        "local damping of zero",
        "local damping",
        |s, _| s.damping = Damping::Local { alpha: 0.0 },
        Some(|s, _| s.damping = Damping::Local { alpha: 0.1 }),
    ),
    left_out(
        "viscous damping of zero",
        "viscous damping",
        |s, _| s.damping = Damping::Viscous { alpha: 0.0 },
        Some(|s, _| s.damping = Damping::Viscous { alpha: 0.1 }),
    ),
    left_out(
        "gravity of minus zero",
        "gravity",
        |s, _| s.gravity = [0.0, -0.0, 0.0],
        Some(|s, _| s.gravity = [0.0, -10.0, 0.0]),
    ),
    left_out(
        "a material that no body has",
        "deformation gradient",
        |s, _| {
            s.materials.push(material(NEO_HOOKEAN));
            s.materials[1].id = 2;
        },
        None,
    ),
    left_out(
        "fields of frames that are not written",
        "deformation gradient",
        |s, _| s.results.fields = vec![Field::DeformationGradient],
        None,
    ),
    left_out(
        "a probe of a history that is not written",
        "initial position",
        |s, _| {
            s.probes = vec![Probe::at("probe", [0.4, 0.4, 0.0])];
        },
        None,
    ),
    left_out(
        "a distance of contacts that are not there",
        "contact",
        |s, _| s.contact_distance = Some(0.7),
        None,
    ),
    kept(
        "held nodes that nobody reaches",
        "held nodes",
        |s, _| held(s, 1.1),
        Some(|s, _| held(s, 0.4)),
    ),
    kept(
        "a nodal load of zero",
        "nodal loads",
        |s, _| point_load(s, 0.0),
        Some(|s, _| point_load(s, 1.0)),
    ),
    kept(
        "a traction of zero",
        "nodal loads",
        |s, _| traction(s, 0.0),
        Some(|s, _| traction(s, 1.0)),
    ),
    carried(
        "a box load of zero",
        "external force",
        |s, _| box_load(s, 0.0),
        Some(|s, _| box_load(s, 1.0)),
    ),
    carried(
        "a body force of zero",
        "external force",
        |_, o| o.body_force = Some(Arc::new(|_, _, _| [0.0; 3])),
        Some(|_, o| o.body_force = Some(Arc::new(|_, _, _| [1.0, 0.0, 0.0]))),
    ),
    kept(
        "a plane that nobody reaches",
        "plane X0",
        |s, _| s.mesh.planes[0][0] = PlaneCondition::Fixed,
        None,
    ),
    kept(
        "a record of no acceleration",
        "base motion",
        |s, _| record(s, Motion::Acceleration, 0.0),
        Some(|s, _| record(s, Motion::Acceleration, 5.0)),
    ),
    kept(
        "a record of no velocity",
        "base motion",
        |s, _| record(s, Motion::Velocity, 0.0),
        Some(|s, _| record(s, Motion::Velocity, 0.2)),
    ),
    kept(
        "a body at rest that is driven at rest",
        "driven bodies",
        |s, _| s.bodies[1].motion = Some(steady([0.0; 3])),
        Some(|s, _| s.bodies[1].motion = Some(steady([0.5, 0.0, 0.0]))),
    ),
    kept(
        "contact of bodies that never come near",
        "contact 4",
        |s, _| s.contacts = vec![contact(2, 1)],
        None,
    ),
    kept(
        "a boundary and mortar contact of bodies that never come near",
        "mortar contact 6",
        |s, _| mortar(s),
        None,
    ),
    kept(
        "a rigid surface that nobody reaches",
        "contact with rigid surfaces",
        |s, _| surface(s),
        None,
    ),
    kept(
        "a measurement in every step",
        "measurement at the nodes",
        |_, o| o.measure = true,
        None,
    ),
    carried(
        "displacements",
        "initial position",
        |_, o| o.displacement = true,
        None,
    ),
    carried(
        "a deformation gradient that is written",
        "deformation gradient",
        |s, _| {
            s.results = Results {
                print: 3,
                history_interval: None,
                fields: vec![Field::DeformationGradient],
                nodal_fields: vec![],
                checkpoint: true,
            };
        },
        None,
    ),
    kept(
        "frames, a history and checkpoints",
        "frames, history, checkpoints",
        |s, _| {
            s.results.print = 3;
            s.results.fields = vec![Field::Id, Field::Stress];
            s.results.checkpoint = true;
        },
        None,
    ),
];

/// True if the kernel has a feature for a scene and nothing else there asks for the same: mortar contact has no USF, and rigid
/// surfaces are of space.
fn has(without: &Simulation, feature: &Feature) -> bool {
    let scene = without.scene();
    let mortar = feature.entry.starts_with("mortar") && scene.scheme == StressScheme::Usf;
    let rigid = feature.entry.contains("rigid") && scene.dimension == Dimension::Two;
    let mut entries = without.plan().entries.iter();
    !(mortar || rigid || entries.any(|e| e.name == feature.entry && e.kept))
}

fn check(scene: &Scene, without: &Simulation, feature: &Feature) {
    let what = format!(
        "{}: {:?} {:?} {:?} {:?}",
        feature.name, scene.dimension, scene.weighting, scene.scheme, scene.transfer.kind
    );
    let give = |give: Give| {
        let (mut with, mut all) = (scene.clone(), options());
        give(&mut with, &mut all);
        let given = format!("{with:?} {all:?}") != format!("{scene:?} {:?}", options());
        assert!(given, "{what}: nothing is given");
        with.check().unwrap_or_else(|e| panic!("{what}: {e}"));
        after(&with, &all)
    };
    let idle = give(feature.idle);
    let listed = entry(idle.plan(), feature.entry);
    assert!(
        listed.kept == feature.kept && !listed.because.is_empty(),
        "{what}: {listed:?}"
    );
    if !feature.kept {
        // Work: the same columns and the same decisions leave nothing that could cost.
        assert_eq!(idle.plan(), without.plan(), "{what}");
    }
    assert_eq!(idle.steps(), without.steps());
    assert_eq!(idle.time().to_bits(), without.time().to_bits(), "{what}");
    assert!(bits(&idle) == bits(without), "{what}: the result changes");
    if !feature.columns {
        assert_eq!(idle.state_hash(), without.state_hash(), "{what}");
    }
    if let Some(nodal) = feature.nodal {
        let acts = bits(&give(nodal)) != bits(without);
        assert!(acts, "{what}: changes nothing where it should act");
    }
}

#[test]
fn features_that_do_nothing_change_no_bit() {
    let mut checked = [0; FEATURES.len()];
    for dimension in DIMENSIONS {
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                for transfer in [FLIP, APIC] {
                    let mut scene = two_blocks(dimension);
                    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                    calm(&mut scene);
                    let without = after(&scene, &options());
                    for (feature, count) in FEATURES.iter().zip(&mut checked) {
                        if has(&without, feature) {
                            check(&scene, &without, feature);
                            *count += 1;
                        }
                    }
                }
            }
        }
    }
    // The deformation gradient is there with cpGIMP; the rest is left out for less.
    assert!(checked.iter().all(|&count| count >= 36), "{checked:?}");
}
