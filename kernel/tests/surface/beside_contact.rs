//! Rigid surfaces beside contact between bodies, and bodies on surfaces that move.

use crate::surface::slide::start;
use proctor_contact::geometry::surface::Surface;
use proctor_laws::LinearElastic;
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{
    Body, Contact, ContactNormal, Dimension, History, InitialStress, Material, Mesh, RigidSurface,
    Scene, Shape, StressScheme, Vector,
};
use std::sync::Arc;

const SCHEMES: [StressScheme; 3] = [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl];
/// Cell edge \[m\]. The slab is one cell wide between sliding planes.
const H: f64 = 0.1;
const DENSITY: f64 = 1000.0;
/// Gravity into the plane \[m/s²\].
const INTO: f64 = 10.0;
/// Height of the plane, off the nodes \[m\].
const PLANE: f64 = 0.237;
/// Lower and upper block: from where to where along the plane, and their heights \[m\].
const LOWER: [f64; 2] = [0.2, 1.2];
const UPPER: [f64; 2] = [0.4, 0.9];
const HEIGHT: f64 = 0.3;
/// Interval in which accelerations are taken \[s\].
const FROM: f64 = 0.1;
const TO: f64 = 0.4;

/// Choices of the blocks.
#[derive(Clone, Debug)]
struct Stack {
    scheme: StressScheme,
    /// Gravity along the plane \[m/s²\].
    along: f64,
    /// Friction of the lower block on the plane, and of the upper one on the lower; `None` where it is not there.
    friction: (f64, Option<f64>),
    /// Acceleration of the plane along itself \[m/s²\].
    plane: f64,
}

impl Stack {
    fn scene(&self) -> Scene {
        let mesh = Mesh::new(Dimension::Three, [0.0; 3], [H; 3], [26, 1, 12]);
        let mut scene = Scene::new(Dimension::Three, mesh, TO);
        scene.scheme = self.scheme;
        scene.gravity = [self.along, 0.0, -INTO];
        scene.materials.push(Material {
            name: "elastic".into(),
            id: 1,
            density: DENSITY,
            law: LinearElastic::new(1e7, 0.0).into(),
        });
        let mut block = |id: i64, [from, to]: [f64; 2], low: f64| {
            scene.bodies.push(Body {
                name: format!("block {id}"),
                id,
                material: 0,
                shape: Shape::Cuboid {
                    p1: [from, 0.0, low],
                    p2: [to, H, low + HEIGHT],
                },
                particles_per_cell: [2; 3],
                velocity: [0.0; 3],
                motion: None,
                initial_stress: InitialStress::None,
            });
        };
        block(1, LOWER, PLANE);
        if let Some(friction) = self.friction.1 {
            block(2, UPPER, PLANE + HEIGHT);
            scene.contacts.push(Contact {
                name: "upper on lower".into(),
                id: 1,
                friction,
                master: 1,
                slave: 2,
                normal: ContactNormal::Master,
            });
        }
        let at = |x: f64, y: f64| [x, y, PLANE];
        let corners = [
            [at(-9.0, -1.0), at(9.0, -1.0), at(9.0, 1.0)],
            [at(-9.0, -1.0), at(9.0, 1.0), at(-9.0, 1.0)],
        ];
        scene.surfaces.push(RigidSurface {
            name: "plane".into(),
            surface: Arc::new(Surface::new(&corners).expect("a plane")),
            friction: self.friction.0,
            distance_threshold: H,
            penalty_stiffness: None,
            motion: (self.plane != 0.0).then(|| History {
                times: vec![0.0, 1.0],
                values: vec![[0.0; 3], [self.plane, 0.0, 0.0]],
            }),
        });
        scene
    }

    /// A simulation in which each block carries what stands on it from the start.
    fn simulation(&self, scene: &Scene, threads: usize) -> Simulation {
        let share = (UPPER[1] - UPPER[0]) / (LOWER[1] - LOWER[0]);
        let on_top = self.friction.1.map_or(0.0, |_| share * HEIGHT);
        let initial = move |x: &Vector| {
            let height = x[2] - PLANE;
            let above = if height < HEIGHT {
                HEIGHT - height + on_top
            } else {
                2.0 * HEIGHT - height
            };
            InitialState {
                velocity: [0.0; 3],
                velocity_gradient: [[0.0; 3]; 3],
                stress: [0.0, 0.0, -DENSITY * INTO * above, 0.0, 0.0, 0.0],
                deformation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            }
        };
        scene.check().expect("a sound scene");
        let options = Options {
            threads: Some(threads),
            least_share: Some(1),
            initial: Some(Arc::new(initial)),
            ..Options::default()
        };
        Simulation::new(scene, &options).expect("a scene that can start")
    }

    /// Mean accelerations of the blocks, and the rise of the last one over the way that they slid \[m/s², m\].
    fn accelerations(&self) -> (Vec<f64>, f64) {
        let mut simulation = self.simulation(&self.scene(), 1);
        let bodies = simulation.sets().len();
        let begin = simulation.center(bodies - 1).position[2];
        let mut first = None;
        while simulation.time() < TO {
            simulation.step(TO).expect("a step");
            if simulation.time() >= FROM && first.is_none() {
                let speeds: Vec<f64> = (0..bodies)
                    .map(|b| simulation.center(b).velocity[0])
                    .collect();
                first = Some((simulation.velocity_time(), speeds));
            }
        }
        let (from, speeds) = first.expect("it lasts longer");
        let time = simulation.velocity_time() - from;
        let of =
            |(body, speed): (usize, &f64)| (simulation.center(body).velocity[0] - speed) / time;
        let rise = simulation.center(bodies - 1).position[2] - begin;
        (speeds.iter().enumerate().map(of).collect(), rise)
    }
}

/// Accelerations of two rigid blocks, the upper one `ratio` times as heavy as the lower one, under gravity along and into
/// a plane at rest, where both slide or the lower carries the upper.
fn rigid(along: f64, (on_plane, between): (f64, f64), ratio: f64) -> [f64; 2] {
    if between >= on_plane {
        return [along - on_plane * INTO; 2];
    }
    let lower = along - INTO * (on_plane * (1.0 + ratio) - between * ratio);
    [lower, along - between * INTO]
}

/// A block slides on a plane, another one on it: it is carried along, or slides ahead with its own friction.
#[test]
fn two_blocks_slide_on_a_plane_and_on_each_other() {
    for scheme in SCHEMES {
        for friction in [(0.3, 0.6), (0.4, 0.1), (0.2, 0.0)] {
            let stack = Stack {
                scheme,
                along: 8.0,
                friction: (friction.0, Some(friction.1)),
                plane: 0.0,
            };
            let (found, rise) = stack.accelerations();
            let exact = rigid(8.0, friction, 0.5);
            println!("{scheme:?} {friction:?}: {found:?} of {exact:?}, rise {rise}");
            for (found, exact) in found.iter().zip(exact) {
                assert!(
                    (found / exact - 1.0).abs() < 0.02,
                    "{scheme:?} {friction:?}: {found} of {exact}"
                );
            }
            assert!(
                rise.abs() < 0.02 * H,
                "{scheme:?}: the upper block rises by {rise} m"
            );
        }
    }
}

/// A plane that accelerates sideways takes a block along up to mu g; a block of larger friction has its acceleration, one
/// of smaller lags with a - mu g.
#[test]
fn a_block_on_a_plane_that_accelerates() {
    for scheme in SCHEMES {
        for (friction, exact) in [(0.5, 3.0), (0.2, 2.0), (0.0, 0.0)] {
            let stack = Stack {
                scheme,
                along: 0.0,
                friction: (friction, None),
                plane: 3.0,
            };
            let (found, rise) = stack.accelerations();
            println!("{scheme:?} mu {friction}: {found:?} of {exact}, rise {rise}");
            assert!(
                (found[0] - exact).abs() < 0.02 * 3.0,
                "{scheme:?} mu {friction}: {found:?} of {exact}"
            );
            assert!(rise.abs() < 0.02 * H, "{scheme:?}: {rise}");
        }
    }
}

/// Each body gains what its weight, its partner and the plane give, and the partners the opposite of each other.
#[test]
fn momentum_of_the_stack() {
    for scheme in SCHEMES {
        let stack = Stack {
            scheme,
            along: 5.0,
            friction: (0.3, Some(0.2)),
            plane: 1.0,
        };
        let scene = stack.scene();
        let mut simulation = stack.simulation(&scene, 1);
        simulation.run_until(0.1).expect("a step");
        let (t, m) = (simulation.velocity_time(), simulation.mass());
        let impulse = simulation.surface_impulse(0, 0);
        let momentum = simulation.momentum();
        for axis in [0, 2] {
            let lost = momentum[axis] - m * scene.gravity[axis] * t - impulse[axis];
            assert!(lost.abs() < 1e-12 * m * INTO * t, "{scheme:?}: {lost}");
        }
        let upper = simulation.contact_force(1);
        let lower = simulation.contact_force(0);
        let of_plane = simulation.surface_force(0);
        assert_eq!(simulation.surface_impulse(0, 1), [0.0; 3]);
        // The nodes tell the same, and where the plane carries the block no gap is left.
        let nodes = simulation.node_values();
        for (id, force) in [(1, lower), (2, upper)] {
            let of_nodes = |axis: usize| -> f64 {
                let own = nodes.iter().filter(|n| n.body == Some(id));
                own.map(|n| n.contact_force[axis]).sum()
            };
            for axis in [0, 2] {
                assert!((of_nodes(axis) - force[axis]).abs() < 1e-12 * m * INTO);
            }
        }
        let at_plane = nodes
            .iter()
            .filter(|n| n.position[2] < PLANE && n.mass > 0.0);
        let gaps: Vec<f64> = at_plane.map(|n| n.contact_gap).collect();
        assert!(gaps.len() >= 20 && gaps.iter().all(|gap| gap.abs() < 1e-3 * H));
        for axis in 0..3 {
            let sum = upper[axis] + lower[axis] + of_plane[axis];
            assert!(sum.abs() < 1e-12 * m * INTO, "{scheme:?}: {sum}");
        }
    }
}

#[test]
fn bits_do_not_depend_on_threads() {
    for scheme in SCHEMES {
        let stack = Stack {
            scheme,
            along: 5.0,
            friction: (0.3, Some(0.2)),
            plane: 1.0,
        };
        let run = |threads: usize| {
            let mut simulation = stack.simulation(&stack.scene(), threads);
            simulation.run_until(0.02).expect("a step");
            assert_eq!(simulation.contact_layers(), 2);
            (simulation.state_hash(), simulation.surface_impulse(0, 0))
        };
        let one = run(1);
        for threads in [2, 3, 5] {
            assert_eq!(run(threads), one, "{scheme:?} with {threads} threads");
        }
    }
}

/// A pair that never comes near changes no bit of what a surface does.
#[test]
fn a_far_pair_changes_no_bit() {
    let stack = Stack {
        scheme: StressScheme::Musl,
        along: 5.0,
        friction: (0.3, Some(0.2)),
        plane: 0.0,
    };
    let run = |paired: bool| {
        let mut scene = stack.scene();
        let Shape::Cuboid { p1, p2 } = &mut scene.bodies[1].shape else {
            panic!("a box");
        };
        for corner in [p1, p2] {
            corner[0] += 1.4;
        }
        if !paired {
            scene.contacts.clear();
        }
        let mut simulation = start(&scene, 1);
        simulation.run_until(0.02).expect("a step");
        assert_eq!(simulation.contact_layers(), 0);
        simulation.state_hash()
    };
    assert_eq!(run(true), run(false));
}

/// Bodies without a pair share one velocity where they meet, also where a pair of one of them gives it a field of its
/// own and a surface pushes there.
#[test]
fn a_surface_pushes_bodies_that_stick_together_as_one() {
    for scheme in SCHEMES {
        let stack = Stack {
            scheme,
            along: 0.0,
            friction: (0.0, Some(0.2)),
            plane: 0.0,
        };
        let run = |pieces: bool| {
            let mut scene = stack.scene();
            if pieces {
                // The lower block in two pieces side by side, of which the second has no pair.
                let middle = 1.1;
                let mut piece = scene.bodies[0].clone();
                if let Shape::Cuboid { p2, .. } = &mut scene.bodies[0].shape {
                    p2[0] = middle;
                }
                if let Shape::Cuboid { p1, .. } = &mut piece.shape {
                    p1[0] = middle;
                }
                piece.id = 3;
                scene.bodies.push(piece);
            }
            let mut simulation = stack.simulation(&scene, 1);
            simulation.run_until(0.1).expect("a step");
            let x = simulation.center(1).position;
            let impulse: f64 = (0..simulation.sets().len())
                .map(|set| simulation.surface_impulse(0, set)[2])
                .sum();
            (x, impulse)
        };
        // The sweeps meet the particles in another order, and end with another residue.
        let (whole, in_pieces) = (run(false), run(true));
        for axis in 0..3 {
            let apart = in_pieces.0[axis] - whole.0[axis];
            assert!(apart.abs() < 1e-6 * H, "{scheme:?}: {apart}");
        }
        let ratio = in_pieces.1 / whole.1;
        assert!((ratio - 1.0).abs() < 1e-5, "{scheme:?}: {ratio}");
    }
}

#[test]
fn the_friction_of_a_surface_can_be_changed() {
    let stack = Stack {
        scheme: StressScheme::Usl,
        along: 5.0,
        friction: (0.3, None),
        plane: 0.0,
    };
    let mut simulation = stack.simulation(&stack.scene(), 1);
    simulation.set_surface_friction(0, 0.0).expect("the plane");
    simulation.step(TO).expect("a step");
    let force = simulation.contact_force(0);
    assert!(
        force[2] > 0.0 && force[0].abs() < 1e-12 * force[2],
        "{force:?}"
    );
    for (surface, friction) in [(1, 0.1), (0, -0.1), (0, f64::INFINITY)] {
        assert!(simulation.set_surface_friction(surface, friction).is_err());
    }
}
