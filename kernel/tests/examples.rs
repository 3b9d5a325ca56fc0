//! The examples run, and what they assert holds.

use std::error::Error;

#[path = "../examples/without_json.rs"]
mod without_json;

#[test]
fn a_scene_without_json() -> Result<(), Box<dyn Error>> {
    without_json::run()
}
