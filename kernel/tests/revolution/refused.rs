//! Refusals: scenes without an axisymmetric form, by name and with what is accepted.

use super::cylinder;
use crate::common::MLS;
use proctor_scene::{BaseMotion, Dimension, Motion, PlaneCondition, PointLoad, Scene, Weighting};

type Spoil = (&'static str, fn(&mut Scene));

const SPOILT: [Spoil; 10] = [
    ("mesh.origin[0]", |scene| scene.mesh.origin[0] = -0.1),
    ("mesh.boundary_conditions.plane_X0", |scene| {
        scene.mesh.planes[0][0] = PlaneCondition::Fixed;
    }),
    ("mesh.boundary_conditions.plane_X0", |scene| {
        scene.mesh.planes[0][0] = PlaneCondition::Free;
    }),
    ("mesh.boundary_conditions.plane_Xn", |scene| {
        scene.mesh.planes[0][1] = PlaneCondition::Antisymmetric;
    }),
    ("gravity[0]", |scene| scene.gravity = [1.0, 0.0, 0.0]),
    ("transfer", |scene| {
        scene.weighting = Weighting::QuadraticBSpline;
        scene.transfer = MLS;
    }),
    ("earthquake.plane", |scene| {
        scene.base_motion = Some(BaseMotion {
            axis: 0,
            side: 1,
            motion: Motion::Velocity([0.0, 0.1, 0.0].into()),
        });
    }),
    ("earthquake.file", |scene| {
        scene.base_motion = Some(BaseMotion {
            axis: 1,
            side: 0,
            motion: Motion::Velocity([0.1, 0.0, 0.0].into()),
        });
    }),
    ("nodal_point_load[0][1][0]", |scene| {
        scene.point_loads = vec![PointLoad {
            position: [0.0, 0.6, 0.0],
            force: [1.0, 0.0, 0.0],
        }];
    }),
    ("bodies[0].prescribed_velocity", |scene| {
        scene.bodies[0].motion = Some([0.1, 0.0, 0.0].into());
    }),
];

#[test]
fn what_has_no_axisymmetric_form_is_refused_by_name() {
    assert!(cylinder().check().is_ok());
    for (path, spoil) in SPOILT {
        let mut scene = cylinder();
        spoil(&mut scene);
        let error = scene.check().expect_err(path);
        let found: Vec<&str> = error.problems.iter().map(|p| p.path.as_str()).collect();
        assert_eq!(found, [path]);
        assert!(!error.problems[0].accepted.is_empty());
    }
}

#[test]
fn three_dimensions_are_refused() {
    let mut scene = crate::common::block(Dimension::Three);
    scene.mesh.axisymmetric = true;
    let error = scene.check().expect_err("refused");
    assert_eq!(error.problems[0].path, "mesh.axisymmetric");
}
