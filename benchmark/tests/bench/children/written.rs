//! Scenes as other solvers get them.

use proctor_benchmark::bench::children::Word;
use proctor_benchmark::bench::children::written::written;
use proctor_files::json::from_json;
use serde_json::{Value, json};

/// A scene as other solvers get it; mesh and steps are those of a whole scene beside it.
fn handed(scene: Value) -> Value {
    let whole = Word::Planes.scene(2).expect("a scene");
    let folder = tempfile::TempDir::new().expect("a folder");
    let whole = from_json(&whole.to_string(), "word", folder.path()).expect("a scene");
    assert!(whole.results.print > 0);
    written(scene, &whole)
}

#[test]
fn numbers_are_rounded_to_what_a_decimal_keeps() {
    let value =
        handed(json!({ "a": [0.1 + 0.2, 7, -1.0 / 3.0], "b": { "c": 3.0 * 0.1e-7 }, "d": "0.1" }));
    let wanted = json!({
        "a": [0.3, 7, -0.333_333_333_333_333], "b": { "c": 3e-8 }, "d": "0.1"
    });
    for key in ["a", "b", "d"] {
        assert_eq!(value[key], wanted[key]);
    }
}

#[test]
fn scenes_speak_as_the_manuals_do() {
    let scene =
        handed(json!({ "shape_function": "uGIMP", "results": { "print": 2, "fields": ["id"] } }));
    let wanted = json!({
        "shape_function": "GIMP", "results": { "print": 2, "material_point_results": ["id"] }
    });
    for key in ["shape_function", "results"] {
        assert_eq!(scene[key], wanted[key]);
    }
}
