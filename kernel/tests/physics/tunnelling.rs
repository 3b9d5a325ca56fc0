//! Bodies that move too far in a step to be seen by contact.

use crate::common::{NEVER, SCHEMES, body, cuboid, empty, simulation};
use crate::physics::contact::{H, pair, still, two};
use proctor_scene::Dimension;
use proctor_scene::simulation::Tunnelling;

#[test]
fn bodies_that_would_pass_through_each_other_are_refused() {
    let mut scene = two(Dimension::Two, 0.2, [400.0, -400.0]);
    scene.mesh.cells[0] = 30;
    let mut simulation = simulation(&scene);
    let error = (0..100)
        .find_map(|_| simulation.step(NEVER).err())
        .expect("they tunnel");
    let Some(&Tunnelling {
        bodies,
        approach,
        distance,
        ..
    }) = error.kind.fault()
    else {
        panic!("{error}")
    };
    assert_eq!(bodies, [1, 2]);
    assert!(
        (distance - 0.05).abs() < 1e-12 && approach > distance,
        "{error}"
    );
    assert!(error.to_string().contains("approach by"), "{error}");
}

/// A plate of one layer of particles has no more to stop a body with than its contact distance. Whatever the speed, the
/// body bounces off or the run is refused: it never comes out on the other side.
#[test]
fn nothing_passes_through_a_thin_plate_unseen() {
    for scheme in SCHEMES {
        for speed in [5.0, 50.0, 200.0, 800.0] {
            let mut scene = empty(Dimension::Two, [30, 8, 1], H);
            scene.scheme = scheme;
            let mut plate = body(1, cuboid([1.5, 0.0, 0.0], [1.55, 0.8, 0.0]));
            plate.motion = Some(still());
            let mut block = body(2, cuboid([0.5, 0.2, 0.0], [0.9, 0.6, 0.0]));
            block.velocity[0] = speed;
            scene.bodies = vec![plate, block];
            scene.contacts = vec![pair(1, 1, 2, 0.3)];
            let mut simulation = simulation(&scene);
            let mut refused = false;
            while simulation.time() < 1.5 / speed && !refused {
                match simulation.step(NEVER) {
                    Ok(_) => {}
                    Err(error) => {
                        assert!(
                            error.kind.fault::<Tunnelling>().is_some(),
                            "{scheme:?} {speed}: {error}"
                        );
                        refused = true;
                    }
                }
            }
            let x = simulation.center(1).position[0];
            assert!(x < 1.5, "{scheme:?} {speed}: through, at {x}");
        }
    }
}

/// A driven body has been as fast before a step as in it: one that runs through another is seen like any other.
#[test]
fn a_driven_body_that_would_pass_through_another_is_refused() {
    let mut scene = two(Dimension::Two, 0.2, [400.0, -400.0]);
    scene.mesh.cells[0] = 30;
    scene.bodies[0].motion = Some([400.0, 0.0, 0.0].into());
    let mut simulation = simulation(&scene);
    let error = (0..100).find_map(|_| simulation.step(NEVER).err());
    let error = error.expect("it runs through");
    assert!(error.kind.fault::<Tunnelling>().is_some(), "{error}");
}
