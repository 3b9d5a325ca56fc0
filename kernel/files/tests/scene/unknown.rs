//! Content of files that no scene has: unknown keys, values of another type and words of other programs, all at once and
//! each with what does it here.

use std::path::Path;

use proctor_files::json::{all_elsewhere, blocks, from_json};
use proctor_scene::{Problem, Scene};
use serde_json::{Value, json};

fn read(text: &str) -> Result<Scene, Vec<Problem>> {
    from_json(text, "s.json", Path::new("../../fixtures/records")).map_err(|error| error.problems)
}

fn problems(text: &str) -> Vec<Problem> {
    read(text).map(|_| ()).expect_err("it is no scene")
}

/// The problems as their lines, without what is accepted.
fn told(text: &str) -> Vec<String> {
    let line = |problem: &Problem| {
        let at = problem.location.as_ref().expect("a place");
        let hint = problem.hint.as_deref().unwrap_or("");
        format!(
            "{}:{} {} {} ({hint})",
            at.line, at.column, problem.path, problem.found
        )
    };
    problems(text).iter().map(line).collect()
}

/// A sound scene in the plane.
fn sound() -> Value {
    json!({
        "dimension": 2,
        "time": 1,
        "mesh": {"cells_dimension": [0.5, 0.5], "cells_number": [4, 4]},
        "material": [{"type": "elastic", "id": 1, "young": 1e6, "density": 2000, "poisson": 0.25}],
        "body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0, 0], "point_p2": [1, 1]}],
        "results": {"print": 20},
    })
}

#[test]
fn unknown_keys_at_several_levels_come_at_once() {
    let text = r#"{
  "tmie": 1,
  "dimensoin": 2,
  "mesh": {"cells_dimension": [0.5, 0.5], "cell_number": [4, 4]},
  "material": {"rock": {"type": "elastic", "id": 1, "yuong": 1e6, "density": 2000, "poisson": 0.25}},
  "body": [
    {"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0, 0], "piont_p2": [1, 1]},
    {"type": "rectangle", "id": 2, "materail_id": 1, "initial_stress": {"type": "isotropic", "vlaue": 3}}
  ]
}"#;
    assert_eq!(
        told(text),
        [
            "2:3 tmie the unknown key `tmie` (did you mean `time`?)",
            "3:3 dimensoin the unknown key `dimensoin` (did you mean `dimension`?)",
            "4:43 mesh.cell_number the unknown key `cell_number` (did you mean `cells_number`?)",
            "5:53 material.rock.yuong the unknown key `yuong` (did you mean `young`?)",
            "7:74 body[0].piont_p2 the unknown key `piont_p2` (did you mean `point_p2`?)",
            "8:36 body[1].materail_id the unknown key `materail_id` (did you mean `material_id`?)",
            "8:94 body[1].initial_stress.vlaue the unknown key `vlaue` (did you mean `value`?)",
        ]
    );
    // The keys that an object has are listed once.
    let all = problems(text);
    assert!(all[0].accepted.starts_with("`dimension`"), "{}", all[0]);
    assert_eq!(all[1].accepted, "one of those listed above");
}

#[test]
fn other_types_and_words_come_with_them() {
    let text = r#"{
  "dimension": 2, "time": "long", "zzz": {"a": [1]}, "gravity": [0, true],
  "mesh": {"cells_dimension": [0.5, "x", 0.5], "cells_number": [4, 4.5]},
  "material": [{"type": "elastc", "id": "one", "young": 1e6}, 3],
  "body": [{"type": "rectangel", "id": 1, "id": 2, "particles_per_cell": 1.5}],
  "n_phases": 3
}"#;
    let told = told(text);
    let starts: Vec<&str> = told
        .iter()
        .map(|line| line.split(" (").next().unwrap_or(""))
        .collect();
    assert_eq!(
        starts,
        [
            r#"2:27 time "long""#,
            "2:35 zzz the unknown key `zzz`",
            "2:69 gravity[1] true",
            r#"3:37 mesh.cells_dimension[1] "x""#,
            "3:68 mesh.cells_number[1] 4.5",
            r#"4:25 material[0].type "elastc""#,
            r#"4:41 material[0].id "one""#,
            "4:63 material[1] 3",
            r#"5:21 body[0].type "rectangel""#,
            "5:43 body[0].id a key that was given before",
            "5:74 body[0].particles_per_cell 1.5",
            "6:15 n_phases 3",
        ],
        "{told:#?}"
    );
}

#[test]
fn a_key_that_is_unknown_twice_is_told_once_and_many_end_at_a_hundred() {
    let text = r#"{"zzz": 1, "zzz": 2, "yyy": 3}"#;
    assert_eq!(problems(text).len(), 2);
    let many: Vec<String> = (0..150).map(|i| format!("\"q{i}\": 0")).collect();
    assert_eq!(problems(&format!("{{{}}}", many.join(","))).len(), 100);
}

#[test]
fn a_scene_is_an_object() {
    for text in [
        "[{\"time\": 1}]",
        "[]",
        "[[1, 2], 3]",
        "3",
        "-2.5",
        "\"scene\"",
        "true",
        "null",
        "[{\"time\": 1}, {\"time\": 2}]",
    ] {
        let all = problems(text);
        assert_eq!(all.len(), 1, "{text}: {all:?}");
        assert!(
            all[0].accepted.contains("a scene is an object"),
            "{text}: {}",
            all[0]
        );
        assert_eq!(
            all[0].location.as_ref().map(|at| (at.line, at.column)),
            Some((1, 1)),
            "{text}"
        );
    }
}

/// So is everything else that has keys: its values in a list are none.
#[test]
fn a_list_is_no_object_anywhere() {
    let mut scene = sound();
    scene["damping"] = json!(["local", 0.1]);
    scene["body"][0] = json!(["rectangle", 1, 1]);
    scene["earthquake"] = json!([true, "record.csv"]);
    let all = problems(&scene.to_string());
    let paths: Vec<&str> = all.iter().map(|problem| problem.path.as_str()).collect();
    assert_eq!(paths, ["body[0]", "damping", "earthquake"], "{all:?}");
    for problem in &all {
        assert!(problem.accepted.starts_with("an object with"), "{problem}");
    }
}

#[test]
fn a_whole_number_may_be_written_with_a_point() {
    let with = |number: &str| {
        let text = sound().to_string();
        let text = text.replace("\"print\":20", &format!("\"print\":{number}"));
        let text = text.replace("\"dimension\":2", "\"dimension\":2.0");
        let text = text
            .replace("\"id\":1", "\"id\":1.0")
            .replace("[4,4]", "[4.0,4e0]");
        text.replacen('{', "{\"particles_per_cell\": 3.0, \"n_threads\": 2.0, ", 1)
    };
    for number in ["20.0", "2e1", "20", "0.2e2", "2.00E+1"] {
        let scene = read(&with(number)).unwrap_or_else(|all| panic!("{number}: {all:?}"));
        assert_eq!(scene.results.print, 20);
        assert_eq!(scene.mesh.cells, [4, 4, 1]);
        assert_eq!(scene.bodies[0].particles_per_cell, [3, 3, 1]);
        assert_eq!((scene.bodies[0].id, scene.threads), (1, Some(2)));
    }
    for number in ["20.5", "-20.0", "1e300", "\"20\"", "-1e-9"] {
        let all = problems(&with(number));
        assert_eq!(all.len(), 1, "{number}: {all:?}");
        assert_eq!(
            (all[0].path.as_str(), all[0].found.as_str()),
            ("results.print", number)
        );
        assert_eq!(all[0].accepted, "a whole number, 0 or more");
    }
    let mut scene = sound();
    scene["particles_per_cell"] = json!([2.0, 3.5]);
    let all = problems(&scene.to_string());
    assert_eq!(all[0].path, "particles_per_cell[1]", "{all:?}");
}

/// Each key of MPM-Geomechanics' own examples and reader that is none here has its answer.
#[test]
fn keys_of_other_programs_are_answered() {
    let answers = [
        ("", "load_state", "--restart"),
        ("", "save_state", "`results.checkpoint`"),
        ("", "no_load_distributed_box", "switched off"),
        ("", "hydro_mechanical_coupling", "not covered"),
        ("", "pore_pressure", "`initial_pressure_box`"),
        ("", "water", "`n_phases` 2"),
        ("", "drainage", "`boundary_conditions_fluid`"),
        ("", "ramp", "rows of a time"),
        ("", "pressure_force_box", "not covered"),
        ("", "dtFraction", "`critical_time_step_multiplier`"),
        ("", "nThreads", "`n_threads`"),
        ("", "analysis", "`time_step`"),
        ("", "particles", "`body`"),
        ("", "external_loading_conditions", "`gravity`"),
        ("mesh", "nCells", "`cells_number`"),
        ("mesh", "cellDimension", "`cells_dimension`"),
        ("mesh", "boundaryConditons", "`boundary_conditions`"),
        ("mesh", "type", "leave the key out"),
        ("mesh", "mesh", "`cells_dimension`"),
        ("material", "youngs_modulus", "`young`"),
        ("material", "poisson_ratio", "`poisson`"),
        ("body", "diameter", "`radius`"),
        ("body", "extrude_direction", "`axis`"),
        ("body", "extrude_displacement", "`range`"),
        ("body", "discretization_length", "`particles_per_cell`"),
        ("body", "particles_per_direction", "`particles_per_cell`"),
        ("body", "mesh_file", "not covered"),
        ("body", "physical_to_material", "not covered"),
        ("body", "particle_distribution", "not covered"),
        ("body", "active", "leave the body out"),
        ("body", "materialId", "`material_id`"),
        ("body", "pointP1", "`point_p1`"),
        ("results", "stl_contact_mesh", "not covered"),
        (
            "results",
            "material-point-results",
            "`material_point_results`",
        ),
        ("results", "grid-nodal-results", "`grid_nodal_results`"),
    ];
    for (block, key, answer) in answers {
        let mut scene = sound();
        let at = match block {
            "" => &mut scene,
            "material" | "body" => &mut scene[block][0],
            _ => &mut scene[block],
        };
        at[key] = json!(1);
        let all = problems(&scene.to_string());
        assert_eq!(all.len(), 1, "{all:?}");
        let hint = all[0].hint.as_deref().unwrap_or("nothing");
        assert!(hint.contains(answer), "{block}.{key}: {}", all[0]);
    }
}

#[test]
fn words_of_other_programs_are_answered() {
    for (block, word, answer) in [
        ("body", "polygon_2d", "extruded_polygon"),
        ("body", "particles_from_file", "`file`"),
        ("body", "particles_list", "`file`"),
        ("body", "gmsh", "not covered"),
        ("material", "LinearElastic2D", "\"elastic\""),
        ("material", "MohrCoulomb3D", "\"mohr_coulomb\""),
        ("material", "ModifiedCamClay2D", "not covered"),
    ] {
        let mut scene = sound();
        scene[block][0]["type"] = json!(word);
        let all = problems(&scene.to_string());
        let hint = all[0].hint.as_deref().unwrap_or("nothing");
        assert!(hint.contains(answer), "{word}: {}", all[0]);
    }
}

/// The peer's extruded polygon, whole: its type and its keys in one round.
#[test]
fn a_body_of_another_program_is_answered_whole() {
    let mut scene = sound();
    scene["body"][0] = json!({
        "type": "polygon_2d", "id": 1, "material_id": 1, "extrude_direction": "y", "extrude_displacement": 2,
        "discretization_length": 0.5, "points": [[0, 0, 0], [1, 0, 0], [1, 0, 1]],
    });
    scene["load_state"] = json!(true);
    let all = problems(&scene.to_string());
    let mut paths: Vec<&str> = all.iter().map(|problem| problem.path.as_str()).collect();
    paths.sort_unstable();
    assert_eq!(
        paths,
        [
            "body[0].discretization_length",
            "body[0].extrude_direction",
            "body[0].extrude_displacement",
            "body[0].type",
            "load_state",
        ],
        "{all:?}"
    );
}

/// The peer's list of particles, an object of lists.
#[test]
fn particles_as_lists_are_answered() {
    let mut scene = sound();
    scene["body"][0] = json!({
        "type": "particles", "id": 1, "material_id": 1, "particles": {"id": [1], "position": [[0, 0, 0]], "volume": [1]},
    });
    let all = problems(&scene.to_string());
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(
        all[0].to_string().contains("rows of position and volume"),
        "{}",
        all[0]
    );
}

/// The keys that an answer names exist, and no word that is a key of its block has an answer.
#[test]
fn answers_name_what_there_is() {
    let blocks = blocks();
    let named = |name: &str| {
        blocks.iter().any(|block| {
            let whole = |key: &str| format!("{}.{key}", block.path);
            (block.keys.iter()).any(|key| {
                key.name == name
                    || whole(&key.name) == name
                    || whole(&key.name).ends_with(&format!(".{name}"))
            })
        })
    };
    for other in all_elsewhere() {
        for key in other.keys {
            assert!(named(key), "{key} of {:?}", other.words);
        }
        for name in other.answer.split('`').skip(1).step_by(2) {
            let outside =
                name.starts_with("proctor run ") || name.starts_with("--") || name.contains("::");
            assert!(outside || named(name), "{name} in {:?}", other.answer);
        }
        for word in other.words {
            let of_block = blocks.iter().find(|block| block.path == other.within);
            let keys = of_block.into_iter().flat_map(|block| &block.keys);
            let is_key = keys.into_iter().any(|key| key.name == *word);
            assert!(!is_key, "{word} is a key of {:?}", other.within);
        }
    }
}

#[test]
fn a_rigid_line_wants_the_method_mortar() {
    let mut scene = sound();
    scene["rigid_line"] = json!([{"id": 9, "points": [[2, 0], [0, 0]]}]);
    let contact = |scene: &mut Value, master: i64, slave: i64| {
        scene["contact"] = json!([{"master_id": master, "slave_id": slave, "friction": 0.1}]);
    };
    for (master, slave, key) in [(9, 1, "master_id"), (1, 9, "slave_id")] {
        contact(&mut scene, master, slave);
        let all = problems(&scene.to_string());
        assert_eq!(all.len(), 1, "{all:?}");
        assert_eq!(all[0].path, format!("contact[0].{key}"));
        assert!(all[0].found.contains("9, a rigid line"), "{}", all[0]);
        assert!(
            all[0].accepted.contains("`\"method\": \"mortar\"`"),
            "{}",
            all[0]
        );
    }
    // An id that nothing has is told as before.
    contact(&mut scene, 1, 7);
    assert!(
        problems(&scene.to_string())[0]
            .found
            .contains("7, which no body has")
    );
    let solid = r#"{"time": 1, "mesh": {"cells_dimension": [0.5, 0.5, 0.5], "cells_number": [4, 4, 4]},
        "material": [{"type": "elastic", "id": 1, "young": 1e6, "density": 2000, "poisson": 0.25}],
        "body": [{"type": "cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}],
        "rigid_surface": {"floor": {"id": 4, "triangles": [[[0, 0, 0], [2, 0, 0], [0, 2, 0]]]}},
        "contact": {"a": {"master_id": 4, "slave_id": 1, "friction": 0}}}"#;
    let all = problems(solid);
    assert!(all[0].found.contains("4, a rigid surface"), "{}", all[0]);
}
