//! Changes between the stages of one simulation.

use crate::common::{block, run_towards, simulation};
use crate::physics::contact::{slope, until};
use crate::physics::mortar::{collision, run_until};
use proctor_scene::{Dimension, History};

/// Settle the block on a held slope, then let it go.
#[test]
fn stages_settle_and_release() {
    let mut scene = slope(Dimension::Two, 0.0);
    scene.gravity[0] = 0.0;
    let mut simulation = simulation(&scene);
    simulation.set_local_damping(Some(0.6)).expect("a factor");
    until(&mut simulation, 0.3);
    assert!(
        simulation.kinetic_energy() < 1.0e-3,
        "{}",
        simulation.kinetic_energy()
    );
    simulation.set_local_damping(None).expect("no factor");
    simulation.set_gravity([5.0, -10.0, 0.0]).expect("a vector");
    simulation.set_friction(7, 0.3).expect("the contact");
    let (v_0, t_0) = (simulation.center(1).velocity[0], simulation.velocity_time());
    until(&mut simulation, 0.6);
    let a = (simulation.center(1).velocity[0] - v_0) / (simulation.velocity_time() - t_0);
    assert!((a - 2.0).abs() < 0.1, "{a}");
    // The base is let go: both fall.
    simulation.set_motion(0.into(), None).expect("the body");
    let v = simulation.center(0).velocity[1];
    until(&mut simulation, 0.65);
    assert!(simulation.center(0).velocity[1] < v - 0.3);
    assert!(simulation.set_friction(8, 0.1).is_err());
    assert!(simulation.set_friction(7, -0.1).is_err());
    assert!(simulation.set_gravity([0.0, 0.0, 1.0]).is_err());
    assert!(simulation.set_motion(8.into(), None).is_err());
    assert!(simulation.set_local_damping(Some(2.0)).is_err());
}

/// Gravity did its work until it was changed; the change does none.
#[test]
fn a_change_of_gravity_keeps_the_books() {
    let mut scene = block(Dimension::Two);
    scene.gravity = [3.0, -10.0, 0.0];
    let mut simulation = simulation(&scene);
    run_towards(&mut simulation, 20, 1.0);
    let before = simulation.energy();
    assert!(before.external_work > 0.0);
    simulation.set_gravity([0.0, 5.0, 0.0]).expect("a vector");
    let after = simulation.energy();
    let change = (after.external_work - before.external_work).abs();
    assert!(
        change < 1.0e-12 * before.external_work,
        "{before:?} {after:?}"
    );
}

fn constant(velocity: [f64; 3]) -> History {
    History {
        times: vec![0.0],
        values: vec![velocity],
    }
}

/// A stage may repeat the present settings: the contacts go on as they were.
#[test]
fn a_motion_that_a_body_has_already_changes_no_bit() {
    for held in [false, true] {
        let mut scene = collision(0.4);
        if held {
            scene.bodies[1].motion = Some(constant([-2.0, 0.5, 0.0]));
        }
        let mut plain = simulation(&scene);
        let mut told = simulation(&scene);
        let mut pushed = 0.0_f64;
        while plain.time() < 0.12 {
            run_towards(&mut plain, 1, 0.12);
            run_towards(&mut told, 1, 0.12);
            for (place, body) in scene.bodies.iter().enumerate() {
                let motion = body.motion.clone();
                told.set_motion(place.into(), motion).expect("the body");
            }
            pushed = pushed.max(-plain.mortar_force(1).expect("a boundary")[0]);
        }
        assert!(pushed > 100.0, "{pushed}");
        assert_eq!(plain.state_hash(), told.state_hash(), "held {held}");
    }
}

/// A body that is held stops the other one, its boundary with it, and is pushed away once it is let go.
#[test]
fn a_body_with_a_boundary_is_held_and_let_go() {
    let mut scene = collision(0.0);
    scene.bodies[1].velocity = [0.0; 3];
    let mut simulation = simulation(&scene);
    let still = constant([0.0; 3]);
    simulation
        .set_motion(1.into(), Some(still))
        .expect("the body");
    let before = simulation.boundary_vertices(2).expect("a boundary");
    let x = simulation.center(1).position;
    while simulation.mortar_force(1).expect("a boundary")[0] > -100.0 {
        run_towards(&mut simulation, 1, 1.0);
        assert!(simulation.time() < 0.2, "they never meet");
    }
    assert_eq!(simulation.center(1).position, x);
    let after = simulation.boundary_vertices(2).expect("a boundary");
    for (a, b) in before.iter().zip(&after) {
        assert_eq!(a, b);
    }
    simulation.set_motion(1.into(), None).expect("the body");
    run_until(&mut simulation, 0.3);
    let [first, second] = [0, 1].map(|set| simulation.center(set).velocity[0]);
    assert!(second > 0.5 && first < second, "{first} {second}");
    // Its boundary went with it.
    let moved = simulation.center(1).position[0] - x[0];
    let vertices = simulation.boundary_vertices(2).expect("a boundary");
    let of_vertices = vertices.iter().zip(&before);
    let mean = of_vertices.map(|(a, b)| a[0] - b[0]).sum::<f64>() / before.len() as f64;
    assert!((mean / moved - 1.0).abs() < 0.02, "{mean} {moved}");
}

#[test]
fn the_friction_of_a_mortar_contact_can_be_changed() {
    let mut plain = simulation(&collision(0.4));
    let mut told = simulation(&collision(0.0));
    told.set_friction(1, 0.4).expect("the contact");
    assert_eq!(told.scene().mortar.contacts[0].friction, 0.4);
    run_towards(&mut plain, 120, 1.0);
    run_towards(&mut told, 120, 1.0);
    assert_eq!(plain.state_hash(), told.state_hash());
    told.set_friction(1, 0.0).expect("the contact");
    run_towards(&mut told, 1, 1.0);
    assert!(told.set_friction(2, 0.1).is_err());
}
