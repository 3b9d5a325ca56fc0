//! Warnings of a plan: what mechanics says of a scene before it runs.

use crate::common::{NEO_HOOKEAN, body, cuboid, elastic, empty, material, simulation};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::{
    BaseMotion, BodyBoundary, BoxLoad, Contact, ContactNormal, Damping, Dimension, Enforcement,
    History, InitialStress, Material, MortarContact, Motion, PlaneCondition, RigidLine, Scene,
    Shape, Traction, Vector, Vertices, Weighting,
};

const DIMENSIONS: [Dimension; 2] = [Dimension::Two, Dimension::Three];

fn warnings(scene: &Scene) -> Vec<String> {
    simulation(scene).plan().warnings.clone()
}

fn warns(scene: &Scene, words: &[&str]) -> bool {
    warnings(scene)
        .iter()
        .any(|warning| words.iter().all(|word| warning.contains(word)))
}

/// Stress at the start of [`ground`].
const GROUND_AT_REST: InitialStress = InitialStress::AtRest {
    ratio: 0.5,
    level: 5.0,
    surcharge: 0.0,
};

/// Level ground from side to side, with every plane but the upper one sliding, as is the default.
fn ground(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [20, 14, 6], 1.0);
    let up = dimension.axes() - 1;
    for axis in 0..dimension.axes() {
        scene.mesh.planes[axis] = [PlaneCondition::Sliding; 2];
    }
    scene.mesh.planes[up][1] = PlaneCondition::Free;
    scene.materials = vec![material(elastic(5.0e7, 0.3))];
    let mut top: Vector = [20.0, 14.0, 6.0];
    top[up] = 5.0;
    scene.bodies = vec![body(1, cuboid([0.0; 3], top))];
    scene
}

fn shaken(dimension: Dimension) -> Scene {
    let mut scene = ground(dimension);
    scene.base_motion = Some(BaseMotion {
        axis: dimension.axes() - 1,
        side: 0,
        motion: Motion::Acceleration(History {
            times: vec![0.0, 0.25],
            values: vec![[3.0, 0.0, 0.0], [-3.0, 0.0, 0.0]],
        }),
    });
    scene
}

#[test]
fn sides_that_hold_shaken_ground_are_named() {
    for dimension in DIMENSIONS {
        let scene = shaken(dimension);
        assert!(
            warns(&scene, &["plane_X0", "plane_Xn", "\"antisymmetric\""]),
            "{:?}",
            warnings(&scene)
        );
        for condition in [PlaneCondition::Antisymmetric, PlaneCondition::Free] {
            let mut free = shaken(dimension);
            free.mesh.planes[0] = [condition; 2];
            assert_eq!(warnings(&free), Vec::<String>::new(), "{condition:?}");
        }
        let mut fixed = shaken(dimension);
        fixed.mesh.planes[0] = [PlaneCondition::Free, PlaneCondition::Fixed];
        assert!(warns(&fixed, &["plane_Xn stands still"]));
        // More than a cell away from the sides.
        let mut apart = shaken(dimension);
        let mut top = [18.0, 14.0, 6.0];
        top[dimension.axes() - 1] = 5.0;
        apart.bodies = vec![body(1, cuboid([2.0, 0.0, 0.0], top))];
        assert_eq!(warnings(&apart), Vec::<String>::new());
        // A base that moves along its normal alone takes the sides with it.
        let mut upright = shaken(dimension);
        if let Some(base) = &mut upright.base_motion {
            let mut value = [0.0; 3];
            value[base.axis] = 1.0;
            base.motion = Motion::Velocity(value.into());
        }
        assert_eq!(warnings(&upright), Vec::<String>::new());
    }
}

/// Sides that absorb beside a base that shakes, rigid or compliant, move with free ground; sides that stand still are named.
#[test]
fn sides_that_absorb_beside_a_shaken_base_move_with_it() {
    for dimension in DIMENSIONS {
        let up = dimension.axes() - 1;
        let mut scene = shaken(dimension);
        scene.mesh.planes[0] = [PlaneCondition::Absorbing; 2];
        assert_eq!(warnings(&scene), Vec::<String>::new());
        scene.ground_beyond.incoming = scene.base_motion.take();
        scene.mesh.planes[up][0] = PlaneCondition::Absorbing;
        assert_eq!(warnings(&scene), Vec::<String>::new());
        scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
        let words = ["plane_X0", "still", "\"absorbing\""];
        assert!(warns(&scene, &words), "{:?}", warnings(&scene));
        scene.mesh.planes[0] = [PlaneCondition::Antisymmetric; 2];
        assert_eq!(warnings(&scene), Vec::<String>::new());
    }
}

/// Dashpots hold no weight.
#[test]
fn weight_without_stress_on_dashpots_is_named() {
    for dimension in DIMENSIONS {
        let up = dimension.axes() - 1;
        let mut scene = ground(dimension);
        scene.gravity[up] = -9.81;
        scene.mesh.planes[up][0] = PlaneCondition::Absorbing;
        assert!(
            warns(&scene, &["sinks", "at_rest"]),
            "{:?}",
            warnings(&scene)
        );
        scene.bodies[0].initial_stress = GROUND_AT_REST;
        assert_eq!(warnings(&scene), Vec::<String>::new());
    }
}

#[test]
fn sides_that_carry_weight_are_named() {
    for dimension in DIMENSIONS {
        let up = dimension.axes() - 1;
        let mut scene = ground(dimension);
        scene.gravity[up] = -9.81;
        assert_eq!(warnings(&scene), Vec::<String>::new());
        scene.mesh.planes[0] = [PlaneCondition::Fixed; 2];
        assert!(
            warns(&scene, &["plane_X0 and plane_Xn", "\"sliding\""]),
            "{:?}",
            warnings(&scene)
        );
        // Ground that begins at rest hangs on nothing.
        scene.bodies[0].initial_stress = GROUND_AT_REST;
        assert_eq!(warnings(&scene), Vec::<String>::new());
    }
}

/// Stress at the start that includes weight which is not there, or pushes against a free side.
#[test]
fn stress_out_of_balance_at_the_start_is_measured() {
    for dimension in DIMENSIONS {
        let up = dimension.axes() - 1;
        let with_level = |level: f64| {
            let mut scene = ground(dimension);
            scene.gravity[up] = -9.81;
            scene.bodies[0].initial_stress = InitialStress::AtRest {
                ratio: 0.5,
                level,
                surcharge: 0.0,
            };
            scene
        };
        assert_eq!(warnings(&with_level(5.0)), Vec::<String>::new());
        // Two metres of ground that are not there, over five that are: 40 % of the weight.
        let above = warnings(&with_level(7.0)).join("");
        assert!(
            above.contains("out of balance") && above.contains("level"),
            "{above}"
        );
        let share: f64 = above
            .split(" % of the weight")
            .next()
            .and_then(|text| text.rsplit(' ').next())
            .and_then(|number| number.parse().ok())
            .expect("a share");
        assert!((share - 40.0).abs() < 2.0, "{above}");
        let mut side = with_level(5.0);
        side.mesh.planes[0][1] = PlaneCondition::Free;
        let mut top = [12.0, 14.0, 6.0];
        top[up] = 5.0;
        side.bodies[0].shape = cuboid([0.0; 3], top);
        assert!(
            warns(&side, &["out of balance", "side that is free"]),
            "{:?}",
            warnings(&side)
        );
    }
    // A step of the ground whose toe has the level of its crest.
    let mut toe = ground(Dimension::Two);
    toe.gravity[1] = -9.81;
    toe.bodies = vec![
        body(1, cuboid([0.0; 3], [10.0, 5.0, 0.0])),
        body(2, cuboid([10.0, 0.0, 0.0], [20.0, 3.0, 0.0])),
    ];
    for body in &mut toe.bodies {
        body.initial_stress = GROUND_AT_REST;
    }
    assert!(warns(&toe, &["out of balance", "toe"]));
    // Isotropic pressure in a body that nothing holds.
    let mut free = empty(Dimension::Two, [10, 10, 1], 1.0);
    free.bodies = vec![body(1, cuboid([2.0, 2.0, 0.0], [6.0, 6.0, 0.0]))];
    free.bodies[0].initial_stress = InitialStress::Isotropic(-1.0e3);
    assert!(warns(&free, &["out of balance", "force of the stress"]));
}

fn soft(young: f64) -> Material {
    material(elastic(young, 0.25))
}

/// A block of 4 m x 4 m in a height of 1.5 m above a plane.
fn falling(young: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [16, 14, 1], 0.5);
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    scene.gravity = [0.0, -9.8, 0.0];
    scene.materials = vec![soft(young)];
    scene.bodies = vec![body(1, cuboid([2.0, 1.5, 0.0], [6.0, 5.5, 0.0]))];
    scene
}

#[test]
fn large_strain_of_incremental_elasticity_is_foreseen() {
    let scene = falling(4.0e5);
    // v/c = 5.42/20 and rho g L/E = 0.098.
    assert!(
        warns(
            &scene,
            &["0.37", "stopped from 5.422 m/s", "neo_hookean", "hencky"]
        ),
        "{:?}",
        warnings(&scene)
    );
    assert_eq!(warnings(&falling(4.0e7)), Vec::<String>::new());
    let mut other = falling(4.0e5);
    other.materials = vec![material(NEO_HOOKEAN)];
    assert_eq!(warnings(&other), Vec::<String>::new());
    // Nothing below stops it.
    let mut free = falling(4.0e5);
    free.mesh.planes[1][0] = PlaneCondition::Free;
    assert_eq!(warnings(&free), Vec::<String>::new());

    for (load, expected) in [(1.0e5, true), (1.0e4, false)] {
        let mut pressed = falling(4.0e5);
        pressed.gravity = [0.0; 3];
        pressed.box_loads = vec![BoxLoad {
            p1: [2.0, 5.0, 0.0],
            p2: [6.0, 5.5, 0.0],
            force: [0.0, -4.0 * load, 0.0],
        }];
        assert_eq!(
            warns(&pressed, &["loads on it: 0.25", "hencky"]),
            expected,
            "{:?}",
            warnings(&pressed)
        );
        let mut pulled = falling(4.0e5);
        pulled.gravity = [0.0; 3];
        pulled.tractions = vec![Traction {
            p1: [2.0, 5.5, 0.0],
            p2: [6.0, 5.5, 0.0],
            traction: [0.0, load, 0.0].into(),
        }];
        assert_eq!(warns(&pulled, &["loads on it: 0.25"]), expected);
    }
}

#[test]
fn a_stiff_body_beside_a_soft_one_is_named() {
    let column = |ratio: f64, gap: f64, contact: bool| {
        let mut scene = empty(Dimension::Two, [4, 20, 1], 0.1);
        scene.materials = vec![soft(1.0e6), soft(1.0e6 * ratio)];
        scene.bodies = vec![
            body(1, cuboid([0.0; 3], [0.4, 0.6, 0.0])),
            body(2, cuboid([0.0, 0.6 + gap, 0.0], [0.4, 1.2 + gap, 0.0])),
        ];
        scene.bodies[1].material = 1;
        if contact {
            scene.contacts = vec![Contact {
                name: "pair".into(),
                id: 1,
                friction: 0.0,
                master: 1,
                slave: 2,
                normal: ContactNormal::Master,
            }];
        }
        warns(&scene, &["times as stiff as", "-0.70", "mortar"])
    };
    for contact in [false, true] {
        assert!(column(100.0, 0.0, contact) && column(0.1, 0.0, contact));
        assert!(column(10.0, 0.0, contact));
        assert!(!column(3.0, 0.0, contact) && !column(100.0, 0.25, contact));
    }
}

/// Contact on the grid is right in the rows beside the interface where both bodies end on a line of the mesh.
#[test]
fn an_interface_within_cells_is_named() {
    let column = |theta: f64, weighting: Weighting, gap: f64| {
        let mut scene = empty(Dimension::Two, [4, 20, 1], 0.1);
        scene.weighting = weighting;
        scene.materials = vec![soft(1.0e6)];
        let face = (6.0 + theta) * 0.1;
        scene.bodies = vec![
            body(1, cuboid([0.0; 3], [0.4, face, 0.0])),
            body(
                2,
                cuboid([0.0, face + gap, 0.0], [0.4, face + gap + 0.5, 0.0]),
            ),
        ];
        scene.contacts = vec![Contact {
            name: "pair".into(),
            id: 1,
            friction: 0.0,
            master: 1,
            slave: 2,
            normal: ContactNormal::Master,
        }];
        warns(&scene, &["pair", "beside the interface", "mortar"])
    };
    let (gimp, spline) = (Weighting::UniformGimp, Weighting::QuadraticBSpline);
    assert!(column(0.36, gimp, 0.0) && column(0.0, spline, 0.0));
    assert!(!column(0.0, gimp, 0.0) && !column(0.36, gimp, 0.25));
}

/// A block on a rigid line in mortar contact: ways by which the rows at its face do not carry the pressure.
#[test]
fn ways_of_mortar_contact_without_rows_under_pressure_are_named() {
    let block = |follow: FollowMode, weighting: Weighting, round: bool| {
        let mut scene = empty(Dimension::Two, [8, 12, 1], 0.1);
        scene.weighting = weighting;
        scene.materials = vec![soft(1.0e6)];
        let center = [0.4, 0.533, 0.0];
        let shape = if round {
            Shape::Sphere {
                center,
                radius: 0.3,
            }
        } else {
            cuboid([0.0, 0.233, 0.0], [0.8, 0.833, 0.0])
        };
        scene.bodies = vec![body(1, shape)];
        scene.mortar.boundaries = vec![BodyBoundary {
            body: 1,
            vertices: Vertices::Spacing(0.05),
            follow,
        }];
        scene.mortar.lines = vec![RigidLine {
            name: "line".into(),
            id: 9,
            chains: vec![Chain {
                points: vec![Point::new(0.9, 0.228), Point::new(-0.1, 0.228)],
                side: BoundarySide::Open,
            }],
            motion: None,
        }];
        scene.mortar.contacts = vec![MortarContact {
            name: "contact".into(),
            id: 1,
            master: 9,
            slave: 1,
            friction: 0.0,
            critical_gap: 0.01,
            normal_stiffness: 1.0e5,
            tangential_stiffness: 0.0,
            enforcement: Enforcement::Barrier,
            detection: Detection::Mortar,
        }];
        scene
    };
    let warned = |scene: &Scene, words: &str| warns(scene, &[words, "rows of particles at a face"]);
    let gimp = Weighting::UniformGimp;
    let spin = "\"spin\", the default";
    for follow in [FollowMode::Velocity, FollowMode::Spin, FollowMode::Gradient] {
        assert!(!warned(&block(follow, gimp, false), ""));
    }
    for follow in [FollowMode::Material, FollowMode::Unaugmented] {
        assert!(warned(&block(follow, gimp, false), spin));
        // Behind a round face no row is at it.
        assert!(!warned(&block(follow, gimp, true), ""));
        let mut apart = block(follow, gimp, false);
        apart.mortar.contacts.clear();
        assert!(!warned(&apart, ""));
    }
    let linear = block(FollowMode::Spin, Weighting::Linear, false);
    assert!(warned(&linear, "quadratic_bspline"));
}

/// Discs that bounced back with 0.78 to 0.89 of their speed on eight cells, where 0.936 is right, and with 0.87 to 0.92 on sixteen.
#[test]
fn round_bodies_that_collide_on_few_cells_are_named() {
    let words = ["body 1", "cells across", "collides"];
    let discs = |h: f64, velocity: f64| {
        let cells = |length: f64| (length / h).round() as usize;
        let mut scene = empty(Dimension::Two, [cells(1.6), cells(1.0), 1], h);
        scene.materials = vec![material(elastic(1e5, 0.3))];
        let disc = |id: i64, x: f64| {
            let center = [x, 0.5, 0.0];
            body(
                id,
                Shape::Sphere {
                    center,
                    radius: 0.2,
                },
            )
        };
        scene.bodies = vec![disc(1, 0.5), disc(2, 1.1)];
        scene.bodies[0].velocity = [velocity, 0.0, 0.0];
        scene.contacts = vec![Contact {
            name: "contact".into(),
            id: 1,
            friction: 0.0,
            master: 1,
            slave: 2,
            normal: ContactNormal::Collinear,
        }];
        scene
    };
    assert!(warns(&discs(0.05, 1.0), &words));
    assert!(warns(&discs(0.05, 1.0), &["body 2", "cells across"]));
    for enough in [discs(0.025, 1.0), discs(0.05, 0.0)] {
        assert!(!warns(&enough, &words));
    }
    let mut damped = discs(0.05, 1.0);
    damped.damping = Damping::Local { alpha: 0.1 };
    assert!(!warns(&damped, &words));
}

/// A traction on a plane that holds what is there moves nothing, as on the planes of a scene that names none.
#[test]
fn a_load_on_a_plane_that_holds_is_foreseen() {
    let words = &["traction[0]", "plane_Yn", "moves nothing"];
    let loaded = |plane: PlaneCondition, traction: Vector| {
        let mut scene = ground(Dimension::Two);
        scene.mesh.cells[1] = 5;
        scene.mesh.planes[1][1] = plane;
        scene.tractions = vec![Traction {
            p1: [0.0, 5.0, 0.0],
            p2: [20.0, 5.0, 0.0],
            traction: traction.into(),
        }];
        warns(&scene, words)
    };
    let (down, along) = ([0.0, -1e3, 0.0], [1e3, 0.0, 0.0]);
    assert!(loaded(PlaneCondition::Sliding, down));
    assert!(loaded(PlaneCondition::Fixed, along));
    assert!(!loaded(PlaneCondition::Free, down));
    assert!(!loaded(PlaneCondition::Sliding, along));
}
