//! The inputs that the two manuals print.

use std::path::PathBuf;

use proctor_files::json::read;
use proctor_files::records::{self, Harmonic};
use proctor_laws::{AnyLaw, LinearElastic};
use proctor_scene::{
    ContactNormal, Damping, Dimension, Field, Motion, PlaneCondition, Scene, Shape, StressScheme,
    TimeStep, TransferKind, Weighting,
};

fn file(name: &str) -> PathBuf {
    PathBuf::from("../../fixtures/scenes/manual").join(name)
}

fn scene(name: &str) -> Scene {
    read(&file(name)).unwrap_or_else(|error| panic!("{error}"))
}

fn elastic(young: f64, poisson: f64) -> AnyLaw {
    LinearElastic::new(young, poisson).into()
}

#[test]
fn boussinesq_as_printed() {
    let scene = scene("boussinesq.json");
    assert_eq!(scene.name, "boussinesq");
    assert_eq!(scene.dimension, Dimension::Three);
    assert_eq!(scene.time, 0.025);
    assert_eq!(
        scene.time_step,
        TimeStep::Multiplier {
            multiplier: 0.3,
            allow_unstable: false
        }
    );
    assert_eq!(scene.gravity, [0.0; 3]);
    assert_eq!(scene.weighting, Weighting::UniformGimp);
    assert_eq!(scene.scheme, StressScheme::Usl);
    assert_eq!(scene.transfer.kind, TransferKind::Flip);
    assert_eq!(scene.transfer.pic_fraction, 0.0);
    assert_eq!(scene.damping, Damping::Kinetic);
    assert_eq!(scene.mesh.cell, [0.1; 3]);
    assert_eq!(scene.mesh.cells, [10; 3]);
    let rollers = [PlaneCondition::Sliding; 2];
    // The manual names one plane; the others are sliding.
    assert_eq!(
        scene.mesh.planes,
        [
            rollers,
            rollers,
            [PlaneCondition::Sliding, PlaneCondition::Free]
        ]
    );
    assert_eq!(scene.materials.len(), 1);
    assert_eq!(scene.materials[0].name, "material-1");
    assert_eq!(scene.materials[0].density, 1500.0);
    assert_eq!(scene.materials[0].law, elastic(200e6, 0.25));
    assert_eq!(scene.bodies.len(), 1);
    let body = &scene.bodies[0];
    assert_eq!(body.name, "elastic-cuboid-body");
    assert_eq!((body.id, body.material), (1, 0));
    assert_eq!(
        body.shape,
        Shape::Cuboid {
            p1: [0.0; 3],
            p2: [1.0; 3]
        }
    );
    assert_eq!(body.particles_per_cell, [2; 3]);
    assert_eq!(scene.point_loads.len(), 1);
    assert_eq!(scene.point_loads[0].position, [0.5, 0.5, 1.0]);
    assert_eq!(scene.point_loads[0].force, [0.0, 0.0, -1.0]);
    assert_eq!(scene.results.print, 10);
    assert_eq!(scene.results.fields, [Field::Id, Field::Displacement]);
    assert_eq!(scene.threads, None);
    assert!(scene.base_motion.is_none());
}

fn base_acceleration(
    name: &str,
    (time, dt): (f64, f64),
    cells: [usize; 3],
    young: f64,
    (p1, p2): ([f64; 3], [f64; 3]),
) {
    let scene = scene(name);
    assert_eq!(scene.time, time);
    assert_eq!(
        scene.time_step,
        TimeStep::Fixed {
            dt,
            allow_unstable: false
        }
    );
    assert_eq!(scene.mesh.cells, cells);
    assert_eq!(scene.mesh.planes, [[PlaneCondition::Sliding; 2]; 3]);
    assert_eq!(scene.materials[0].law, elastic(young, 0.25));
    assert_eq!(scene.materials[0].density, 2500.0);
    assert_eq!(scene.bodies[0].shape, Shape::Cuboid { p1, p2 });
    assert_eq!(scene.damping, Damping::Local { alpha: 0.0 });
    assert_eq!(scene.weighting, Weighting::UniformGimp);
    assert_eq!(scene.threads, Some(1));
    assert_eq!(scene.results.print, 100);
    assert_eq!(
        scene.results.fields,
        [
            Field::Id,
            Field::Displacement,
            Field::Velocity,
            Field::Material,
            Field::Active,
            Field::Body
        ]
    );
    let base = scene.base_motion.expect("a base motion");
    assert_eq!((base.axis, base.side), (2, 0));
    // Reading gives back every bit of what was written.
    let exact = records::accelerogram(&Harmonic::of_the_manual());
    assert_eq!(base.motion, Motion::Acceleration(exact));
}

#[test]
fn base_acceleration_as_printed_in_the_input() {
    base_acceleration(
        "base_acceleration.json",
        (10.0, 0.0005),
        [10, 10, 15],
        10e6,
        ([0.2, 0.2, 0.0], [0.5, 0.5, 1.0]),
    );
}

#[test]
fn base_acceleration_as_the_text_says() {
    base_acceleration(
        "base_acceleration_text.json",
        (2.0, 1e-4),
        [12, 12, 15],
        100e6,
        ([0.4, 0.4, 0.0], [0.7, 0.7, 0.8]),
    );
}

/// The record is generated, never edited: with `REGENERATE=1` this test writes it.
#[test]
fn the_record_of_the_manual_is_its_formula() {
    let text = records::to_csv(&records::accelerogram(&Harmonic::of_the_manual()));
    let file = file("base_acceleration.csv");
    if std::env::var_os("REGENERATE").is_some() {
        std::fs::write(&file, &text).expect("a writable fixture");
    }
    let stored = std::fs::read_to_string(&file).expect("the fixture");
    assert_eq!(text.lines().count(), 40_002);
    assert!(text == stored, "the fixture is not the formula");
}

#[test]
fn the_inclined_blocks_are_in_contact_as_printed() {
    let one = scene("inclined_block.json");
    let [contact] = one.contacts.as_slice() else {
        panic!("one contact, not {:?}", one.contacts)
    };
    assert_eq!((contact.id, contact.master, contact.slave), (1, 1, 2));
    assert_eq!(contact.friction, 0.5);
    assert_eq!(contact.normal, ContactNormal::Master);
    assert_eq!(one.contact_distance, Some(0.5));
    let two = scene("inclined_two_blocks.json");
    let frictions: Vec<f64> = two.contacts.iter().map(|c| c.friction).collect();
    assert_eq!(frictions, [0.2, 0.0]);
    // The manual's default of 0.5 is the distance of two particles per cell and axis.
    assert_eq!(two.contact_distance, None);
}

#[test]
fn without_contact_the_inclined_plane_is_a_scene() {
    let text = std::fs::read_to_string(file("inclined_two_blocks.json")).expect("the fixture");
    let text = text.replace("\"active\": true", "\"active\": false");
    let scene = proctor_files::json::from_json(&text, "plane.json", &file(""))
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.bodies.len(), 3);
    assert!(scene.contacts.is_empty());
    assert_eq!(
        scene.bodies.iter().map(|b| b.material).collect::<Vec<_>>(),
        [0, 1, 1]
    );
    assert_eq!(scene.gravity, [7.07, 0.0, -7.07]);
    assert_eq!(
        scene.results.fields,
        [
            Field::Id,
            Field::Displacement,
            Field::Material,
            Field::Active,
            Field::Pressure,
            Field::ExternalForce
        ]
    );
}

/// Not a scene, but an input that the manual prints: stored without its annotations.
#[test]
fn the_benchmark_configuration_is_json() {
    let path = "../../fixtures/bench/start-multi-benchmark-configuration.json";
    let text = std::fs::read_to_string(path).expect("the fixture");
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(
        value["parameters"]["particles"],
        serde_json::json!([15000, 25000, 50000])
    );
    assert_eq!(
        value["parameters"]["threads"],
        serde_json::json!([1, 5, 10])
    );
}
