//! Loads, moving planes and driven bodies.

use crate::common::{
    DIMENSIONS, NEVER, SCHEMES, WEIGHTINGS, block, body, cuboid, elastic, empty, material, options,
    particles, run, simulation,
};
use proctor_scene::simulation::{
    BaseVelocity, EventKind, Options, SetupError, Simulation, StepErrorKind,
};
use proctor_scene::{
    BaseMotion, BoxLoad, Dimension, HeldBox, History, Motion, Outside, PlaneCondition, PointLoad,
    Scene, TimeStep, Traction, Vector, Weighting,
};
use proptest::prelude::*;

/// A block that fills whole cells, so that its surface nodes carry mass.
fn aligned(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [9, 8, 7], 0.1);
    scene.bodies = vec![body(1, cuboid([0.2; 3], [0.7, 0.5, 0.5]))];
    scene
}

/// Force on a free body, from its momentum after the first half step.
fn force(simulation: &mut Simulation) -> Vector {
    let before = simulation.momentum();
    let dt = simulation.step(NEVER).expect("the step is sound").dt;
    let after = simulation.momentum();
    std::array::from_fn(|axis| (after[axis] - before[axis]) / (0.5 * dt))
}

fn close(a: &Vector, b: &Vector, scale: f64) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| (a - b).abs() <= 1.0e-12 * scale)
}

proptest! {
    #![proptest_config(crate::common::cases(40))]

    #[test]
    fn a_traction_gives_area_times_traction(
        a in 0.2..0.7_f64, b in 0.2..0.7_f64, c in 0.2..0.5_f64, d in 0.2..0.5_f64, shift in prop_oneof![Just(0.0), Just(1.0e6), Just(-3.7)],
    ) {
        prop_assume!((a - b).abs() > 1.0e-3 && (c - d).abs() > 1.0e-3);
        for dimension in DIMENSIONS {
            for weighting in WEIGHTINGS {
                let mut scene = aligned(dimension);
                scene.weighting = weighting;
                let three = dimension == Dimension::Three;
                // On the upper face y = 0.5; cells are cut at both ends.
                let mut load = Traction {
                    p1: [f64::min(a, b), 0.5, if three { f64::min(c, d) } else { 0.0 }],
                    p2: [f64::max(a, b), 0.5, if three { f64::max(c, d) } else { 0.0 }],
                    traction: [30.0, -70.0, if three { 20.0 } else { 0.0 }].into(),
                };
                scene.mesh.origin = [shift, -shift, if three { shift } else { 0.0 }];
                let origin = scene.mesh.origin;
                let proctor_scene::Shape::Cuboid { p1, p2 } = &mut scene.bodies[0].shape else {
                    unreachable!("a cuboid")
                };
                for corner in [p1, p2, &mut load.p1, &mut load.p2] {
                    for axis in 0..3 {
                        corner[axis] += origin[axis];
                    }
                }
                let area = (load.p2[0] - load.p1[0]) * if three { load.p2[2] - load.p1[2] } else { 1.0 };
                let traction = load.traction.values[0];
                scene.tractions = vec![load];
                let exact = traction.map(|t| t * area);
                let found = force(&mut simulation(&scene));
                // At 1e6 m the edges themselves are good to 1.2e-10 m.
                let scale = 70.0 * (area + 1.0e3 * shift.abs() * f64::EPSILON / 1.0e-12);
                prop_assert!(close(&found, &exact, scale), "{weighting:?} {found:?} {exact:?}");
            }
        }
    }

    #[test]
    fn a_box_load_gives_its_force(x in 0.2..0.6, y in 0.2..0.4) {
        for dimension in DIMENSIONS {
            let mut scene = aligned(dimension);
            let third = if dimension == Dimension::Two { 0.0 } else { 40.0 };
            scene.box_loads = vec![
                BoxLoad { p1: [x, y, 0.0], p2: [x + 0.1, y + 0.1, 1.0], force: [10.0, -20.0, third] },
                BoxLoad { p1: [0.0; 3], p2: [1.0; 3], force: [1.0, 2.0, 0.0] },
            ];
            let found = force(&mut simulation(&scene));
            prop_assert!(close(&found, &[11.0, -18.0, third], 40.0), "{found:?}");
        }
    }
}

#[test]
fn a_nodal_load_gives_its_force_and_its_work() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = aligned(dimension);
            scene.scheme = scheme;
            let z = if dimension == Dimension::Two {
                0.0
            } else {
                0.4
            };
            // Two loads on one node and one on another.
            let at = |x: f64, fx: f64| PointLoad {
                position: [x, 0.4, z],
                force: [fx, 5.0, 0.0],
            };
            scene.point_loads = vec![at(0.4, 1.0), at(0.5, 2.0), at(0.4, 4.0)];
            let mut simulation = simulation(&scene);
            let found = force(&mut simulation);
            assert!(close(&found, &[7.0, 15.0, 0.0], 15.0), "{found:?}");
            run(&mut simulation, 40);
            let energy = simulation.energy();
            assert!(energy.external_work > 0.0 && energy.kinetic > 0.0);
            // What the loads put in is in the body, but for the part at the scale of a cell around the loaded
            // nodes, which particles do not carry: USL loses 0.116 of the work.
            assert!(
                energy.dissipated.abs() < 0.15 * energy.external_work,
                "{scheme:?} {energy:?}"
            );
        }
    }
}

#[test]
fn a_load_on_an_empty_node_is_an_error() {
    let mut scene = aligned(Dimension::Three);
    scene.point_loads = vec![PointLoad {
        position: [0.8, 0.6, 0.1],
        force: [1.0, 0.0, 0.0],
    }];
    let error = simulation(&scene)
        .step(NEVER)
        .expect_err("nobody carries the load");
    let StepErrorKind::LoadOnEmptyNode { load, position } = error.kind else {
        panic!("{error}")
    };
    assert_eq!(load.as_deref(), Some("nodal_point_load[0]"));
    assert!(close(&position, &[0.8, 0.6, 0.1], 1.0), "{position:?}");

    scene.point_loads[0].position = [0.83, 0.6, 0.1];
    let error = Simulation::new(&scene, &options())
        .err()
        .expect("not at a node");
    assert!(matches!(error, SetupError::Load { .. }), "{error}");
}

/// A body that flies away from its load: the node keeps old numbers, and they must not swallow it.
#[test]
fn a_load_that_the_body_left_behind_is_an_error() {
    for dimension in DIMENSIONS {
        let mut scene = empty(dimension, [30, 6, 6], 0.1);
        scene.bodies = vec![body(1, cuboid([0.2; 3], [0.5, 0.4, 0.4]))];
        scene.bodies[0].velocity = [20.0, 0.0, 0.0];
        let z = if dimension == Dimension::Two {
            0.0
        } else {
            0.3
        };
        scene.point_loads = vec![PointLoad {
            position: [0.2, 0.3, z],
            force: [0.0, 1.0e-6, 0.0],
        }];
        let mut simulation = simulation(&scene);
        let mut result = Ok(());
        while simulation.time() < 0.09 && result.is_ok() {
            result = simulation.step(0.09).map(|_| ());
        }
        let error = result.expect_err("the body has left");
        assert!(
            matches!(error.kind, StepErrorKind::LoadOnEmptyNode { .. }),
            "{error}"
        );
        // The last particle, 0.225 m at first, is beyond the reach of the node at 0.325 m.
        assert!(error.time < 0.02, "found late: {error}");
    }
}

/// As above where the last particle is removed and the rows are sorted in the same step: the node drops out of use
/// while it still holds a mass.
#[test]
fn a_load_whose_particles_were_removed_is_an_error() {
    for dimension in DIMENSIONS {
        let mut scene = empty(dimension, [8, 5, 4], 0.1);
        scene.materials = vec![material(elastic(1.0, 0.0))];
        scene.outside = Outside::Remove;
        scene.bodies = vec![
            body(1, cuboid([0.1, 0.1, 0.1], [0.2, 0.3, 0.2])),
            body(2, cuboid([0.7, 0.1, 0.1], [0.8, 0.3, 0.2])),
        ];
        // Half a cell per step: sorted in every step.
        scene.time_step = TimeStep::Fixed {
            dt: 0.01,
            allow_unstable: true,
        };
        for body in &mut scene.bodies {
            body.velocity = [5.0, 0.0, 0.0];
        }
        let z = if dimension == Dimension::Two {
            0.0
        } else {
            0.1
        };
        scene.point_loads = vec![PointLoad {
            position: [0.8, 0.2, z],
            force: [0.0, 1.0e-9, 0.0],
        }];
        let mut simulation = simulation(&scene);
        let mut result = Ok(());
        while simulation.steps() < 8 && result.is_ok() {
            result = simulation.step(NEVER).map(|_| ());
        }
        let error = result.expect_err("the body is gone");
        assert!(
            matches!(error.kind, StepErrorKind::LoadOnEmptyNode { .. }),
            "{error}"
        );
        assert_eq!(
            simulation.sets()[1].len(),
            0,
            "body 2 must be gone: {error}"
        );
        assert!(error.step <= 6, "found late: {error}");
    }
}

#[test]
fn a_driven_body_pushes_another() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = empty(dimension, [16, 5, 5], 0.1);
            scene.scheme = scheme;
            scene.bodies = vec![
                body(1, cuboid([0.2, 0.1, 0.1], [0.4, 0.3, 0.3])),
                body(2, cuboid([0.4, 0.1, 0.1], [0.7, 0.3, 0.3])),
            ];
            scene.bodies[0].motion = Some(History {
                times: vec![0.0, 0.02],
                values: vec![[0.0; 3], [1.0, 0.0, 0.0]],
            });
            let mut simulation = simulation(&scene);
            simulation.run_until(0.1).expect("the step is sound");
            // Ramp of 0.02 s to 1 m/s, then constant: 0.01 + 0.08 m; the trapezoidal rule of midpoints is exact
            // but for the step across the corner.
            let center = simulation.center(0);
            let (x, v) = (center.position, center.velocity);
            assert!((x[0] - (0.3 + 0.09)).abs() < 2.0e-4, "{x:?}");
            assert!((v[0] - 1.0).abs() < 1.0e-12, "{v:?}");
            let center = simulation.center(1);
            let (x, v) = (center.position, center.velocity);
            // Pushed, elastically: it cannot be overtaken and has swung about the same velocity.
            assert!(x[0] > 0.55 + 0.05 && v[0] > 0.3, "{scheme:?} {x:?} {v:?}");
        }
    }
}

fn ramp(acceleration: bool) -> Motion {
    let history = History {
        times: vec![0.0, 0.01, 0.02],
        values: vec![[0.0; 3], [1.0, 0.2, 0.0], [0.0, 0.4, 0.0]],
    };
    if acceleration {
        Motion::Acceleration(history)
    } else {
        Motion::Velocity(history)
    }
}

#[test]
fn a_record_is_integrated_exactly() {
    let base = BaseVelocity::new(&ramp(true));
    // a = 100 t up to 0.01 s, then back: v = 50 t².
    for (t, v) in [
        (-1.0, 0.0),
        (0.005, 50.0 * 0.005_f64.powi(2)),
        (0.01, 0.005),
        (0.02, 0.01),
        (5.0, 0.01),
    ] {
        assert!((base.at(t)[0] - v).abs() < 1.0e-16, "{t}: {:?}", base.at(t));
    }
    let base = BaseVelocity::new(&ramp(false));
    for (t, v) in [
        (-1.0, 0.0),
        (0.005, 0.5),
        (0.015, 0.5),
        (0.02, 0.0),
        (5.0, 0.0),
    ] {
        assert!((base.at(t)[0] - v).abs() < 1.0e-15, "{t}: {:?}", base.at(t));
    }
    assert!((base.end() - 0.02).abs() < 1.0e-18);
}

/// The nodes of the plane move as told, and what stands on it follows; the end of the record is an event.
#[test]
fn a_moving_base_carries_a_body() {
    for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
        for scheme in SCHEMES {
            let mut scene = empty(Dimension::Two, [8, 6, 1], 0.1);
            (scene.weighting, scene.scheme) = (weighting, scheme);
            scene.bodies = vec![body(1, cuboid([0.2, 0.0, 0.0], [0.5, 0.1, 0.0]))];
            scene.mesh.planes[1][0] = PlaneCondition::Sliding;
            scene.base_motion = Some(BaseMotion {
                axis: 1,
                side: 0,
                motion: Motion::Velocity(History {
                    times: vec![0.0, 0.05],
                    values: vec![[0.0; 3], [0.5, 0.0, 0.0]],
                }),
            });
            let mut simulation = simulation(&scene);
            let mut ended = vec![];
            while simulation.time() < 0.2 {
                let info = simulation.step(0.2).expect("the step is sound");
                ended.extend(simulation.events().iter().skip(ended.len()).cloned());
                if info.time < 0.05 {
                    assert!(ended.is_empty());
                }
            }
            assert_eq!(ended.len(), 1, "{ended:?}");
            assert_eq!(ended[0].kind, EventKind::RecordEnded);
            assert!((ended[0].time - 0.05).abs() < 4.0e-3, "{ended:?}");
            // A flat body of one cell follows with the speed of shear waves: its mean displacement is that of
            // the base, 0.0125 + 0.075 m, but for a swing of a few mm.
            let center = simulation.center(0);
            let (x, v) = (center.position, center.velocity);
            assert!(
                (x[0] - 0.35 - 0.0875).abs() < 5.0e-3,
                "{weighting:?} {scheme:?} {x:?} {v:?}"
            );
            // The base has put in the kinetic energy, to what the scheme loses.
            let energy = simulation.energy();
            assert!(energy.external_work > 0.5 * energy.kinetic, "{energy:?}");
        }
    }
}

#[test]
fn displacement_is_kept_where_it_is_asked_for() {
    let scene = block(Dimension::Two);
    let simulation = Simulation::new(
        &scene,
        &Options {
            displacement: true,
            ..options()
        },
    )
    .expect("sound");
    assert_eq!(simulation.displacement(0, 0), Some([0.0; 3]));
    assert!(
        crate::common::simulation(&scene)
            .displacement(0, 0)
            .is_none()
    );
    assert_eq!(particles(&simulation).len(), simulation.particles());
}

#[test]
fn nodes_in_a_held_box_stand_still() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = aligned(dimension);
            scene.scheme = scheme;
            scene.gravity = [1.0, -10.0, 0.0];
            // The left face, and two boxes that share nodes with it.
            let held = |p1, p2| HeldBox { p1, p2 };
            scene.held_boxes = vec![
                held([0.1, 0.1, 0.0], [0.2, 0.6, 0.6]),
                held([0.2, 0.2, 0.0], [0.2, 0.2, 0.6]),
                held([0.6, 0.4, 0.2], [0.6, 0.4, 0.4]),
            ];
            let mut simulation = simulation(&scene);
            run(&mut simulation, 20);
            let (mut still, mut moving) = (0, 0);
            for node in simulation.node_values() {
                let [x, y, z] = node.position;
                let within = |held: &HeldBox| {
                    let axes = dimension.axes();
                    (0..axes).all(|a| {
                        let at = [x, y, z][a];
                        held.p1[a] - 1e-9 <= at && at <= held.p2[a] + 1e-9
                    })
                };
                if scene.held_boxes.iter().any(within) {
                    assert_eq!(node.velocity, [0.0; 3], "{scheme:?} {node:?}");
                    still += 1;
                } else {
                    assert!(node.velocity != [0.0; 3], "{scheme:?} {node:?}");
                    moving += 1;
                }
            }
            assert!(still > 5 && moving > 10, "{still} {moving}");
        }
    }
}

#[test]
fn a_body_that_is_held_all_over_does_not_move() {
    let mut scene = aligned(Dimension::Two);
    scene.gravity = [0.0, -10.0, 0.0];
    scene.held_boxes = vec![HeldBox {
        p1: [0.0; 3],
        p2: [0.9, 0.8, 0.0],
    }];
    let mut simulation = simulation(&scene);
    let before = particles(&simulation);
    run(&mut simulation, 5);
    assert_eq!(particles(&simulation), before);
}

/// A traction that grows over two seconds and stays: the momentum of a free block is its integral, whatever the scheme.
#[test]
fn a_traction_that_changes_gives_its_integral() {
    const END: f64 = 3.0e-2;
    for scheme in SCHEMES {
        let mut scene = aligned(Dimension::Two);
        scene.scheme = scheme;
        scene.tractions = vec![Traction {
            p1: [0.2, 0.5, 0.0],
            p2: [0.7, 0.5, 0.0],
            traction: History {
                times: vec![0.0, 1.0e-2, 2.0e-2],
                values: vec![[0.0; 3], [0.0, -40.0, 0.0], [10.0, 0.0, 0.0]],
            },
        }];
        let mut simulation = simulation(&scene);
        simulation.run_until(END).expect("a step");
        let momentum = simulation.momentum();
        // Velocities are those half a step before the end.
        let late = simulation.velocity_time();
        let width = 0.5;
        let exact = [
            width * 10.0 * (0.5e-2 + late - 2.0e-2),
            width * -40.0 * 1.0e-2,
            0.0,
        ];
        for axis in 0..2 {
            let off = (momentum[axis] - exact[axis]).abs();
            assert!(
                off < 2e-3 * width * 40.0 * 1.0e-2,
                "{scheme:?} {momentum:?} {exact:?}"
            );
        }
    }
}
