//! Driven bodies that act by their shape, shared among ranks: the place of such a body is that of one particle, which one rank owns.

use super::contact::contact;
use super::harness::{compare_from, drifting, end, start_on, step, strip};
use super::threads;
use crate::common::{APIC, DIMENSIONS, FLIP, SCHEMES, body, cuboid, rough_drift};
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::StepErrorKind;
use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{
    Damping, Dimension, DomainUpdate, History, Scene, StressScheme, TimeStep, Transfer, Weighting,
};
use std::sync::Arc;

/// Height of the upper face of the plate \[m\], within a cell.
const FACE: f64 = 0.33;

/// A layer that slides on a driven plate as long as the mesh, and a block that a plate holds that stands still.
pub(super) fn on_a_plate(dimension: Dimension, motion: Option<History>) -> Scene {
    let mut scene = strip(dimension);
    scene.gravity = [1.0, -10.0, 0.0];
    let bodies = [
        ([0.2, 0.1, 0.2], [4.6, FACE, 0.4]),
        ([0.3, FACE, 0.2], [3.0, 0.5, 0.4]),
        ([4.0, FACE, 0.2], [4.4, 0.5, 0.4]),
    ];
    let bodies = bodies.into_iter().zip(1..);
    scene.bodies = bodies
        .map(|((p1, p2), id)| body(id, cuboid(p1, p2)))
        .collect();
    scene.bodies[1].material = 1;
    scene.contacts = vec![contact(1, [1, 2], 0.3)];
    let stands = motion.is_none();
    scene.bodies[0].motion = Some(motion.unwrap_or_else(|| [0.0; 3].into()));
    if !stands {
        scene.contacts.push(contact(2, [3, 1], 0.0));
    }
    scene
}

/// A motion along the plate that rises a little, and goes back.
pub(super) fn rising() -> History {
    History {
        times: vec![0.0, 0.1],
        values: vec![[6.0, 0.1, 0.0], [2.0, -0.1, 0.0]],
    }
}

/// Rough velocities along the plate; the block at its end rests.
pub(super) fn along(scene: &Scene) -> InitialField {
    let rough = rough_drift(scene.dimension, [8.0, 0.0, 0.0], 0.1, 1.0, 3);
    Arc::new(move |x| {
        let mut state = rough(x);
        if x[0] > 3.9 {
            state.velocity[0] = 0.0;
        }
        state
    })
}

#[test]
#[ignore = "takes 12 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn ranks_ride_on_a_driven_plate() {
    let stretch = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let methods: [(Weighting, Transfer); 3] = [
        (Weighting::UniformGimp, FLIP),
        (stretch, FLIP),
        (Weighting::QuadraticBSpline, APIC),
    ];
    let mut index = 0;
    for dimension in DIMENSIONS {
        for (weighting, transfer) in methods {
            for scheme in [StressScheme::Usl, StressScheme::Musl] {
                index += 1;
                let mut scene = on_a_plate(dimension, Some(rising()));
                (scene.weighting, scene.transfer, scene.scheme) = (weighting, transfer, scheme);
                if index % 2 == 0 {
                    // Contact without friction goes on from the impulses of the last step.
                    scene.damping = Damping::Local { alpha: 0.2 };
                    scene.contacts[0].friction = 0.0;
                }
                let end = compare_from(&scene, 26, &along(&scene));
                assert!(end.error.is_none(), "{:?}", end.error);
                assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
                assert!(end.touching.len() > 20, "{} nodes", end.touching.len());
            }
        }
    }
}

/// A plate that stands still holds a block that has no contact with it.
#[test]
fn ranks_are_held_by_a_plate() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = on_a_plate(dimension, None);
            scene.scheme = scheme;
            let end = compare_from(&scene, 26, &along(&scene));
            assert!(end.error.is_none(), "{:?}", end.error);
            assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
            assert!(end.touching.len() > 20, "{} nodes", end.touching.len());
        }
    }
}

/// The first particle that a driven body would go through is the same on all ranks.
#[test]
fn ranks_stop_for_the_same_shape() {
    let mut scene = on_a_plate(Dimension::Two, Some([8.0, 0.0, 0.0].into()));
    scene.time_step = TimeStep::Fixed {
        dt: 0.01,
        allow_unstable: true,
    };
    let along = along(&scene);
    let initial: InitialField = Arc::new(move |x| {
        let mut state: InitialState = along(x);
        if x[1] > FACE {
            state.velocity[1] -= 6.0;
        }
        state
    });
    let end = compare_from(&scene, 80, &initial);
    let error = end.error.expect("particles go through the plate");
    assert!(
        matches!(error.kind, StepErrorKind::Interaction(_)),
        "{error}"
    );
}

/// A saved state goes on on ranks: where the plate was at the start follows from the scene.
#[test]
fn ranks_go_on_beside_a_driven_plate() {
    let scene = &on_a_plate(Dimension::Two, Some(rising()));
    let initial = &drifting(scene, 6.0);
    let mut alone = start_on(None, scene, 1, initial);
    let first = step(&mut alone, 20);
    assert!(first.1.is_none(), "{:?}", first.1);
    let saved = alone.save();
    let sorted = step(&mut alone, 20);
    let expected = end(&mut alone, sorted);
    for count in [2, 3] {
        std::thread::scope(|scope| {
            let run = |rank: Arc<dyn Ranks>, saved| {
                move || {
                    let mut simulation = start_on(None, scene, 1, initial);
                    simulation.restore(saved).expect("the same scene");
                    simulation.share_among(rank).expect("it can be shared");
                    let sorted = step(&mut simulation, 20);
                    let whole = simulation.gather();
                    whole.map(|_| end(&mut simulation, sorted))
                }
            };
            let ranks = threads::ranks(count, None).into_iter();
            let all: Vec<_> = ranks
                .map(|rank| scope.spawn(run(Arc::new(rank), saved.clone())))
                .collect();
            let ends = all.into_iter().map(|rank| rank.join().expect("no panic"));
            let found: Vec<_> = ends.flatten().collect();
            assert!(found[0] == expected, "{count} ranks");
        });
    }
}
