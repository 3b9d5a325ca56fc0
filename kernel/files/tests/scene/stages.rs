//! Stages of a scene: what each changes, and what is wrong with a stage.

use std::path::Path;

use proctor_files::json::{SceneSource, Stage};
use proctor_scene::{Damping, InitialStress, PlaneCondition};

/// A scene with stages, as a text.
fn text(stages: &str) -> String {
    format!(
        r#"{{
    "dimension": 2, "time": 1, "gravity": [0, -10],
    "damping": {{"type": "local", "value": 0.7}},
    "mesh": {{"cells_dimension": [0.5, 0.5], "cells_number": [4, 8], "boundary_conditions": {{"plane_Yn": "free"}}}},
    "material": [{{"id": 0, "type": "elastic", "young": 1e7, "poisson": 0.3, "density": 2000}}],
    "body": [{{
        "type": "rectangle", "id": 7, "material_id": 0, "point_p1": [0, 0], "point_p2": [2, 2],
        "initial_stress": {{"type": "at_rest", "ratio": 0.5, "level": 2}}
    }}],
    "stages": {stages}
}}"#
    )
}

fn read(stages: &str) -> Result<Vec<Stage>, String> {
    let text = text(stages);
    let source = SceneSource::stream("scene", Path::new(""), text.as_bytes());
    let source = source.expect("a text");
    source.stages().map_err(|error| error.to_string())
}

#[test]
fn a_stage_changes_what_it_names() {
    let stages = read(
        r#"[
        {"name": "settle", "time": 5, "until": {"unbalanced_force": 1e-3}},
        {"name": "shake", "velocity": "kept", "damping": null,
         "mesh": {"boundary_conditions": {"plane_Y0": "absorbing"}}}
    ]"#,
    )
    .expect("sound");
    let [settle, shake] = &stages[..] else {
        panic!("two stages");
    };
    assert_eq!((&*settle.name, &*shake.name), ("settle", "shake"));
    assert_eq!((settle.scene.time, settle.scene.until), (5.0, Some(1e-3)));
    assert_eq!((shake.scene.time, shake.scene.until), (1.0, None));
    assert_eq!(settle.scene.damping, Damping::Local { alpha: 0.7 });
    assert_eq!(shake.scene.damping, Damping::None);
    let planes = &shake.scene.mesh.planes[1];
    assert_eq!(*planes, [PlaneCondition::Absorbing, PlaneCondition::Free]);
    assert!(settle.scene.initial_state.is_none());
    let state = shake.scene.initial_state.as_ref().expect("a state");
    assert_eq!(
        (state.file.as_path(), state.keeps_velocity),
        (Path::new("settle"), true)
    );
    // What a body began with is in its state.
    assert_ne!(settle.scene.bodies[0].initial_stress, InitialStress::None);
    assert_eq!(shake.scene.bodies[0].initial_stress, InitialStress::None);
    assert_eq!(shake.scene.name, "scene, shake");
}

/// Ground at rest needs gravity along one axis in the stage that begins with it, not in those that tilt gravity later.
#[test]
fn gravity_of_a_later_stage_may_have_any_direction() {
    let stages = read(r#"[{"name": "rest", "time": 0.1}, {"name": "slide", "gravity": [5, -10]}]"#)
        .expect("sound");
    assert_eq!(stages[1].scene.gravity, [5.0, -10.0, 0.0]);
    assert_eq!(
        stages[1].scene.bodies[0].initial_stress,
        InitialStress::None
    );
    let error =
        read(r#"[{"name": "slide", "gravity": [5, -10]}]"#).expect_err("tilted at the start");
    assert!(error.contains("gravity along one axis"), "{error}");
}

#[test]
fn a_scene_without_stages_is_one() {
    let text = text("[]").replace(",\n    \"stages\": []", "");
    let source = SceneSource::stream("scene", Path::new(""), text.as_bytes());
    let stages = source.expect("a text").stages().expect("sound");
    assert_eq!(stages.len(), 1);
    assert_eq!((&*stages[0].name, &*stages[0].scene.name), ("", "scene"));
}

/// Each with its place in the file, whether the stage has it or the scene.
#[test]
fn what_is_wrong_has_its_place() {
    for (stages, expected) in [
        (
            "3",
            "<scene>:10:15: stages: found a number; accepted: a list of objects",
        ),
        (
            "[]",
            "<scene>:10:15: stages: found an empty list; accepted: a list of objects",
        ),
        ("[3]", "<scene>:10:16: stages[0]: found a number"),
        (
            "[{}]",
            "<scene>:10:16: stages[0].name: found nothing: the key is missing",
        ),
        (
            r#"[{"name": "a b"}]"#,
            "<scene>:10:25: stages[0].name: found \"a b\"",
        ),
        (
            r#"[{"name": "a"}, {"name": "a"}]"#,
            "<scene>:10:40: stages[1].name: found \"a\", the name of an earlier stage",
        ),
        (
            r#"[{"name": "a", "velocity": 1}]"#,
            "<scene>:10:42: stages[0].velocity: found 1; accepted: `zero` or `kept`",
        ),
        (
            r#"[{"name": "a"}, {"name": "b", "time": -1}]"#,
            "<scene>:10:53: stages[1].time: found -1",
        ),
        (
            r#"[{"name": "a", "mesh": {"boundary_conditions": {"plane_X0": "slidin"}}}]"#,
            "<scene>:10:75: stages[0].mesh.boundary_conditions.plane_X0: found \"slidin\"",
        ),
        (
            r#"[{"name": "a", "tmie": 1}]"#,
            "<scene>:10:30: stages[0].tmie: found the unknown key",
        ),
        // A body of the scene is outside of a mesh that a stage makes smaller.
        (
            r#"[{"name": "a", "mesh": {"cells_number": [4, 2]}}]"#,
            "<scene>:7:93: body[0].point_p2[1]",
        ),
        (
            r#"[{"name": "a", "stages": []}]"#,
            "stages[0].stages: found stages in a stage",
        ),
        (
            r#"[{"name": "a", "velocity": "kept"}]"#,
            "<scene>:10:42: stages[0].velocity: found \"kept\" in the first stage",
        ),
        (
            r#"[{"name": "a"}, {"name": "b", "initial_state": {"file": "c.bin"}}]"#,
            "<scene>:10:62: stages[1].initial_state: found the state of another run",
        ),
        // Bodies go on with their particles: what those lack, no later stage can need.
        (
            r#"[{"name": "a"}, {"name": "b", "mesh": {"cells_dimension": [0.25, 0.25], "cells_number": [8, 16]}}]"#,
            "<scene>:10:73: stages[1].mesh.cells_dimension: found cells of [0.25, 0.25] m after a stage with cells of [0.5, 0.5] m",
        ),
        (
            r#"[{"name": "a"}, {"name": "b", "shape_function": "cpGIMP"}]"#,
            "<scene>:10:63: stages[1].shape_function: found the body",
        ),
        (
            r#"[{"name": "a"}, {"name": "b", "material":
                [{"id": 0, "type": "neo_hookean", "young": 1e7, "poisson": 0.3, "density": 2000}]}]"#,
            "needs \"deformation gradient 1\" of its particles",
        ),
    ] {
        let error = read(stages).expect_err("refused");
        assert!(error.contains(expected), "{stages}: {error}");
    }
}
