//! Mirrored and permuted scenes.
//!
//! Results agree to round-off, not bit by bit: the base node floor(x/h - 1/2) sees a mirrored particle from the
//! other side, so that its weights come from other differences, the middle one takes what the outer ones leave,
//! and the sums over nodes and particles run in another order.

use crate::common::{
    APIC, DIMENSIONS, FLIP, NEVER, YOUNG, body, calm, cuboid, distance, empty, light_nodes_act,
    options, particles, weightings_and_schemes,
};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Dimension, PlaneCondition, PointLoad, Scene, Shape, Vector};
use std::sync::Arc;

const H: f64 = 0.1;
/// Cells of the mesh, different along every axis.
const CELLS: [usize; 3] = [7, 6, 5];

/// A reflection or permutation of axes that takes the mesh onto another mesh: component `axis` of the image is
/// component `from[axis]` of the original, mirrored where `flip[axis]` says.
#[derive(Clone, Copy, Debug)]
struct Change {
    from: [usize; 3],
    flip: [bool; 3],
}

impl Change {
    /// Image of a vector.
    fn vector(&self, v: &Vector) -> Vector {
        std::array::from_fn(|axis| {
            if self.flip[axis] {
                -v[self.from[axis]]
            } else {
                v[self.from[axis]]
            }
        })
    }

    /// Image of a position in the original mesh.
    fn position(&self, x: &Vector) -> Vector {
        std::array::from_fn(|axis| {
            let c = x[self.from[axis]];
            if self.flip[axis] {
                CELLS[self.from[axis]] as f64 * H - c
            } else {
                c
            }
        })
    }

    /// Original of a position in the image.
    fn original(&self, y: &Vector) -> Vector {
        let mut x = [0.0; 3];
        for axis in 0..3 {
            let from = self.from[axis];
            x[from] = if self.flip[axis] {
                CELLS[from] as f64 * H - y[axis]
            } else {
                y[axis]
            };
        }
        x
    }

    /// Image of a symmetric tensor xx, yy, zz, yz, xz, xy.
    fn tensor(&self, s: &[f64; 6]) -> [f64; 6] {
        let m = [[s[0], s[5], s[4]], [s[5], s[1], s[3]], [s[4], s[3], s[2]]];
        let sign = |axis: usize| if self.flip[axis] { -1.0 } else { 1.0 };
        let entry = |a: usize, b: usize| sign(a) * sign(b) * m[self.from[a]][self.from[b]];
        [
            entry(0, 0),
            entry(1, 1),
            entry(2, 2),
            entry(1, 2),
            entry(0, 2),
            entry(0, 1),
        ]
    }

    fn scene(&self, scene: &Scene) -> Scene {
        let mut image = scene.clone();
        image.gravity = self.vector(&scene.gravity);
        for axis in 0..3 {
            image.mesh.cells[axis] = scene.mesh.cells[self.from[axis]];
            image.mesh.planes[axis] = scene.mesh.planes[self.from[axis]];
            if self.flip[axis] {
                image.mesh.planes[axis].reverse();
            }
        }
        for body in &mut image.bodies {
            let Shape::Cuboid { p1, p2 } = &mut body.shape else {
                unreachable!("a cuboid")
            };
            let (a, b) = (self.position(p1), self.position(p2));
            *p1 = std::array::from_fn(|axis| a[axis].min(b[axis]));
            *p2 = std::array::from_fn(|axis| a[axis].max(b[axis]));
        }
        for load in &mut image.point_loads {
            load.position = self.position(&load.position);
            load.force = self.vector(&load.force);
        }
        image
    }
}

/// A smooth state without any symmetry of its own.
fn state(flat: bool, x: &Vector) -> InitialState {
    let wave = |a: f64, b: f64, c: f64, phase: f64| (a * x[0] + b * x[1] + c * x[2] + phase).sin();
    let mut velocity = [
        2.0 * wave(9.0, 4.0, 3.0, 0.1),
        1.5 * wave(-5.0, 8.0, 2.0, 0.7),
        1.0 * wave(3.0, -6.0, 7.0, 1.3),
    ];
    let mut stress: [f64; 6] =
        std::array::from_fn(|i| 2.0e4 * wave(6.0 + i as f64, 5.0, -4.0, i as f64));
    if flat {
        velocity[2] = 0.0;
        (stress[3], stress[4]) = (0.0, 0.0);
    }
    InitialState {
        velocity_gradient: [[0.0; 3]; 3],
        velocity,
        stress,
        deformation: crate::common::IDENTITY,
    }
}

fn simulate(
    scene: &Scene,
    initial: impl Fn(&Vector) -> InitialState + Send + Sync + 'static,
) -> Simulation {
    let all = Options {
        initial: Some(Arc::new(initial)),
        ..options()
    };
    let mut simulation = Simulation::new(scene, &all).expect("the scene is sound");
    crate::common::run_towards(&mut simulation, 30, NEVER);
    simulation
}

fn check(scene: &Scene, change: Change) {
    let flat = scene.dimension == Dimension::Two;
    let one = simulate(scene, move |x| state(flat, x));
    let two = simulate(&change.scene(scene), move |y| {
        let s = state(flat, &change.original(y));
        InitialState {
            velocity: change.vector(&s.velocity),
            stress: change.tensor(&s.stress),
            ..s
        }
    });
    let name = format!(
        "{:?} {:?} {:?} {change:?}",
        scene.weighting, scene.scheme, scene.transfer
    );
    assert!((one.time() - two.time()).abs() < 1.0e-15, "{name}");
    // Light nodes multiply round-off: by up to 100 in these scenes.
    let gain = if light_nodes_act(scene) { 100.0 } else { 1.0 };
    let images = particles(&two);
    let moved = particles(&one);
    assert_eq!(images.len(), moved.len());
    for (_, x, v, s) in moved {
        let x = change.position(&x);
        let (_, y, v_y, s_y) = images
            .iter()
            .min_by(|a, b| distance(&a.1, &x).total_cmp(&distance(&b.1, &x)))
            .expect("there are particles");
        // Round-off of 30 steps on positions below 1 m, velocities of a few m/s, strains below 0.1.
        assert!(
            distance(y, &x) < 1.0e-12 * gain,
            "{name} position {x:?} {y:?}"
        );
        let v = change.vector(&v);
        assert!(
            distance(v_y, &v) < 1.0e-11 * gain,
            "{name} velocity {v:?} {v_y:?}"
        );
        let s = change.tensor(&s);
        assert!(
            distance(s_y, &s) < 1.0e-11 * YOUNG * gain,
            "{name} stress {s:?} {s_y:?}"
        );
    }
}

/// A block in the corner of three planes, two sliding and one fixed, under gravity and a nodal load.
fn corner(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, CELLS, H);
    scene.mesh.planes = [
        [PlaneCondition::Sliding, PlaneCondition::Free],
        [PlaneCondition::Fixed, PlaneCondition::Sliding],
        [PlaneCondition::Sliding, PlaneCondition::Fixed],
    ];
    scene.gravity = [-3.0, -10.0, 0.0];
    if dimension == Dimension::Three {
        scene.gravity[2] = 2.0;
    }
    // Off the lattice of the mesh: particle domains overlap the planes as the body moves.
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.43, 0.31, 0.37]))];
    scene.point_loads = vec![PointLoad {
        position: [0.2, 0.2, 0.2],
        force: [20.0, 30.0, 0.0],
    }];
    scene
}

#[test]
fn mirrored_scenes_give_mirrored_results() {
    for dimension in DIMENSIONS {
        for (weighting, scheme) in weightings_and_schemes() {
            for transfer in [FLIP, APIC] {
                let mut scene = corner(dimension);
                (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                for axis in 0..dimension.axes() {
                    calm(&mut scene);
                    let mut flip = [false; 3];
                    flip[axis] = true;
                    check(
                        &scene,
                        Change {
                            from: [0, 1, 2],
                            flip,
                        },
                    );
                }
            }
        }
    }
}

#[test]
fn permuted_axes_give_permuted_results() {
    for (weighting, scheme) in weightings_and_schemes() {
        for transfer in [FLIP, APIC] {
            for (dimension, from) in [
                (Dimension::Two, [1, 0, 2]),
                (Dimension::Three, [1, 2, 0]),
                (Dimension::Three, [0, 2, 1]),
            ] {
                let mut scene = corner(dimension);
                (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                calm(&mut scene);
                check(
                    &scene,
                    Change {
                        from,
                        flip: [false; 3],
                    },
                );
            }
        }
    }
}
