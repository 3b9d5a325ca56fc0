//! Warnings of vertices of mortar contact that have left their body.

use crate::command::support::{Desk, code, fixture, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// Two rings that meet at twice the speed of the scene of the repository, on cells twice as wide: what is printed, and how far
/// a vertex is off its body at the end, in cells.
fn collision(follow: Option<&str>) -> (String, f64) {
    const CELL: f64 = 0.004;
    let desk = Desk::new();
    let text = fs::read_to_string(fixture("fixtures/scenes/rings_2d.json")).expect("a fixture");
    let mut scene: Value = serde_json::from_str(&text).expect("JSON");
    scene["time"] = json!(0.002);
    scene["results"]["print"] = json!(2);
    scene["mesh"]["cells_dimension"] = json!([CELL, CELL]);
    scene["mesh"]["cells_number"] = json!([60, 40]);
    for (body, velocity) in [("left", 60.0), ("right", -60.0)] {
        let body = &mut scene["body"][body];
        body["initial_velocity"] = json!([velocity, 0.0]);
        body["boundary_segment"] = json!(0.99 * CELL);
        if let Some(follow) = follow {
            body["boundary_follows"] = json!(follow);
        }
    }
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let drift = desk.summary("out")["boundary_drift"]["in_cells"].clone();
    (stdout(&output), drift.as_f64().expect("a drift"))
}

/// Vertices that integrate velocities leave a ring that is bent hard, and the last lines of the run say so and what helps;
/// with that they stay, and nothing is said.
#[test]
fn a_boundary_that_left_its_body_is_told() {
    let (text, drift) = collision(None);
    assert!(drift > 0.1, "{drift}");
    assert!(
        text.contains("attention") && text.contains("\"boundary_follows\": \"material\""),
        "{text}"
    );
    let (text, drift) = collision(Some("material"));
    assert!(drift < 1e-9, "{drift}");
    assert!(!text.contains("boundary"), "{text}");
}
