//! Rigid surfaces shared among ranks: every rank sweeps over the touches of all.

use super::{compare, strip};
use crate::common::{APIC, FLIP, SCHEMES, cuboid};
use proctor_contact::geometry::surface::Surface;
use proctor_kernel::simulation::StepErrorKind;
use proctor_scene::{Damping, Dimension, History, RigidSurface, Scene, StressScheme};
use std::sync::Arc;

/// The strip on a surface that falls a little along it, and a wall on its right side.
pub(super) fn on_a_slope(friction: f64) -> Scene {
    let mut scene = strip(Dimension::Three);
    scene.gravity = [1.0, 0.5, -10.0];
    let slope = [
        [[-1.0, -1.0, 0.2], [7.0, -1.0, 0.184], [7.0, 2.0, 0.184]],
        [[-1.0, -1.0, 0.2], [7.0, 2.0, 0.184], [-1.0, 2.0, 0.2]],
    ];
    let wall = [
        [[-1.0, 0.42, 0.0], [7.0, 0.42, 0.0], [7.0, 0.42, 0.6]],
        [[-1.0, 0.42, 0.0], [7.0, 0.42, 0.6], [-1.0, 0.42, 0.6]],
    ];
    let surface = |name: &str, triangles: &[[[f64; 3]; 3]]| RigidSurface {
        name: name.into(),
        surface: Arc::new(Surface::new(triangles).expect("triangles")),
        friction,
        distance_threshold: 0.1,
        penalty_stiffness: None,
        motion: None,
    };
    scene.surfaces = vec![surface("slope", &slope), surface("wall", &wall)];
    scene
}

#[test]
#[ignore = "takes 10 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn ranks_rest_on_surfaces_as_one_process() {
    let damped = Damping::Local { alpha: 0.2 };
    for (scheme, transfer, friction, damping) in [
        (StressScheme::Usl, FLIP, 0.3, Damping::None),
        (StressScheme::Usl, APIC, 0.0, damped),
        (StressScheme::Musl, FLIP, 0.3, damped),
        (StressScheme::Usf, APIC, 0.3, Damping::None),
    ] {
        let mut scene = on_a_slope(friction);
        (scene.scheme, scene.transfer, scene.damping) = (scheme, transfer, damping);
        if friction == 0.0 {
            scene.surfaces[0].motion = Some(History {
                times: vec![0.0, 0.1],
                values: vec![[0.0, 0.0, 0.05], [0.0, 0.0, -0.05]],
            });
            scene.surfaces[0].penalty_stiffness = Some(1e3);
        }
        let end = compare(&scene, 26, 8.0);
        assert!(end.error.is_none(), "{:?}", end.error);
        assert!(end.sorts >= 3, "{} sorts", end.sorts);
        // The strip touches along its whole length, and so on every rank.
        assert!(end.touching.len() > 100, "{} nodes", end.touching.len());
    }
}

/// The first particle that a surface would go through is the same on all ranks.
#[test]
fn ranks_stop_for_the_same_surface() {
    let mut scene = on_a_slope(0.0);
    scene.surfaces[0].motion = Some(History {
        times: vec![0.0, 0.05],
        values: vec![[0.0; 3], [0.0, 0.0, 60.0]],
    });
    let end = compare(&scene, 60, 8.0);
    let error = end.error.expect("the surface is too fast");
    assert!(
        matches!(error.kind, StepErrorKind::Interaction(_)),
        "{error}"
    );
}

/// Bodies side by side, of which each second one moves as prescribed and takes the nodes of its neighbours along. Their ends pass
/// the planes of all ranks.
pub(super) fn beside_driven_bodies() -> Scene {
    let mut scene = on_a_slope(0.3);
    let first = scene.bodies.remove(0);
    scene.bodies.clear();
    for id in 0..9_u8 {
        let x = 0.3 + 0.4 * f64::from(id);
        let mut one = first.clone();
        (one.id, one.name) = (i64::from(id) + 1, format!("body {id}"));
        one.shape = cuboid([x, 0.21, 0.2], [x + 0.4, 0.41, 0.4]);
        if id % 2 == 1 {
            one.motion = Some(History {
                times: vec![0.0, 0.1],
                values: vec![[8.0, 0.0, 0.0], [6.0, 0.0, 0.1]],
            });
        }
        scene.bodies.push(one);
    }
    scene
}

#[test]
#[ignore = "takes 9 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn ranks_rest_on_surfaces_beside_driven_bodies() {
    let damped = Damping::Local { alpha: 0.2 };
    for (scheme, transfer, damping) in [
        (StressScheme::Usl, FLIP, Damping::None),
        (StressScheme::Musl, APIC, damped),
        (StressScheme::Usf, FLIP, Damping::None),
    ] {
        let mut scene = beside_driven_bodies();
        (scene.scheme, scene.transfer, scene.damping) = (scheme, transfer, damping);
        let end = compare(&scene, 40, 8.0);
        assert!(end.error.is_none(), "{:?}", end.error);
        assert!(end.sorts >= 5, "{} sorts", end.sorts);
        assert!(end.touching.len() > 50, "{} nodes", end.touching.len());
    }
}

/// The plan counts the nodes of driven bodies that ranks send.
#[test]
fn a_step_beside_driven_bodies_sends_what_the_plan_counts() {
    for scheme in SCHEMES {
        let mut scene = beside_driven_bodies();
        scene.scheme = scheme;
        super::sends_what_the_plan_counts(&scene);
    }
}
