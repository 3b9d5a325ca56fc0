//! A mesh far from zero: the weights that the kernel forms between absolute positions of particles and the origin of
//! the mesh, seen at the nodes, and whole runs, which are the same to the last bit.

use crate::common::{
    DENSITY, DIMENSIONS, IDENTITY, NEVER, SCHEMES, WEIGHTINGS, body, calm, cases, cuboid, empty,
    options, run_towards, transfers_of,
};
use crate::properties::touching::touching;
use proctor_scene::simulation::{InitialField, InitialState, Options, Simulation};
use proctor_scene::{
    BoxLoad, Dimension, HeldBox, ParticleSeed, PlaneCondition, PointLoad, Scene, Shape, Traction,
    Vector, Weighting,
};
use proptest::prelude::*;
use std::sync::Arc;

/// Cells of the mesh of one particle; it keeps a cell and a half away from all planes.
const CELLS: [usize; 3] = [7, 6, 5];
/// Edge of a cell \[m\]: neither it nor its reciprocal is a number of the machine.
const H: f64 = 0.1;
/// Pressure on the particle \[Pa\].
const PRESSURE: f64 = 3.0;
/// Round-off of a number near one.
const EPS: f64 = f64::EPSILON;

/// One particle at rest under pressure in a mesh that begins at `origin`. After the first step node I holds the mass
/// m S_I and has the velocity V p grad S_I (dt/2) / (m S_I), so that its weight and gradient can be read off.
fn one_particle(
    dimension: Dimension,
    weighting: Weighting,
    origin: &Vector,
    position: Vector,
    volume: f64,
) -> Scene {
    let mut scene = empty(dimension, CELLS, H);
    scene.mesh.origin = *origin;
    scene.weighting = weighting;
    let seed = ParticleSeed { position, volume };
    scene.bodies = vec![body(1, Shape::Particles(Arc::new(vec![seed])))];
    scene
}

/// Sums over the nodes that make weighting functions a basis, in units of the cell.
fn check_nodes(
    dimension: Dimension,
    weighting: Weighting,
    origin: f64,
    shares: &[f64; 3],
    half: f64,
) -> Result<(), TestCaseError> {
    let axes = dimension.axes();
    let mut corner = [origin, -origin, 0.5 * origin];
    let mut position: Vector = std::array::from_fn(|axis| {
        corner[axis] + H * (1.5 + shares[axis] * (CELLS[axis] as f64 - 3.0))
    });
    corner[axes..].fill(0.0);
    position[axes..].fill(0.0);
    // What the two absolute numbers say; their difference is exact (Sterbenz), so no digit is lost before the kernel.
    let xi: Vector = std::array::from_fn(|axis| (position[axis] - corner[axis]) / H);
    let volume = (2.0 * half * H).powi(axes as i32);
    let scene = one_particle(dimension, weighting, &corner, position, volume);
    let pressed: InitialField = Arc::new(|_| InitialState {
        velocity: [0.0; 3],
        velocity_gradient: [[0.0; 3]; 3],
        stress: [-PRESSURE, -PRESSURE, -PRESSURE, 0.0, 0.0, 0.0],
        deformation: IDENTITY,
    });
    let all = Options {
        initial: Some(pressed),
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &all).expect("the scene is sound");
    run_towards(&mut simulation, 1, NEVER);
    let kick = simulation.velocity_time();
    prop_assert!(kick > 0.0);

    let (mut unity, mut gradient, mut place) = (0.0, [0.0; 3], [0.0; 3]);
    let mut jacobian = [[0.0; 3]; 3];
    for node in simulation.node_values() {
        // The number of the node along each axis, as its own position has lost digits.
        let number: Vector =
            std::array::from_fn(|axis| ((node.position[axis] - corner[axis]) / H).round());
        let weight = node.mass / (DENSITY * volume);
        unity += weight;
        for axis in 0..axes {
            let slope = node.mass * node.velocity[axis] / (kick * volume * PRESSURE) * H;
            gradient[axis] += slope;
            place[axis] += weight * (number[axis] - xi[axis]);
            for k in 0..axes {
                jacobian[k][axis] += slope * (number[k] - xi[k]);
            }
        }
    }
    // Sums of up to 64 terms, whose magnitudes sum to 1 (weights), 2 (slopes) and 2 times 2 cells (moments); each has
    // gone through about twenty roundings, and xi through two of a number below the number of cells.
    let of_xi = 2.0 * EPS * CELLS[0] as f64;
    prop_assert!((unity - 1.0).abs() <= 16.0 * EPS, "sum S = {unity}");
    for k in 0..axes {
        prop_assert!(gradient[k].abs() <= 32.0 * EPS, "sum grad S = {gradient:?}");
        prop_assert!(
            place[k].abs() <= of_xi + 16.0 * EPS,
            "sum S x_I is off by {place:?} cells"
        );
        for axis in 0..axes {
            let exact = f64::from(u8::from(axis == k));
            prop_assert!(
                (jacobian[k][axis] - exact).abs() <= 2.0 * of_xi + 64.0 * EPS,
                "sum x_I grad S = {jacobian:?}"
            );
        }
    }
    Ok(())
}

/// Anywhere, and where a node, the middle of a cell or the edge of a domain may be.
fn share() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..1.0, (0_u32..=16).prop_map(|k| f64::from(k) / 16.0)]
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn weights_at_the_nodes_are_a_basis_however_far_the_mesh_is(
        shares in prop::array::uniform3(share()),
        half in 0.01..0.5_f64,
    ) {
        for dimension in DIMENSIONS {
            for weighting in WEIGHTINGS {
                for origin in [0.0, 1.0e6, 1.0e9] {
                    // A hat has a slope at a node where it has no weight, and a node without mass takes no force.
                    let kink = |share: f64| weighting == Weighting::Linear && (share * 16.0).fract() == 0.0;
                    let shares = shares.map(|s| if kink(s) { 0.93 * s + 0.031 } else { s });
                    check_nodes(dimension, weighting, origin, &shares, half)?;
                }
            }
        }
    }

    /// Domains wider than a cell, which take four nodes.
    #[test]
    fn wide_domains_are_a_basis_however_far_the_mesh_is(
        shares in prop::array::uniform3(share()),
        half in 0.5..1.0_f64,
    ) {
        for dimension in DIMENSIONS {
            for weighting in WEIGHTINGS {
                if matches!(weighting, Weighting::ContiguousGimp(_)) {
                    for origin in [0.0, 1.0e6, 1.0e9] {
                        check_nodes(dimension, weighting, origin, &shares, half)?;
                    }
                }
            }
        }
    }
}

/// Moves a scene whose coordinates are all multiples of 2^-9 m: nothing is rounded up to 1e9 m and beyond.
fn moved(scene: &Scene, by: &Vector) -> Scene {
    let mut scene = scene.clone();
    let shift = |x: &mut Vector| x.iter_mut().zip(by).for_each(|(c, by)| *c += by);
    shift(&mut scene.mesh.origin);
    for body in &mut scene.bodies {
        match &mut body.shape {
            Shape::Cuboid { p1, p2 } => {
                shift(p1);
                shift(p2);
            }
            Shape::Sphere { center, .. } => shift(center),
            _ => unreachable!("boxes and spheres"),
        }
    }
    scene
        .point_loads
        .iter_mut()
        .for_each(|l| shift(&mut l.position));
    for load in &mut scene.tractions {
        shift(&mut load.p1);
        shift(&mut load.p2);
    }
    for load in &mut scene.box_loads {
        shift(&mut load.p1);
        shift(&mut load.p2);
    }
    for held in &mut scene.held_boxes {
        shift(&mut held.p1);
        shift(&mut held.p2);
    }
    for rigid in &mut scene.surfaces {
        rigid.surface = Arc::new(crate::properties::touching::moved(&rigid.surface, by));
    }
    scene
}

/// Distance of the mesh along the axes of a scene.
fn far(dimension: Dimension, distance: f64) -> Vector {
    let mut by = [distance, -distance, 0.5 * distance];
    by[dimension.axes()..].fill(0.0);
    by
}

/// A scene that was moved, from the same start.
fn begin(scene: &Scene, by: &Vector, start: Option<InitialField>) -> Simulation {
    let by = *by;
    let initial = start.map(|field| -> InitialField {
        Arc::new(move |x| field(&std::array::from_fn(|axis| x[axis] - by[axis])))
    });
    let all = Options {
        initial,
        ..options()
    };
    Simulation::new(&moved(scene, &by), &all).expect("the scene is sound")
}

/// A block in a corner of planes, with every kind of load.
fn loaded(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [9, 8, 7], 0.125);
    scene.mesh.planes = [
        [PlaneCondition::Sliding, PlaneCondition::Free],
        [PlaneCondition::Fixed, PlaneCondition::Sliding],
        [PlaneCondition::Sliding, PlaneCondition::Free],
    ];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.5, 0.5, 0.375]))];
    scene.gravity = [-3.0, -10.0, 0.0];
    let deep = if dimension == Dimension::Two {
        0.0
    } else {
        0.25
    };
    scene.point_loads = vec![PointLoad {
        position: [0.25, 0.25, deep],
        force: [20.0, 30.0, 0.0],
    }];
    scene.tractions = vec![Traction {
        p1: [0.125, 0.5, 0.0],
        p2: [0.375, 0.5, deep],
        traction: [0.0, -100.0, 0.0].into(),
    }];
    scene.box_loads = vec![BoxLoad {
        p1: [0.0; 3],
        p2: [0.25, 0.25, 0.25],
        force: [5.0, 0.0, 0.0],
    }];
    scene.held_boxes = vec![HeldBox {
        p1: [0.375, 0.125, 0.0],
        p2: [0.375, 0.25, deep],
    }];
    scene
}

/// Rough from particle to particle.
fn start(dimension: Dimension) -> InitialField {
    crate::common::rough_drift(dimension, [3.0, 1.0, 0.0], 0.5, 1.0e3, 17)
}

#[test]
fn a_run_far_from_zero_has_the_bits_of_one_at_zero() {
    for dimension in DIMENSIONS {
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                for transfer in transfers_of(weighting) {
                    let mut scene = loaded(dimension);
                    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                    calm(&mut scene);
                    let run = |distance: f64| {
                        let by = far(dimension, distance);
                        let mut simulation = begin(&scene, &by, Some(start(dimension)));
                        run_towards(&mut simulation, 12, NEVER);
                        simulation.state_hash()
                    };
                    let near = run(0.0);
                    for distance in [1.0e6, 1.0e9] {
                        assert_eq!(
                            run(distance),
                            near,
                            "{dimension:?} {weighting:?} {scheme:?} {transfer:?} at {distance} m"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn contact_far_from_zero_has_the_bits_of_contact_at_zero() {
    let mut off = vec![];
    for touching in touching() {
        let run = |distance: f64| {
            let by = far(touching.scene.dimension, distance);
            let mut simulation = begin(&touching.scene, &by, None);
            touching.run(&mut simulation);
            simulation.state_hash()
        };
        let near = run(0.0);
        for distance in [1.0e6, 1.0e9] {
            if run(distance) != near {
                off.push(format!("{} at {distance} m", touching.name));
            }
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}
