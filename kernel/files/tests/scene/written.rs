//! Scenes as they are written for other programs.

use std::path::{Path, PathBuf};

use proctor_files::json::{from_json, read, write, write_own};
use proctor_scene::{
    BaseMotion, ContactNormal, GroundBeyond, History, Motion, PlaneCondition, Scene, Shape,
    TimeStep, VolumetricStrain,
};

/// Writes a scene and reads it back, in a folder with the files that it names.
pub(crate) fn back(scene: &Scene) -> Scene {
    let written = write(scene).unwrap_or_else(|error| panic!("{error}"));
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in &written.files {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let text = format!("{:#}", written.scene);
    let mut again = from_json(&text, &scene.name, folder.path())
        .unwrap_or_else(|error| panic!("{error}: {text}"));
    // Names of entries are for messages.
    again.name.clone_from(&scene.name);
    for (new, old) in again.materials.iter_mut().zip(&scene.materials) {
        new.name.clone_from(&old.name);
    }
    for (new, old) in again.bodies.iter_mut().zip(&scene.bodies) {
        new.name.clone_from(&old.name);
    }
    for (new, old) in again.contacts.iter_mut().zip(&scene.contacts) {
        new.name.clone_from(&old.name);
    }
    again.threads = scene.threads;
    again
}

#[test]
fn what_is_written_is_read_back() {
    let folder = Path::new("../../fixtures/scenes");
    let mut count = 0;
    for name in [
        "column_gravity_2d.json",
        "sliding_block_2d.json",
        "shaken_base_2d.json",
        "manual/boussinesq.json",
        "manual/base_acceleration.json",
        "manual/inclined_block.json",
        "manual/inclined_two_blocks.json",
        "speed/block_1m.json",
    ] {
        let path: PathBuf = folder.join(name);
        let Ok(scene) = read(&path) else {
            panic!("{name} is no scene")
        };
        if scene.probes.is_empty() {
            assert_eq!(
                format!("{:?}", back(&scene)),
                format!("{scene:?}"),
                "{name}"
            );
            count += 1;
        }
    }
    assert!(count >= 6, "only {count} scenes were written");
}

#[test]
fn every_choice_is_written() {
    let mut scene = read(Path::new(
        "../../fixtures/scenes/manual/inclined_block.json",
    ))
    .expect("a scene");
    scene.time_step = TimeStep::Fixed {
        dt: 1e-4,
        allow_unstable: true,
    };
    scene.contacts[0].normal = ContactNormal::Slave;
    scene.contact_distance = Some(0.25);
    scene.bodies[0].velocity = [1.0, 2.0, 3.0];
    assert_eq!(format!("{:?}", back(&scene)), format!("{scene:?}"));
    scene.mesh.planes[2][0] = PlaneCondition::Absorbing;
    scene.ground_beyond = GroundBeyond {
        incoming: Some(BaseMotion {
            axis: 2,
            side: 0,
            motion: Motion::Velocity(History {
                times: vec![0.0, 0.5],
                values: vec![[0.0, 0.25, 0.0], [1.0, 0.0, 0.0]],
            }),
        }),
        thickness: Some(20.0),
    };
    assert_eq!(format!("{:?}", back(&scene)), format!("{scene:?}"));
}

/// Mortar contact belongs to this program: a block on a line, as it is written for itself.
#[test]
fn mortar_contact_is_written_for_this_program() {
    let text = r#"{
        "dimension": 2, "time": 1.0, "stress_scheme_update": "MUSL",
        "mesh": { "cells_dimension": [0.1, 0.1], "cells_number": [4, 10] },
        "material": [{ "type": "elastic", "id": 1, "young": 1e6, "density": 1000, "poisson": 0.3 }],
        "body": [
            { "type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0, 0.33], "point_p2": [0.4, 0.6],
              "boundary_segment": 0.05, "boundary_follows": "material" },
            { "type": "rectangle", "id": 2, "material_id": 1, "point_p1": [0, 0.61], "point_p2": [0.4, 0.8],
              "boundary": [[0, 0.61], [0.4, 0.61], [0.4, 0.8], [0, 0.8]] }
        ],
        "rigid_line": [{ "id": 9, "points": [[0.5, 0.32], [-0.1, 0.32]] }],
        "contact": [
            { "method": "mortar", "id": 1, "master_id": 9, "slave_id": 1, "friction": 0, "critical_gap": 0.02,
              "normal_stiffness": 1e6, "detection": "node_to_segment" },
            { "method": "mortar", "id": 2, "master_id": 1, "slave_id": 2, "friction": 0.2, "critical_gap": 0.02,
              "normal_stiffness": 1e6, "tangential_stiffness": 2e6, "enforcement": "penalty" }
        ]
    }"#;
    let scene = from_json(text, "mortar.json", Path::new("")).expect("a scene");
    let written = write_own(&scene).expect("written");
    let again = from_json(
        &format!("{:#}", written.scene),
        "mortar.json",
        Path::new(""),
    );
    let again = again.unwrap_or_else(|error| panic!("{error}: {:#}", written.scene));
    assert_eq!(format!("{again:?}"), format!("{scene:?}"));
    // For others it is refused as before.
    assert!(write(&scene).is_err());
    // And what has none is written as for others.
    let plain = read(Path::new("../../fixtures/scenes/sliding_block_2d.json")).expect("a scene");
    let plain = Scene {
        probes: vec![],
        ..plain
    };
    assert_eq!(
        write_own(&plain).expect("written"),
        write(&plain).expect("written")
    );
}

/// Triangles become a file beside the scene, and means over cells a word.
#[test]
fn a_surface_and_means_of_strain_are_read_back() {
    let path = Path::new("../../fixtures/scenes/sphere_on_terrain.json");
    let mut scene = read(path).expect("a scene");
    scene.probes.clear();
    for body in &mut scene.bodies {
        body.shape = Shape::Cuboid {
            p1: [0.0; 3],
            p2: [1.0; 3],
        };
    }
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    let written = write(&scene).expect("written");
    let [(name, text)] = written.files.as_slice() else {
        panic!("{:?}", written.files);
    };
    let folder = std::env::temp_dir().join(format!("proctor-surface-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join(name), text).expect("written");
    let again = from_json(&written.scene.to_string(), "surface", &folder);
    std::fs::remove_dir_all(&folder).expect("removed");
    let again = again.unwrap_or_else(|error| panic!("{error}: {:#}", written.scene));
    assert_eq!(again.surfaces[0].name, *name);
    let corners = |scene: &Scene| {
        let surface = &scene.surfaces[0].surface;
        (0..surface.triangle_count())
            .map(|i| surface.corners(i))
            .collect::<Vec<_>>()
    };
    assert_eq!(corners(&again), corners(&scene));
    let values = |scene: &Scene| {
        let rigid = &scene.surfaces[0];
        (
            rigid.friction,
            rigid.distance_threshold,
            rigid.penalty_stiffness,
        )
    };
    assert_eq!(values(&again), values(&scene));
    assert_eq!(again.volumetric_strain, scene.volumetric_strain);
}

#[test]
fn what_cannot_be_written_is_refused_by_name() {
    for (name, what) in [
        ("rings_2d.json", "mortar contact"),
        ("disc_bounce_2d.json", "the shape of body"),
    ] {
        let mut scene = read(&Path::new("../../fixtures/scenes").join(name)).expect("a scene");
        // They are refused for themselves.
        scene.probes.clear();
        let refused = write(&scene).expect_err(name).to_string();
        assert!(refused.contains(what), "{name}: {refused}");
    }
    let path = Path::new("../../fixtures/scenes/sphere_on_terrain.json");
    let mut scene = read(path).expect("a scene");
    scene.probes.clear();
    for surface in &mut scene.surfaces {
        surface.motion = Some(History {
            times: vec![0.0],
            values: vec![[1.0, 0.0, 0.0]],
        });
    }
    let refused = write(&scene).expect_err("it moves").to_string();
    assert!(refused.contains("a rigid surface that moves"), "{refused}");
    // A rigid line that nothing is in contact with is no reason to forget it.
    let path = Path::new("../../fixtures/scenes/rolling_disc_2d.json");
    let mut scene = read(path).expect("a scene");
    scene.mortar.boundaries.clear();
    scene.mortar.contacts.clear();
    let refused = write(&scene).expect_err("a line").to_string();
    assert!(refused.contains("a rigid line"), "{refused}");
}

#[test]
fn an_axisymmetric_mesh_is_read_and_written() {
    let text = |plane: &str| {
        format!(
            r#"{{"dimension": 2, "time": 1, "mesh": {{"axisymmetric": true, "cells_dimension": [1, 1],
            "cells_number": [4, 4], "boundary_conditions": {{"plane_X0": "{plane}"}}}},
            "material": [{{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 1000}}],
            "body": [{{"type": "disc", "id": 1, "material_id": 1, "center": [0, 2], "radius": 2}},
                {{"type": "cuboid", "id": 2, "material_id": 1, "point_p1": [3, 0], "point_p2": [4, 1]}}]}}"#
        )
    };
    let read = |plane: &str| from_json(&text(plane), "ball", Path::new("."));
    let mut scene = read("sliding").expect("half of a disc on the axis is a ball");
    assert!(scene.mesh.axisymmetric);
    // The writer knows cuboids alone.
    scene.bodies.remove(0);
    assert_eq!(back(&scene).mesh, scene.mesh);
    let refused = read("fixed").expect_err("nothing on the axis moves along it");
    assert!(
        refused
            .to_string()
            .contains("mesh.boundary_conditions.plane_X0"),
        "{refused}"
    );
}
