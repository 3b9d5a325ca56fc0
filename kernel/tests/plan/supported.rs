//! Warnings about bodies that rest on a driven body or a rigid line: rows of particles that do not carry the pressure evenly.

use crate::common::{body, cuboid, elastic, empty, material, simulation};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::{
    BodyBoundary, Contact, ContactNormal, Damping, Dimension, DomainUpdate, Enforcement, History,
    InitialStress, MortarContact, PlaneCondition, RigidLine, Scene, StressScheme, Transfer,
    TransferKind, Vertices, Weighting,
};

const SPLINE: Weighting = Weighting::QuadraticBSpline;
const GIMP: Weighting = Weighting::UniformGimp;
const STRETCHES: Weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);

fn warns(scene: &Scene, words: &[&str]) -> bool {
    let simulation = simulation(scene);
    let mut warnings = simulation.plan().warnings.iter();
    warnings.any(|warning| words.iter().all(|word| warning.contains(word)))
}

/// A block on a driven plate in contact, its face and its sides at these places in cells of 0.1 m, with free sides.
fn block(low: [f64; 2], high: [f64; 2]) -> Scene {
    let mut scene = empty(Dimension::Two, [9, 16, 1], 0.1);
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    let at = |[x, y]: [f64; 2]| [0.1 * x, 0.1 * y, 0.0];
    scene.bodies = vec![
        body(1, cuboid([0.0; 3], at([9.0, low[1]]))),
        body(2, cuboid(at(low), at(high))),
    ];
    scene.bodies[0].motion = Some(History::from([0.0; 3]));
    scene.contacts = vec![Contact {
        name: "contact".into(),
        id: 1,
        friction: 0.0,
        master: 1,
        slave: 2,
        normal: ContactNormal::Master,
    }];
    scene
}

/// The same between sliding sides.
fn column(face: f64, height: f64) -> Scene {
    let mut scene = block([0.0, face], [2.0, face + height]);
    scene.mesh.cells[0] = 2;
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.bodies[0].shape = cuboid([0.0; 3], [0.2, 0.1 * face, 0.0]);
    scene
}

/// A driven body that moves acts at nodes without a contact, and with USF; one in contact, and one that stands, by its shape.
#[test]
fn driven_bodies_that_move_at_nodes_are_named() {
    let words = ["body 1", "up to a cell beyond its faces", "body 2"];
    let scene = |scheme: StressScheme, contact: bool, velocity: f64| {
        let mut scene = block([2.3, 2.4], [6.7, 9.1]);
        scene.scheme = scheme;
        scene.bodies[0].motion = Some(History::from([0.0, velocity, 0.0]));
        if !contact {
            scene.contacts.clear();
        }
        scene
    };
    for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
        let usf = scheme == StressScheme::Usf;
        assert!(warns(&scene(scheme, false, 0.1), &words), "{scheme:?}");
        assert!(!warns(&scene(scheme, false, 0.0), &words), "{scheme:?}");
        assert_eq!(warns(&scene(scheme, true, 0.1), &words), usf, "{scheme:?}");
        assert!(!warns(&scene(scheme, true, 0.0), &words), "{scheme:?}");
        // More than a cell apart.
        let mut apart = scene(scheme, false, 0.1);
        apart.bodies[1].shape = cuboid([0.23, 0.35, 0.0], [0.67, 0.91, 0.0]);
        assert!(!warns(&apart, &words), "{scheme:?}");
    }
}

/// Rows of generated scenes that were off by 3.9 %, 3.0 %, at the interface 5.6 % and 2.2 % of the pressure, and of others that
/// were not by 1 %.
#[test]
fn rows_of_splines_that_are_no_whole_number_in_a_cell_are_named() {
    let words = ["no whole number in one", "\"GIMP\""];
    for (face, height) in [
        (2.0, 7.004),
        (2.43, 5.511),
        (2.25, 5.079),
        (2.36784, 5.54884),
    ] {
        for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
            let mut scene = column(face, height);
            (scene.weighting, scene.scheme) = (SPLINE, scheme);
            assert!(warns(&scene, &words), "{face} {height}");
            // Upside down it is the same column.
            scene.bodies[0].shape = cuboid([0.0, 0.1 * (16.0 - face), 0.0], [0.2, 1.6, 0.0]);
            let end = 0.1 * (16.0 - face - height);
            scene.bodies[1].shape = cuboid([0.0, end, 0.0], [0.2, 0.1 * (16.0 - face), 0.0]);
            assert!(warns(&scene, &words), "{face} {height}");
            scene.weighting = GIMP;
            assert!(!warns(&scene, &words), "{face} {height}");
        }
    }
    for (face, height) in [(2.0, 7.0), (2.36, 6.5), (2.75, 6.36)] {
        let mut scene = column(face, height);
        scene.weighting = SPLINE;
        assert!(!warns(&scene, &words), "{face} {height}");
    }
}

#[test]
fn a_free_side_a_little_beyond_a_line_is_named() {
    let words = ["its nodes are light", "half way between two"];
    let warned = |weighting: Weighting, scheme: StressScheme, right: f64, time: f64| {
        let mut scene = block([2.0, 2.883], [right, 9.5]);
        (scene.weighting, scene.scheme, scene.time) = (weighting, scheme, time);
        warns(&scene, &words)
    };
    // A wave crosses 366 cells in a second.
    for (weighting, scheme) in [
        (STRETCHES, StressScheme::Musl),
        (STRETCHES, StressScheme::Usf),
        (GIMP, StressScheme::Usl),
        (SPLINE, StressScheme::Usl),
    ] {
        assert!(
            warned(weighting, scheme, 4.25, 1.0),
            "{weighting:?} {scheme:?}"
        );
        assert!(
            !warned(weighting, scheme, 4.5, 1.0),
            "{weighting:?} {scheme:?}"
        );
        assert!(
            !warned(weighting, scheme, 4.25, 0.1),
            "{weighting:?} {scheme:?}"
        );
    }
    // Under USL and damping contact goes on from the impulses of the last step.
    let mut damped = block([2.0, 2.883], [4.25, 9.5]);
    damped.scheme = StressScheme::Usl;
    damped.damping = Damping::Local { alpha: 0.5 };
    assert!(!warns(&damped, &words));
    assert!(!warned(GIMP, StressScheme::Usf, 4.25, 1.0));
    assert!(!warned(SPLINE, StressScheme::Musl, 4.25, 1.0));
}

#[test]
fn flip_that_keeps_swinging_under_damping_is_named() {
    let words = ["keep swinging", "\"APIC\""];
    let viscous = Damping::Viscous { alpha: 0.3 };
    let warned = |kind: TransferKind, scheme: StressScheme, poisson: f64, damping: Damping| {
        let mut scene = block([2.0, 2.0], [4.5, 9.0]);
        scene.materials = vec![material(elastic(1.0e6, poisson))];
        (scene.transfer, scene.scheme) = (Transfer::new(kind), scheme);
        scene.transfer.pic_fraction = if kind == TransferKind::Flip { 0.0 } else { 1.0 };
        scene.damping = damping;
        warns(&scene, &words)
    };
    for scheme in [StressScheme::Musl, StressScheme::Usf] {
        assert!(warned(TransferKind::Flip, scheme, 0.3, viscous));
        assert!(!warned(TransferKind::Flip, scheme, 0.1, viscous));
        assert!(!warned(TransferKind::Apic, scheme, 0.3, viscous));
        let local = Damping::Local { alpha: 0.5 };
        assert!(!warned(TransferKind::Flip, scheme, 0.3, local));
    }
    assert!(!warned(TransferKind::Flip, StressScheme::Usl, 0.3, viscous));
    // Ground under its weight, whose surface ends a little beyond a line.
    let ground = |height: f64, start: InitialStress| {
        let mut scene = empty(Dimension::Two, [2, 10, 1], 0.1);
        scene.materials = vec![material(elastic(1.0e6, 0.1))];
        scene.bodies = vec![body(1, cuboid([0.0; 3], [0.2, 0.1 * height, 0.0]))];
        scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
        scene.mesh.planes[1][0] = PlaneCondition::Sliding;
        scene.gravity = [0.0, -10.0, 0.0];
        (scene.scheme, scene.damping) = (StressScheme::Usf, viscous);
        scene.bodies[0].initial_stress = start;
        warns(&scene, &words)
    };
    assert!(ground(5.107, InitialStress::None));
    assert!(!ground(5.0, InitialStress::None) && !ground(5.5, InitialStress::None));
    let at_rest = InitialStress::AtRest {
        ratio: 0.5,
        level: 0.5107,
        surcharge: 0.0,
    };
    assert!(!ground(5.107, at_rest));
}

#[test]
fn domains_that_pass_a_line_to_and_fro_are_named() {
    let words = ["to and fro", "strain the first rows"];
    let on_line = |weighting: Weighting, scheme: StressScheme, face: f64| {
        let mut scene = empty(Dimension::Two, [3, 14, 1], 0.1);
        scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
        scene.materials = vec![material(elastic(1.0e6, 0.3))];
        (scene.weighting, scene.scheme) = (weighting, scheme);
        let (low, high) = (0.1 * face, 0.1 * (face + 8.0));
        scene.bodies = vec![body(1, cuboid([0.0, low, 0.0], [0.3, high, 0.0]))];
        scene.mortar.boundaries = vec![BodyBoundary {
            body: 1,
            vertices: Vertices::Spacing(0.05),
            follow: FollowMode::Spin,
        }];
        let level = low - 0.006;
        scene.mortar.lines = vec![RigidLine {
            name: "line".into(),
            id: 9,
            chains: vec![Chain {
                points: vec![Point::new(0.4, level), Point::new(-0.1, level)],
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
        warns(&scene, &words)
    };
    assert!(on_line(STRETCHES, StressScheme::Usl, 2.0));
    assert!(on_line(GIMP, StressScheme::Usl, 2.0));
    assert!(
        !on_line(STRETCHES, StressScheme::Usl, 2.3) && !on_line(SPLINE, StressScheme::Usl, 2.0)
    );
    assert!(on_line(GIMP, StressScheme::Musl, 2.97) && !on_line(GIMP, StressScheme::Musl, 2.8));
    // On a driven body between sliding sides.
    let driven = |face: f64| {
        let mut scene = column(face, 6.0);
        scene.weighting = STRETCHES;
        warns(&scene, &words)
    };
    assert!(driven(2.0) && !driven(2.5));
}

/// Walls on lines of the mesh act at nodes; those within cells, and walls that carry little, leave rows as they should be.
#[test]
fn ground_between_driven_walls_on_lines_of_the_mesh_is_named() {
    let words = ["stands between driven bodies", "a tenth of a cell"];
    let walls = |[low, high]: [f64; 2], poisson: f64| {
        let mut scene = empty(Dimension::Two, [9, 16, 1], 0.1);
        scene.materials = vec![material(elastic(1.0e6, poisson))];
        let cells =
            |x: [f64; 2], y: f64| cuboid([0.1 * x[0], 0.0, 0.0], [0.1 * x[1], 0.1 * y, 0.0]);
        scene.bodies = vec![
            body(1, cells([low, high], 12.0)),
            body(2, cells([low - 2.0, low], 13.0)),
            body(3, cells([high, high + 2.0], 13.0)),
        ];
        for wall in &mut scene.bodies[1..] {
            wall.motion = Some(History::from([0.0; 3]));
        }
        scene.gravity[1] = -10.0;
        scene.damping = Damping::Local { alpha: 0.7 };
        scene
    };
    for (scheme, weighting, named) in [
        (StressScheme::Musl, GIMP, true),
        (StressScheme::Usf, STRETCHES, true),
        (StressScheme::Musl, SPLINE, true),
        (StressScheme::Usl, GIMP, true),
        (StressScheme::Usl, STRETCHES, true),
        (StressScheme::Usl, SPLINE, false),
    ] {
        let told = |faces: [f64; 2], poisson: f64| {
            let mut scene = walls(faces, poisson);
            (scene.scheme, scene.weighting) = (scheme, weighting);
            warns(&scene, &words)
        };
        assert_eq!(told([2.0, 5.0], 0.4), named, "{scheme:?} {weighting:?}");
        assert!(!told([2.0, 5.0], 0.3), "walls that carry little");
        assert!(!told([2.1, 5.1], 0.4), "walls within cells");
        let mut damped = walls([2.0, 5.0], 0.4);
        (damped.scheme, damped.weighting) = (scheme, weighting);
        damped.damping = Damping::Viscous { alpha: 0.1 };
        assert!(!warns(&damped, &words), "viscous damping");
    }
}

/// A block in space that is less than two cells wide has hardly any other nodes than light ones.
#[test]
fn narrow_blocks_in_space_that_keep_swinging_are_named() {
    let words = ["keep swinging"];
    let told = |wide: f64, transfer: TransferKind, scheme: StressScheme| {
        let mut scene = empty(Dimension::Three, [9, 9, 14], 0.1);
        scene.materials = vec![material(elastic(1.0e6, 0.1))];
        let high = 0.1 * (3.5 + wide);
        scene.bodies = vec![
            body(1, cuboid([0.0; 3], [0.9, 0.9, 0.25])),
            body(2, cuboid([0.35, 0.35, 0.25], [high, 0.65, 1.05])),
        ];
        scene.bodies[0].motion = Some(History::from([0.0; 3]));
        scene.damping = Damping::Local { alpha: 0.7 };
        (scene.transfer, scene.scheme) = (Transfer::new(transfer), scheme);
        warns(&scene, &words)
    };
    for scheme in [StressScheme::Musl, StressScheme::Usf] {
        assert!(told(1.7, TransferKind::Flip, scheme));
        assert!(!told(2.2, TransferKind::Flip, scheme));
        assert!(!told(1.7, TransferKind::Apic, scheme));
    }
    assert!(!told(1.7, TransferKind::Flip, StressScheme::Usl));
}
