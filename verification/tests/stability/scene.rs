//! Scenes of a user.

use proctor_laws::{LinearElastic, NeoHookean};
use proctor_scene::{Contact, ContactNormal, PlaneCondition, Scene, Shape};
use proctor_verification::stability::scene::{ask, predict_fields};

/// A soft block beside a stiff one.
fn two_blocks() -> Scene {
    let mut scene = Scene::plane([12, 8], 1.0).with_planes(PlaneCondition::Free);
    scene.gravity = [0.0, -1e-3, 0.0];
    let soft = scene.add_material(NeoHookean::new(1.0, 0.2), 1.0);
    let stiff = scene.add_material(LinearElastic::new(100.0, 0.2), 1.0);
    scene.add_body(Shape::rectangle([2.1, 2.1], [5.1, 5.1]), soft);
    scene.add_body(Shape::rectangle([6.1, 2.1], [9.1, 5.1]), stiff);
    scene
}

#[test]
fn the_stiff_body_rules() {
    let report = ask(&two_blocks()).expect("a report");
    let limit = report.predicted.expect("a limit");
    assert_eq!(limit.ruler.body, 2);
    assert!((6.0..9.2).contains(&limit.ruler.position[0]), "{limit:?}");
    assert!(report.dt < limit.dt);
    let all = report.alternatives.expect("a small scene");
    assert!(all.windows(2).all(|pair| pair[0].dt >= pair[1].dt));
    // Without the stiff body the waves are ten times as slow.
    let without = all.iter().find(|one| one.what == "without the body 2");
    let times = without.expect("an alternative").dt / limit.dt;
    assert!((9.0..11.0).contains(&times), "{times}");
    assert!(all.iter().any(|one| one.what == "uGIMP MUSL FLIP"));
}

/// A pair has a field for each body, so that a sliver of one beside the other is not carried by it.
#[test]
fn bodies_in_contact_are_taken_alone() {
    let mut scene = two_blocks();
    scene.bodies[1].shape = Shape::rectangle([5.1, 2.1], [8.1, 5.1]);
    let joined = predict_fields(&scene).expect("a limit").expect("one").dt;
    scene.contacts = vec![Contact {
        name: "pair".to_owned(),
        id: 1,
        friction: 0.0,
        master: 1,
        slave: 2,
        normal: ContactNormal::Collinear,
    }];
    let apart = predict_fields(&scene).expect("a limit").expect("one").dt;
    let mut alone = scene.clone();
    alone.contacts.clear();
    alone.bodies.remove(0);
    let stiff = predict_fields(&alone).expect("a limit").expect("one").dt;
    assert!((apart / stiff - 1.0).abs() < 1e-6, "{apart}, {stiff}");
    assert!(joined > apart, "{joined}, {apart}");
}
