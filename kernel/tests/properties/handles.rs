//! Handles that a scene gives address the same bodies and contacts in its simulation.

use proctor_scene::prelude::*;

/// A block on another, which is fixed, and their contact.
fn stack() -> (Scene, [BodyHandle; 2], ContactHandle) {
    let mut scene = Scene::plane([10, 10], 0.1)
        .with_gravity([0.0, -10.0])
        .with_plane(1, 1, PlaneCondition::Free)
        .with_end(0.02);
    let rubber = scene.add_material(LinearElastic::new(1e5, 0.3), 1000.0);
    let base = scene
        .add_body(Shape::rectangle([0.0, 0.0], [1.0, 0.3]), rubber)
        .handle();
    let block = scene
        .add_body(Shape::rectangle([0.3, 0.3], [0.6, 0.6]), rubber)
        .with_velocity([0.1, 0.0])
        .with_particles_per_cell([3, 3])
        .handle();
    let contact = scene.add_contact([base, block], 0.2);
    (scene, [base, block], contact)
}

#[test]
fn a_handle_of_the_scene_is_one_of_its_simulation() {
    let (scene, [base, block], contact) = stack();
    assert_eq!(scene.body_with_id(2), Some(block));
    assert_eq!(scene.bodies[block.place()].velocity, [0.1, 0.0, 0.0]);
    assert_eq!(scene.bodies[block.place()].particles_per_cell, [3, 3, 1]);
    let mut simulation = scene.simulate(&Options::default()).expect("sound");
    assert_eq!(simulation.body_with_id(2), Some(block));
    assert_eq!(simulation.body(block).id, 2);
    assert_eq!(simulation.particles_of(block).len(), 81);
    assert_eq!(simulation.center(block), simulation.center(1));

    simulation.run_until(scene.time).expect("a sound step");
    assert!(simulation.contact_force(block)[1] > 0.0);
    simulation.set_friction(contact, 0.0).expect("the contact");
    assert_eq!(simulation.scene().contacts[0].friction, 0.0);
    assert!(simulation.set_friction(contact.id() + 1, 0.0).is_err());

    let still = History::from([0.0; 3]);
    simulation.set_motion(base, Some(still)).expect("the body");
    simulation
        .run_until(2.0 * scene.time)
        .expect("a sound step");
    assert_eq!(simulation.center(base).velocity, [0.0; 3]);
    let third = BodyHandle::from(2);
    let refused = simulation.set_motion(third, None).expect_err("two bodies");
    assert!(
        refused
            .to_string()
            .contains("below 2, the number of bodies"),
        "{refused}"
    );
}

/// Steps by hand and `run_until` give the same bits and the same number of steps.
#[test]
fn run_until_takes_the_steps_that_a_loop_takes() {
    let (scene, ..) = stack();
    let options = Options::default().with_threads(2);
    let mut one = scene.simulate(&options).expect("sound");
    let mut other = scene.simulate(&options).expect("sound");
    one.run_until(scene.time).expect("a sound step");
    while other.time() < scene.time {
        other.step(scene.time).expect("a sound step");
    }
    assert_eq!(
        (one.steps(), one.state_hash()),
        (other.steps(), other.state_hash())
    );
}
