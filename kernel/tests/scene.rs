//! Scenes that a library user fills by hand.

use proctor_kernel::{transfers, weighting};
use proctor_laws::LinearElastic;
use proctor_scene::{
    Body, Dimension, DomainUpdate, History, InitialStress, Material, Mesh, PointLoad, Scene, Shape,
    TimeStep, Traction, TransferKind, Weighting,
};

fn sound() -> Scene {
    let mesh = Mesh::new(Dimension::Two, [0.0, 0.0, 7.0], [0.5; 3], [4; 3]);
    let mut scene = Scene::new(Dimension::Two, mesh, 1.0);
    scene.materials.push(Material {
        name: "rock".to_owned(),
        id: 1,
        density: 2000.0,
        law: LinearElastic::new(1e6, 0.2).into(),
    });
    scene.bodies.push(Body {
        name: "block".to_owned(),
        id: 1,
        material: 0,
        shape: Shape::Cuboid {
            p1: [0.0; 3],
            p2: [1.0, 1.0, 0.0],
        },
        particles_per_cell: [2, 2, 1],
        velocity: [0.0; 3],
        motion: None,
        initial_stress: InitialStress::None,
    });
    scene
}

#[test]
fn a_sound_scene_passes() {
    assert_eq!(sound().check(), Ok(()));
}

type Spoil = fn(&mut Scene);

/// Each value that a file could not even hold, or that only a library user can get wrong.
#[test]
fn every_problem_is_found_by_path() {
    let cases: [(&str, Spoil); 14] = [
        ("time", |s| s.time = f64::NAN),
        ("time_step", |s| {
            s.time_step = TimeStep::Fixed {
                dt: f64::INFINITY,
                allow_unstable: true,
            };
        }),
        ("gravity[1]", |s| s.gravity[1] = f64::NEG_INFINITY),
        ("gravity[2]", |s| s.gravity[2] = -9.81),
        ("mesh.cells_number[0]", |s| s.mesh.cells[0] = 0),
        ("mesh.cells_number", |s| s.mesh.cells[0] = usize::MAX),
        ("mesh", |s| s.mesh.cells[2] = 2),
        ("materials[0].density", |s| {
            s.materials[0].density = f64::NAN;
        }),
        ("bodies[0].material_id", |s| s.bodies[0].material = 1),
        ("bodies[0].particles_per_cell[2]", |s| {
            s.bodies[0].particles_per_cell[2] = 2;
        }),
        ("bodies[0].type", |s| {
            s.bodies[0].shape = Shape::Cylinder {
                p1: [0.0; 3],
                p2: [1.0; 3],
                radius: 0.1,
            };
        }),
        ("bodies[0].prescribed_velocity", |s| {
            s.bodies[0].motion = Some(History {
                times: vec![],
                values: vec![],
            });
        }),
        ("nodal_point_load[0][0]", |s| {
            s.point_loads.push(PointLoad {
                position: [0.5, 0.5 + 1e-3, 0.0],
                force: [1.0, 0.0, 0.0],
            });
        }),
        ("traction[0].point_p2", |s| {
            s.tractions.push(Traction {
                p1: [0.0; 3],
                p2: [1.0, 1.0, 0.0],
                traction: [1.0, 0.0, 0.0].into(),
            });
        }),
    ];
    for (path, spoil) in cases {
        let mut scene = sound();
        spoil(&mut scene);
        let error = scene.check().expect_err(path);
        let paths: Vec<_> = error.problems.iter().map(|p| p.path.as_str()).collect();
        assert_eq!(paths, [path], "{error}");
        assert!(error.problems[0].location.is_none());
    }
}

/// Every method is in its list, once, under a name of its own.
#[test]
fn methods_stand_in_their_lists() {
    let updates = [
        DomainUpdate::Determinant,
        DomainUpdate::Stretch,
        DomainUpdate::LeftStretch,
    ];
    let mut weightings = updates.map(Weighting::ContiguousGimp).to_vec();
    weightings.extend([
        Weighting::Linear,
        Weighting::UniformGimp,
        Weighting::QuadraticBSpline,
    ]);
    assert_eq!(weighting::ALL.len(), weightings.len());
    for one in &weightings {
        assert_eq!(one.kind().weighting, *one);
        let same_name = |kind: &&weighting::WeightingType| kind.name == one.kind().name;
        assert_eq!(weighting::ALL.iter().filter(same_name).count(), 1);
        assert_eq!(one.kind().update.is_some(), one.domain_update().is_some());
    }
    let transfers = [
        TransferKind::Flip,
        TransferKind::Apic,
        TransferKind::Tpic,
        TransferKind::Mls,
    ];
    assert_eq!(transfers::ALL.len(), transfers.len());
    for one in transfers {
        assert_eq!(one.kind().transfer, one);
    }
}
