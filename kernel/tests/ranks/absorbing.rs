//! Absorbing planes shared among ranks: dashpots, springs, reactions, and free ground beside the sides.

use super::contact::contact;
use super::harness::{compare, compare_from, strip};
use crate::common::{APIC, DIMENSIONS, FLIP, MLS, body, cuboid, elastic, empty, material};
use crate::common::{SCHEMES, rough_drift};
use proctor_kernel::simulation::StepErrorKind;
use proctor_laws::NeoHookean;
use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{
    BaseMotion, Body, Damping, Dimension, History, InitialStress, Motion, PlaneCondition, Scene,
    Vector, Weighting,
};
use std::sync::Arc;

const ABSORBING: PlaneCondition = PlaneCondition::Absorbing;

/// Ground that fills the mesh but for its top, as high as `up` says, with absorbing sides and an absorbing base, of two bodies side
/// by side along the first axis.
pub(super) fn ground(dimension: Dimension, up: usize) -> Scene {
    let axes = dimension.axes();
    let mut cells = [44, 7, 6];
    cells[up] += 4;
    let mut scene = empty(dimension, cells, 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    for axis in 0..axes {
        scene.mesh.planes[axis] = [ABSORBING; 2];
    }
    scene.mesh.planes[up][1] = PlaneCondition::Free;
    let mut upper = [4.4, 0.7, 0.6];
    upper[up] -= 0.2;
    scene.bodies = halves([0.0; 3], upper);
    scene.materials = vec![
        material(elastic(1.0e4, 0.2)),
        material(elastic(2.0e4, 0.15)),
    ];
    scene.bodies[1].material = 1;
    scene.gravity[up] = -0.5;
    scene
}

/// Two bodies side by side along the first axis.
fn halves(lower: Vector, upper: Vector) -> Vec<Body> {
    let (mut left, mut right) = (upper, lower);
    (left[0], right[0]) = (2.2, 2.2);
    vec![body(1, cuboid(lower, left)), body(2, cuboid(right, upper))]
}

/// A layer that falls between absorbing sides, with springs behind them.
pub(super) fn falling(dimension: Dimension) -> Scene {
    let up = dimension.axes() - 1;
    let mut cells = [44, 6, 6];
    cells[up] = 24;
    let mut scene = empty(dimension, cells, 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    for axis in 0..up {
        scene.mesh.planes[axis] = [ABSORBING; 2];
    }
    scene.mesh.planes[up] = [PlaneCondition::Free; 2];
    let (mut lower, mut upper) = ([0.0; 3], [4.4, 0.6, 0.6]);
    (lower[up], upper[up]) = (2.0, 2.3);
    scene.bodies = halves(lower, upper);
    scene.materials = vec![
        material(elastic(1.0e3, 0.3)),
        material(NeoHookean::new(2.0e3, 0.3)),
    ];
    scene.bodies[1].material = 1;
    scene
}

/// Velocities that are rough, less so near the sides.
pub(super) fn rough(scene: &Scene, drift: Vector, speed: f64) -> InitialField {
    let rough = rough_drift(scene.dimension, [0.0; 3], speed, 1.0, 5);
    let cells = scene.mesh.cells;
    Arc::new(move |x| {
        let mut state: InitialState = rough(x);
        for axis in 0..3 {
            let share = x[axis] / (0.1 * cells[axis] as f64);
            state.velocity[axis] *= 4.0 * share * (1.0 - share);
            state.velocity[axis] += drift[axis];
        }
        state
    })
}

/// A motion of the base along it, to and fro.
pub(super) fn shaking(scene: &Scene, axis: usize) -> BaseMotion {
    let mut most = [0.2, -0.2, 0.2];
    most[axis] = 0.0;
    if scene.dimension == Dimension::Two {
        most[2] = 0.0;
    }
    let turns = 0..40_u8;
    BaseMotion {
        axis,
        side: 0,
        motion: Motion::Velocity(History {
            times: turns.clone().map(|i| 0.05 * f64::from(i)).collect(),
            values: turns
                .map(|i| most.map(|v| v * f64::from([0, 1, 0, -1][usize::from(i) % 4])))
                .collect(),
        }),
    }
}

#[test]
fn ranks_let_waves_leave_together() {
    let methods = [
        (Weighting::UniformGimp, FLIP),
        (Weighting::UniformGimp, APIC),
        (Weighting::QuadraticBSpline, MLS),
    ];
    let mut index = 0;
    for dimension in DIMENSIONS {
        for (weighting, transfer) in methods {
            for scheme in SCHEMES {
                index += 1;
                let mut scene = falling(dimension);
                (scene.weighting, scene.transfer, scene.scheme) = (weighting, transfer, scheme);
                match index % 3 {
                    0 => scene.ground_beyond.thickness = Some(1.0),
                    1 => scene.contacts = vec![contact(1, [1, 2], 0.3)],
                    _ => scene.damping = Damping::Local { alpha: 0.1 },
                }
                let mut drift = [0.0; 3];
                drift[dimension.axes() - 1] = -8.0;
                let end = compare_from(&scene, 32, &rough(&scene, drift, 0.1));
                assert!(end.error.is_none(), "{:?}", end.error);
                assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
                let state = &end.state.state;
                assert!(state.ledger.absorbed > 0.0 && state.absorbing.len() > 5);
            }
        }
    }
}

/// A strip flies along an absorbing base, over planes of all ranks.
#[test]
fn ranks_drift_over_an_absorbing_base() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = strip(dimension);
            scene.scheme = scheme;
            let low = dimension.axes() - 1;
            let [mut left, mut right] = [[0.3, 0.21, 0.2], [2.03, 0.21, 0.2]];
            (left[low], right[low]) = (0.0, 0.0);
            scene.bodies[0].shape = cuboid(left, [2.03, 0.41, 0.4]);
            scene.bodies[1].shape = cuboid(right, [3.9, 0.41, 0.4]);
            scene.mesh.planes[low][0] = ABSORBING;
            scene.gravity = [3.0, 0.0, 0.0];
            let end = compare(&scene, 80, 8.0);
            assert!(end.sorts >= 10, "{} sorts", end.sorts);
        }
    }
}

/// Columns of free ground stand beside the sides: on a base that a wave shakes, or that moves as prescribed; along the planes of
/// ranks, and across them.
#[test]
fn ranks_shake_free_ground_together() {
    for dimension in DIMENSIONS {
        for up in [dimension.axes() - 1, 0] {
            for rigid in [false, true] {
                let mut scene = ground(dimension, up);
                let base = shaking(&scene, up);
                if rigid {
                    scene.mesh.planes[up][0] = PlaneCondition::Fixed;
                    scene.base_motion = Some(base);
                    scene.damping = Damping::Viscous { alpha: 0.1 };
                } else {
                    scene.ground_beyond.incoming = Some(base);
                }
                let mut initial = rough(&scene, [0.0; 3], if up > 0 { 1.0 } else { 3.0 });
                if up > 0 {
                    // What flies over the ground is sorted.
                    let (mut lower, mut upper) = ([0.5, 0.2, 0.2], [1.5, 0.4, 0.4]);
                    (lower[up], upper[up]) = (0.75, 0.9);
                    scene.bodies.push(body(3, cuboid(lower, upper)));
                    let below = initial;
                    initial = Arc::new(move |x| {
                        let mut state: InitialState = below(x);
                        if x[up] > 0.7 {
                            state.velocity = [8.0, 0.0, 0.0];
                        }
                        state
                    });
                }
                let end = compare_from(&scene, 80, &initial);
                assert!(end.error.is_none(), "{:?}", end.error);
                let least = if up > 0 { 10 } else { 2 };
                assert!(end.sorts >= least, "{} sorts", end.sorts);
                let free = &end.state.state.free_ground;
                assert!(free.iter().any(|node| node.stiffness[0] > 0.0));
                assert!(free.iter().any(|node| node.velocity != [0.0; 3]));
            }
        }
    }
}

/// Antisymmetric sides bear the stress of the start.
#[test]
fn ranks_bear_the_stress_of_the_start_together() {
    for dimension in DIMENSIONS {
        let mut scene = ground(dimension, 1);
        for side in 0..2 {
            scene.mesh.planes[0][side] = PlaneCondition::Antisymmetric;
        }
        scene.mesh.planes[1][0] = PlaneCondition::Fixed;
        for one in &mut scene.bodies {
            one.initial_stress = InitialStress::AtRest {
                level: 0.5,
                ratio: 0.5,
                surcharge: 0.0,
            };
        }
        let end = compare_from(&scene, 80, &rough(&scene, [0.0; 3], 2.0));
        assert!(end.error.is_none(), "{:?}", end.error);
        let nodes = &end.state.state.absorbing;
        assert!(nodes.iter().any(|node| node.reaction != [0.0; 3]));
    }
}

/// Ground that leaves its dashpots stops all ranks with the same error.
#[test]
fn ranks_stop_off_the_same_plane() {
    let mut scene = ground(Dimension::Two, 1);
    scene.mesh.planes[0][1] = PlaneCondition::Free;
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    scene.bodies[1].shape = cuboid([2.2, 0.0, 0.0], [4.0, 0.5, 0.0]);
    let end = compare_from(&scene, 400, &rough(&scene, [0.6, 0.0, 0.0], 0.1));
    let error = end.error.expect("the ground leaves the planes");
    assert!(
        matches!(error.kind, StepErrorKind::OffAbsorbingPlane { .. }),
        "{error}"
    );
}
