//! The map of contact forces from vertices to nodes is the transpose of that of velocities from nodes to vertices.

use crate::common::{FLIP, body, calm, cuboid, elastic, empty, material, options};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    BodyBoundary, Dimension, Enforcement, MortarContact, PlaneCondition, Scene, Shape, Vector,
    Vertices, Weighting,
};
use proptest::prelude::*;

const GAP: f64 = 0.04;

/// Two bodies at rest, nearer to each other than the critical gap: discs or balls, or in `half` blocks that stand on a plane
/// of symmetry, the lower one along the last axis.
fn pressed(
    dimension: Dimension,
    weighting: Weighting,
    follow: FollowMode,
    (angle, shift, half): (f64, Vector, bool),
) -> Scene {
    let axes = dimension.axes();
    let mut scene = empty(dimension, [20, 20, 14], 0.1);
    if dimension == Dimension::Two {
        scene.mesh.cells[2] = 1;
    }
    scene.transfer = FLIP;
    scene.weighting = weighting;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    let flat = |x: Vector| std::array::from_fn(|axis| if axis < axes { x[axis] } else { 0.0 });
    let first: Vector = flat([
        0.75 + 0.1 * shift[0],
        0.95 + 0.1 * shift[1],
        0.65 + 0.1 * shift[2],
    ]);
    let shapes = if half {
        scene.mesh.planes[axes - 1][0] = PlaneCondition::Sliding;
        let corner: Vector = std::array::from_fn(|axis| match axis {
            _ if axis + 1 >= axes => 0.0,
            0 => first[0] - 0.3,
            _ => first[axis] - 0.4,
        });
        let block = |from: Vector, size: Vector| {
            let from = flat(from);
            let size = flat(size);
            cuboid(from, std::array::from_fn(|axis| from[axis] + size[axis]))
        };
        let mut beside = corner;
        beside[0] += 0.5 + 0.5 * GAP;
        [
            block(corner, [0.5, 0.6, 0.5]),
            block(beside, [0.4, 0.5, 0.4]),
        ]
    } else {
        let (radius, between) = (0.3, 0.6 + 0.5 * GAP);
        let along: Vector = flat([angle.cos(), angle.sin(), 0.3]);
        let length = along.iter().map(|a| a * a).sum::<f64>().sqrt();
        let second = std::array::from_fn(|axis| first[axis] + between * along[axis] / length);
        [first, second].map(|center| Shape::Sphere { center, radius })
    };
    scene.bodies = vec![];
    for (id, shape) in (1..).zip(shapes) {
        let mut one = body(id, shape);
        one.particles_per_cell = [2, 2, 2];
        scene.bodies.push(one);
        scene.mortar.boundaries.push(BodyBoundary {
            body: id,
            vertices: Vertices::Spacing(0.06),
            follow,
        });
    }
    scene.mortar.contacts = vec![MortarContact {
        name: "contact".into(),
        id: 1,
        master: 1,
        slave: 2,
        friction: 0.0,
        critical_gap: GAP,
        normal_stiffness: 1.0e5,
        tangential_stiffness: 1.0e7,
        enforcement: Enforcement::Barrier,
        detection: Detection::Mortar,
    }];
    calm(&mut scene);
    scene
}

/// Energies of one body in the first step: the work of its contact forces on vertices over the time step \[W\], that on the
/// nodes, and the moments of both about the origin \[N m\].
struct EnergyLedger {
    on_vertices: f64,
    on_nodes: f64,
    moment_of_vertices: Vector,
    moment_of_nodes: Vector,
}

/// From rest and without stress the nodes have what contact gave them, f dt/2 = m v.
fn first_step(scene: &Scene, id: i64) -> EnergyLedger {
    let mut simulation = Simulation::new(scene, &options()).expect("sound");
    let before = simulation.boundary_vertices(id).expect("has one");
    let dt = simulation.step(f64::INFINITY).expect("runs").dt;
    let after = simulation.boundary_vertices(id).expect("has one");
    let vertices = simulation.boundaries().vertices;
    let forces = vertices
        .iter()
        .filter(|vertex| vertex.id == id)
        .map(|vertex| vertex.force);
    let mut ledger = EnergyLedger {
        on_vertices: 0.0,
        on_nodes: 0.0,
        moment_of_vertices: [0.0; 3],
        moment_of_nodes: [0.0; 3],
    };
    for ((f, x), y) in forces.zip(&before).zip(&after) {
        ledger.on_vertices += (0..3).map(|a| f[a] * (y[a] - x[a]) / dt).sum::<f64>();
        add_cross(&mut ledger.moment_of_vertices, x, &f);
    }
    let nodes = simulation.node_values();
    for node in nodes.iter().filter(|node| node.body == Some(id)) {
        let f = node.velocity.map(|v| node.mass * v / (0.5 * dt));
        ledger.on_nodes += (0..3).map(|a| f[a] * node.velocity[a]).sum::<f64>();
        add_cross(&mut ledger.moment_of_nodes, &node.position, &f);
    }
    ledger
}

fn add_cross(sum: &mut Vector, x: &Vector, f: &Vector) {
    for axis in 0..3 {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        sum[axis] += x[i] * f[j] - x[j] * f[i];
    }
}

fn places() -> impl Strategy<Value = (f64, Vector, bool)> {
    let shift = prop::array::uniform3(-0.5..0.5);
    (-1.0_f64..1.0, shift, any::<bool>())
}

fn weightings() -> impl Strategy<Value = Weighting> {
    prop_oneof![
        Just(Weighting::UniformGimp),
        Just(Weighting::QuadraticBSpline),
        Just(Weighting::Linear),
    ]
}

proptest! {
    #![proptest_config(crate::common::cases(12))]

    #[test]
    fn forces_do_the_same_work_on_vertices_and_on_nodes(place in places(), weighting in weightings()) {
        for dimension in [Dimension::Two, Dimension::Three] {
            for follow in [FollowMode::Velocity, FollowMode::Spin, FollowMode::Gradient, FollowMode::Material] {
                let scene = pressed(dimension, weighting, follow, place);
                for id in [1, 2] {
                    let ledger = first_step(&scene, id);
                    prop_assert!(ledger.on_vertices > 0.0, "{follow:?} {}", ledger.on_vertices);
                    let off = (ledger.on_nodes / ledger.on_vertices - 1.0).abs();
                    // Ways are differences of positions 1e5 times as large.
                    prop_assert!(off < 1e-8, "{dimension:?} {follow:?} body {id}: {off}");
                }
            }
        }
    }

    /// The force on a vertex acts where the vertex is, which the weights alone do not say.
    #[test]
    fn forces_act_at_their_vertices(place in places(), weighting in weightings()) {
        let (angle, shift, _) = place;
        for dimension in [Dimension::Two, Dimension::Three] {
            let couple = |follow| {
                let scene = pressed(dimension, weighting, follow, (angle, shift, false));
                let EnergyLedger { moment_of_vertices: v, moment_of_nodes: n, .. } = first_step(&scene, 1);
                let size = v.iter().fold(0.0_f64, |most, m| most.max(m.abs()));
                let off = (0..3).map(|axis| (v[axis] - n[axis]).abs()).fold(0.0, f64::max);
                off / size
            };
            for follow in [FollowMode::Spin, FollowMode::Gradient, FollowMode::Material] {
                let off = couple(follow);
                prop_assert!(off < 1e-10, "{dimension:?} {follow:?}: {off}");
            }
        }
    }
}
