//! Scenes in which contact acts, one of each kind, long enough for many slabs of the grid. Their coordinates are
//! multiples of 2^-9 m.

use crate::common::{APIC, FLIP, NEVER, TPIC, body, cuboid, elastic, empty, material, run_towards};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    BodyBoundary, Contact, ContactNormal, Dimension, Enforcement, History, MortarContact,
    RigidSurface, Scene, Shape, StressScheme, Vector, Vertices,
};
use std::sync::Arc;

/// Edge of a cell \[m\].
const H: f64 = 0.125;
/// Cells along the scenes: eight slabs of the thinnest kind, so that each of eight threads has one.
const LONG: usize = 68;

/// A scene, and how to see that contact acts in it.
pub struct Touching {
    pub name: String,
    pub scene: Scene,
    steps: usize,
    /// True if contact acts in the last step.
    acts: fn(&Simulation) -> bool,
}

impl Touching {
    /// Runs the steps; contact must have acted in one of them.
    pub fn run(&self, simulation: &mut Simulation) {
        let mut acted = false;
        for _ in 0..self.steps {
            run_towards(simulation, 1, NEVER);
            acted |= (self.acts)(simulation);
        }
        assert!(acted, "{}: nothing touches", self.name);
    }
}

/// Five bars end to end, each flying at the next one.
fn train(dimension: Dimension, normal: ContactNormal) -> Scene {
    let mut scene = empty(dimension, [LONG, 6, 5], H);
    scene.materials = vec![material(elastic(1.0e5, 0.3)), material(elastic(1.0e6, 0.2))];
    scene.materials[1].id = 2;
    let [back, front] = if dimension == Dimension::Two {
        [0.0; 2]
    } else {
        [0.25, 0.5]
    };
    for k in 0..5 {
        let from = 0.25 + 1.5 * f64::from(k);
        let low = 0.25 + 0.0625 * f64::from(k % 2);
        let mut bar = body(
            i64::from(10 - k),
            cuboid([from, low, back], [from + 1.5, low + 0.25, front]),
        );
        bar.material = k as usize % 2;
        bar.velocity = [1.0 - 0.5 * f64::from(k), 0.25 * f64::from(k % 2), 0.0];
        if dimension == Dimension::Two {
            bar.particles_per_cell[2] = 1;
        }
        scene.bodies.push(bar);
    }
    for k in 0..4 {
        scene.contacts.push(Contact {
            name: format!("joint {k}"),
            id: k + 1,
            friction: 0.3,
            master: 10 - k,
            slave: 9 - k,
            normal,
        });
    }
    scene
}

/// Three pairs of discs or balls that hit each other off centre, with boundaries.
fn pairs(dimension: Dimension, scheme: StressScheme) -> Scene {
    let flat = dimension == Dimension::Two;
    let mut scene = empty(dimension, [LONG, 10, 10], H);
    scene.transfer = APIC;
    scene.scheme = scheme;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    for k in 0..3_i32 {
        let at = 0.75 + 2.75 * f64::from(k);
        for (side, sign) in [(0_i32, 1.0), (1, -1.0)] {
            let id = i64::from(2 * k + side);
            let z = if flat { 0.0 } else { 0.625 };
            let mut ball = body(
                id,
                Shape::Sphere {
                    center: [
                        at + 0.78125 * f64::from(side),
                        0.5625 + 0.125 * f64::from(side),
                        z,
                    ],
                    radius: 0.375,
                },
            );
            ball.velocity = [2.0 * sign, 0.0, 0.0];
            ball.particles_per_cell = if flat { [2, 2, 1] } else { [2; 3] };
            scene.bodies.push(ball);
            scene.mortar.boundaries.push(BodyBoundary {
                body: id,
                vertices: Vertices::Spacing(if flat { 0.0625 } else { 0.125 }),
                follow: FollowMode::Spin,
            });
        }
        scene.mortar.contacts.push(MortarContact {
            name: format!("pair {k}"),
            id: i64::from(k),
            master: i64::from(2 * k),
            slave: i64::from(2 * k + 1),
            friction: 0.4,
            critical_gap: 0.05,
            normal_stiffness: 1.0e6,
            tangential_stiffness: 1.0e7,
            enforcement: Enforcement::Barrier,
            detection: Detection::Mortar,
        });
    }
    scene
}

/// A long block that lies on a plane between nodes, which moves along; with others on it where `stacked`.
fn on_plane(scheme: StressScheme, stacked: bool) -> Scene {
    let plane = 0.296_875;
    let mut scene = empty(Dimension::Three, [LONG, 3, 9], H);
    scene.scheme = scheme;
    scene.gravity = [4.0, 0.0, -10.0];
    scene.materials = vec![material(elastic(1.0e6, 0.2))];
    let mut block = |id: i64, [from, to]: [f64; 2], low: f64| {
        let mut block = body(id, cuboid([from, 0.125, low], [to, 0.25, low + 0.25]));
        block.velocity = [0.5, 0.0, -0.25];
        scene.bodies.push(block);
    };
    block(1, [0.25, 8.0], plane);
    if stacked {
        block(2, [0.5, 3.5], plane + 0.25);
        block(3, [4.5, 7.5], plane + 0.25);
        for slave in [2, 3] {
            scene.contacts.push(Contact {
                name: format!("block {slave}"),
                id: slave,
                friction: 0.2,
                master: 1,
                slave,
                normal: ContactNormal::Master,
            });
        }
    }
    let at = |x: f64, y: f64| [x, y, plane];
    let corners = [
        [at(-2.0, -2.0), at(12.0, -2.0), at(12.0, 2.0)],
        [at(-2.0, -2.0), at(12.0, 2.0), at(-2.0, 2.0)],
    ];
    scene.surfaces.push(RigidSurface {
        name: "plane".into(),
        surface: Arc::new(Surface::new(&corners).expect("a plane")),
        friction: 0.3,
        distance_threshold: H,
        penalty_stiffness: None,
        motion: Some(History {
            times: vec![0.0, 1.0],
            values: vec![[0.0; 3], [2.0, 0.0, 0.0]],
        }),
    });
    scene
}

/// A surface moved as it is.
pub fn moved(surface: &Surface, by: &Vector) -> Surface {
    let move_one = |x: Vector| std::array::from_fn(|axis| x[axis] + by[axis]);
    let corners: Vec<[Vector; 3]> = (0..surface.triangle_count())
        .map(|t| surface.corners(t).map(move_one))
        .collect();
    Surface::new(&corners).expect("it was one")
}

fn grid_acts(simulation: &Simulation) -> bool {
    (0..simulation.sets().len()).all(|set| simulation.contact_force(set) != [0.0; 3])
}

fn mortar_acts(simulation: &Simulation) -> bool {
    let mut bodies = simulation.scene().bodies.iter();
    bodies.all(|body| {
        simulation
            .mortar_force(body.id)
            .is_some_and(|f| f != [0.0; 3])
    })
}

fn surface_acts(simulation: &Simulation) -> bool {
    simulation.surface_impulse(0, 0)[2] > 0.0 && grid_acts(simulation)
}

/// All of them: contact on the grid, mortar contact in the plane and in space, a rigid surface, and one beside contact on
/// the grid, each with the schemes that it has.
pub fn touching() -> Vec<Touching> {
    let mut all = vec![];
    let mut add = |name: &str, scene: Scene, steps, acts| {
        let what = format!(
            "{name} {:?} {:?} {:?}",
            scene.dimension, scene.scheme, scene.transfer.kind
        );
        scene.check().expect("a sound scene");
        all.push(Touching {
            name: what,
            scene,
            steps,
            acts,
        });
    };
    let normals = [
        ContactNormal::Master,
        ContactNormal::Slave,
        ContactNormal::Collinear,
    ];
    for dimension in [Dimension::Two, Dimension::Three] {
        for (k, scheme) in crate::common::SCHEMES.into_iter().enumerate() {
            let mut scene = train(dimension, normals[k]);
            (scene.scheme, scene.transfer) = (scheme, [FLIP, APIC, TPIC][k]);
            add("grid", scene, 12, grid_acts);
        }
        for scheme in [StressScheme::Usl, StressScheme::Musl] {
            add("mortar", pairs(dimension, scheme), 8, mortar_acts);
        }
    }
    for scheme in crate::common::SCHEMES {
        add("surface", on_plane(scheme, false), 8, surface_acts);
        add(
            "surface beside contact",
            on_plane(scheme, true),
            8,
            surface_acts,
        );
    }
    all
}
