//! `proctor stability`.

use crate::command::support::{Desk, code, fixture, flying_block, proctor, stderr, stdout};
use serde_json::{Value, json};

fn record(path: &str) -> Value {
    let text = std::fs::read_to_string(path).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn unknown_rows_and_schemes_are_bad_input_with_the_nearest_name() {
    for (option, word, nearest) in [
        ("--row", "rotaton", "rotation"),
        ("--scheme", "muls", "musl"),
    ] {
        let output = proctor(&["stability", option, word]);
        assert_eq!(code(&output), 2);
        let message = stderr(&output);
        assert!(
            message.contains(&format!("did you mean `{nearest}`?")),
            "{message}"
        );
        assert!(message.contains("accepted: "), "{message}");
        assert_eq!(stdout(&output), "");
    }
}

#[test]
fn rows_that_no_scheme_can_run_are_bad_input() {
    let output = proctor(&["stability", "--row", "mortar-line", "--scheme", "usf"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("mortar contact takes usl and musl"));
}

#[test]
fn a_record_that_cannot_be_written_is_found_before_the_work() {
    let desk = Desk::new();
    let output = proctor(&[
        "stability",
        "--quick",
        "--json",
        &desk.name("no/record.json"),
    ]);
    assert_eq!(code(&output), 2);
    assert_eq!(stdout(&output), "");
}

#[test]
fn a_row_leaves_its_limits_and_gates_in_the_record() {
    let desk = Desk::new();
    let path = desk.name("record.json");
    let options = [
        "--quick", "--row", "rotation", "--scheme", "USL", "--json", &path,
    ];
    let output = proctor(&[&["stability"], &options[..]].concat());
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("PASS: 1 of 1 gates of stability"));
    let record = record(&path);
    let rows = record["benchmarks"].as_array().expect("rows");
    assert_eq!(rows[0]["name"], "stability/rotation/uGIMP-USL-FLIP");
    let number = |key: &str| rows[0][key].as_f64().expect("a number");
    assert!(number("value_over_kernel_stable") > 1.0);
    assert!(number("value_over_kernel_unstable") > number("value_over_kernel_stable"));
    assert_eq!(rows[1]["aggregate_name"], "gate");
    let page = proctor(&["report", &path]);
    assert_eq!(code(&page), 0, "{}", stderr(&page));
}

/// Cells of one scheme in two dimensions: three sizes of four weighting functions with three transfers, and of B-splines with MLS.
const CELLS: usize = 3 * (4 * 3 + 1);

#[test]
fn the_picture_has_a_cell_for_each_method_and_size() {
    let desk = Desk::new();
    let (folder, path) = (desk.name("pictures"), desk.name("record.json"));
    let options = [
        "--row", "map", "--scheme", "musl", "--svg", &folder, "--json", &path,
    ];
    let output = proctor(&[&["stability", "--quick"], &options[..]].concat());
    // Whether the kernel's steps are short enough is for the gates.
    assert!(matches!(code(&output), 0 | 1), "{}", stderr(&output));
    let svg = std::fs::read_to_string(desk.path("pictures/stability.svg")).expect("a picture");
    // One of the picture and one of each cell.
    assert_eq!(svg.matches("<title>").count(), 1 + CELLS);
    assert_eq!(svg.matches("class=\"point\"").count(), CELLS);
    assert!(svg.contains("uGIMP MUSL FLIP, 2 per cell"));
    let text = stdout(&output);
    for word in [
        "FLIP, 2D",
        "APIC, 2D",
        "TPIC, 2D",
        "MLS, 2D",
        "B-spline MUSL",
        "gates of stability",
    ] {
        assert!(text.contains(word), "{word}: {text}");
    }
    let cells = &record(&path)["details"]["stability"]["cells"];
    assert_eq!(cells.as_array().expect("cells").len(), CELLS);
}

#[test]
fn a_scene_is_told_its_limit_and_what_would_allow_more() {
    let output = proctor(&[
        "stability",
        &fixture("fixtures/scenes/column_gravity_2d.json"),
    ]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let text = stdout(&output);
    for word in [
        "predicted critical step",
        "the kernel's step",
        "ruled by the particle",
        "MUSL FLIP",
        "cells twice as large",
    ] {
        assert!(text.contains(word), "{word}: {text}");
    }
}

/// Ground and fluid at rest, too: gravity, to which their stress refers, is no part of the linear step. It is that of the same
/// scene without stress.
#[test]
fn scenes_at_rest_are_told_their_limit() {
    for scene in ["ground_2d", "soil_element", "fluid_element"] {
        let output = proctor(&[
            "stability",
            &fixture(&format!("fixtures/scenes/{scene}.json")),
        ]);
        let text = stdout(&output);
        assert_eq!(code(&output), 0, "{scene}: {text}{}", stderr(&output));
        assert!(text.contains("predicted critical step"), "{scene}: {text}");
    }
    let desk = Desk::new();
    let step = |stress: Option<Value>, axes: usize| {
        let point = |x: f64| vec![x; axes];
        let mut gravity = vec![0.0; axes];
        gravity[axes - 1] = -9.81;
        let mut scene = json!({
            "dimension": axes, "time": 1, "gravity": gravity,
            "mesh": {"cells_dimension": point(0.25), "cells_number": vec![4; axes]},
            "material": [{"type": "elastic", "id": 1, "young": 1e6, "poisson": 0.3, "density": 1800}],
            "body": [{
                "type": "cuboid", "id": 1, "material_id": 1, "point_p1": point(0.0), "point_p2": point(0.75),
            }],
        });
        if let Some(stress) = stress {
            scene["body"][0]["initial_stress"] = stress;
        }
        let output = proctor(&["stability", &desk.scene("scene.json", &scene)]);
        assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
        let line = stdout(&output);
        let line = line
            .lines()
            .find(|line| line.contains("predicted critical step"));
        line.expect("a step").to_owned()
    };
    for axes in [2, 3] {
        let rest = json!({"type": "at_rest", "ratio": 0.5, "level": 0.75});
        assert_eq!(step(Some(rest), axes), step(None, axes));
        assert_eq!(
            step(Some(json!({"type": "isotropic", "value": -1e3})), axes),
            step(None, axes)
        );
    }
}

#[test]
fn a_step_above_the_predicted_one_fails() {
    let desk = Desk::new();
    let mut scene = flying_block();
    // c is 11.6 m/s and h 0.1 m: a Courant number of 1.
    scene["time_step"] = json!(0.0086);
    scene["allow_unstable"] = json!(true);
    let scene = desk.scene("scene.json", &scene);
    let output = proctor(&["stability", &scene]);
    assert_eq!(code(&output), 1, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("longer than the predicted critical one"));
}

/// A start at rest is not all: no step holds a body in tension with FLIP and MUSL.
#[test]
fn a_scene_in_tension_is_told_what_grows_and_what_holds() {
    let desk = Desk::new();
    for (scheme, status, word) in [
        ("MUSL", 1, "FAIL  no step holds"),
        ("USL", 0, "holds at the kernel's step"),
    ] {
        let scene = json!({
            "dimension": 2, "time": 8, "shape_function": "GIMP", "stress_scheme_update": scheme,
            "mesh": {
                "cells_dimension": [0.1, 0.1], "cells_number": [24, 4],
                "boundary_conditions": {"plane_X0": "fixed", "plane_Xn": "free"},
            },
            "material": [{"type": "neo_hookean", "id": 1, "young": 1e5, "poisson": 0.3, "density": 1000}],
            "body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0, 0], "point_p2": [1, 0.4]}],
            "box_load": [{"point_p1": [0.9, 0], "point_p2": [1, 0.4], "force": [8000, 0]}],
        });
        let output = proctor(&["stability", &desk.scene("pulled.json", &scene)]);
        let text = stdout(&output);
        assert_eq!(code(&output), status, "{text}{}", stderr(&output));
        assert!(text.contains(word), "{text}");
        assert!(
            text.contains("In tension: body[0], 2.00e4 Pa by a load that pulls"),
            "{text}"
        );
    }
}

#[test]
fn a_scene_that_is_refused_says_why() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["material"][0]["young"] = json!(-1.0);
    let scene = desk.scene("scene.json", &scene);
    let output = proctor(&["stability", &scene]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("young"), "{}", stderr(&output));
}

#[test]
fn an_unknown_extreme_scene_is_bad_input_with_the_nearest_name() {
    let output = proctor(&["stability", "--extreme", "--row", "sliver"]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    assert!(message.contains("did you mean `slivers`?"), "{message}");
    assert!(message.contains("accepted: "), "{message}");
    assert_eq!(stdout(&output), "");
    // A row of the map is none of these.
    let output = proctor(&["stability", "--extreme", "--row", "rotation"]);
    assert_eq!(code(&output), 2);
}

#[test]
fn extreme_scenes_go_with_no_choice_of_the_map() {
    for other in [
        &["--table"][..],
        &["--quick"],
        &["--scheme", "usl"],
        &["--svg", "pictures"],
        &["scene.json"],
    ] {
        let output = proctor(&[&["stability", "--extreme"], other].concat());
        assert_eq!(code(&output), 2, "{other:?}");
        assert!(
            stderr(&output).contains("cannot be used with"),
            "{}",
            stderr(&output)
        );
    }
}

#[test]
fn extreme_scenes_leave_rows_gates_and_a_page() {
    let desk = Desk::new();
    let (path, page) = (desk.name("record.json"), desk.name("page.html"));
    let rows = [
        "--row",
        "translation",
        "--row",
        "impossible-constants",
        "--json",
        &path,
    ];
    let output = proctor(&[&["stability", "--extreme"], &rows[..]].concat());
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    assert!(
        text.contains("PASS: 1 stiff and extreme scenes held, 1 refused with a reason, 0 failed"),
        "{text}"
    );
    assert!(text.contains("materials[0].young: found 0"), "{text}");
    let record = record(&path);
    let rows = record["benchmarks"].as_array().expect("rows");
    assert_eq!(rows[0]["name"], "stability/extreme/translation");
    assert_eq!(rows[0]["ending"], "held");
    assert_eq!(rows[1]["aggregate_name"], "gate");
    let last = rows.last().expect("rows");
    assert_eq!(last["name"], "stability/extreme/impossible-constants");
    assert_eq!(last["ending"], "refused");
    assert!(last["value_refusals"].as_f64().expect("a number") > 10.0);
    let details = &record["details"]["stability"]["extreme"];
    assert_eq!(details.as_array().expect("details").len(), 2);
    let output = proctor(&["report", &path, "--out", &page]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let html = std::fs::read_to_string(desk.path("page.html")).expect("a page");
    for word in [
        "stiff and extreme scenes",
        "impossible-constants",
        "nearest to its bound",
    ] {
        assert!(html.contains(word), "{word}");
    }
}
