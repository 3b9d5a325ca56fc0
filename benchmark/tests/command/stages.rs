//! Scenes with stages: error bars behind the stages before, a stage that goes on from its checkpoint, loads that change.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

fn staged() -> Value {
    let text = fs::read_to_string(fixture("fixtures/refine/stages.json")).expect("a scene");
    serde_json::from_str(&text).expect("JSON")
}

/// Modulus of confined compression of the scene \[Pa\].
const CONFINED: f64 = 1e8 * 0.7 / (1.3 * 0.4);

fn columns(desk: &Desk, file: &str) -> Vec<(String, Vec<f64>)> {
    let text = fs::read_to_string(desk.path(file)).expect("a table");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let rows: Vec<Vec<&str>> = lines.collect();
    let of = |at: usize| {
        rows.iter()
            .map(|row| row[at].parse().unwrap_or(f64::NAN))
            .collect()
    };
    head.iter()
        .enumerate()
        .map(|(at, name)| ((*name).to_owned(), of(at)))
        .collect()
}

fn column(desk: &Desk, file: &str, name: &str) -> Vec<f64> {
    let found = columns(desk, file).into_iter().find(|(own, _)| own == name);
    found.unwrap_or_else(|| panic!("{name} in {file}")).1
}

/// The top of a column to which weight comes at once goes down by twice what it sinks at rest.
#[test]
fn a_bar_behind_a_stage_holds_the_exact_answer() {
    let desk = Desk::new();
    let (json, bars) = (desk.name("bars.json"), desk.name("bars"));
    let mut scene = staged();
    scene["results"]["history_interval"] = json!(0.005);
    let path = desk.scene("stages.json", &scene);
    // A wave goes down and up in two lengths over its speed.
    let lowest = 16.0 / (CONFINED / 2000.0).sqrt();
    let quantity = format!("dip=top_uy@{lowest}");
    let output = proctor(&[
        "refine",
        &path,
        "--finer",
        "1",
        "--quantity",
        &quantity,
        "--json",
        &json,
        "--svg",
        &bars,
    ]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let record: Value =
        serde_json::from_str(&fs::read_to_string(&json).expect("a record")).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows");
    let bar = rows.iter().find(|row| {
        row["name"]
            .as_str()
            .is_some_and(|name| name.ends_with("dip_bar"))
    });
    let bar = bar.expect("a bar");
    let [value, width] =
        ["value_dip", "uncertainty_dip"].map(|key| bar[key].as_f64().expect("a number"));
    let exact = -2000.0 * 2.0 * 64.0 / CONFINED;
    // A history of 5 ms rounds the tip of the dip by less than the bar.
    assert!(
        (value - exact).abs() < width,
        "{value} +- {width}, exact {exact}"
    );
    assert!(width < -0.2 * exact, "{width}");
    // A row for each 5 ms, with its bar.
    let table = columns(&desk, "bars/stages-swing-dip-time.csv");
    let names: Vec<&str> = table.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["time", "top_uy", "bar"]);
    let times = &table[0].1;
    assert_eq!(times.len(), 81);
    assert!(
        times
            .iter()
            .enumerate()
            .all(|(k, time)| (time - 0.005 * k as f64).abs() < 1e-12)
    );
    assert!(
        table[2].1.iter().skip(20).all(|bar| *bar > 0.0),
        "{:?}",
        table[2].1
    );
}

/// The stages of a refinement are those of a run: the scene's own mesh gives the same bits.
#[test]
fn the_mesh_of_the_scene_gives_what_its_run_gives() {
    let desk = Desk::new();
    let path = desk.scene("stages.json", &staged());
    let json = desk.name("bars.json");
    let more = [
        "--finer",
        "1",
        "--quantity",
        "c=body1_y@end",
        "--json",
        &json,
    ];
    let output = proctor(&[&["refine", path.as_str()], &more[..]].concat());
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert_eq!(code(&desk.run(&path, "out", &[])), 0);
    let last = *column(&desk, "out/2-swing/history.csv", "body1_y")
        .last()
        .expect("a row");
    let record: Value =
        serde_json::from_str(&fs::read_to_string(&json).expect("a record")).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows");
    let own = rows
        .iter()
        .find(|row| row["cell_size"] == 1.0 && row["value_c"].is_f64());
    let own = own.expect("the middle mesh");
    assert_eq!(own["value_c"].as_f64(), Some(last));
}

#[test]
fn what_cannot_be_refined_or_go_on_is_named() {
    let desk = Desk::new();
    let path = desk.scene("stages.json", &staged());
    let output = proctor(&["refine", &path, "--finer", "1", "--stage", "quake"]);
    assert_eq!(code(&output), 2);
    let text = stderr(&output);
    assert!(
        text.contains("--stage: found \"quake\"; accepted: settle, swing"),
        "{text}"
    );
    let output = proctor(&["refine", &path, "--finer", "1", "--stage", "settle"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("note: `until` does not end"),
        "{}",
        stderr(&output)
    );
    // A state of one mesh is none of another.
    assert_eq!(code(&desk.run(&path, "out", &[])), 0);
    let mut one = staged();
    let object = one.as_object_mut().expect("an object");
    object.remove("stages");
    object["body"]["column"]
        .as_object_mut()
        .expect("a body")
        .remove("initial_stress");
    object.insert("initial_state".into(), json!({"file": "out/1-settle"}));
    let one = desk.scene("one.json", &one);
    let output = proctor(&["refine", &one, "--finer", "1"]);
    assert_eq!(code(&output), 2);
    let text = stderr(&output);
    assert!(
        text.contains("one.json:") && text.contains("as a stage before this one"),
        "{text}"
    );
}

/// Refused with its place by `plan` and by `run`, before the first stage has written anything.
#[test]
fn stages_that_contradict_each_other_write_nothing() {
    let desk = Desk::new();
    let mut scene = staged();
    scene["shape_function"] = json!("GIMP");
    scene["stages"][1]["shape_function"] = json!("cpGIMP");
    let path = desk.scene("stages.json", &scene);
    for output in [proctor(&["plan", &path]), desk.run(&path, "out", &[])] {
        assert_eq!(code(&output), 2, "{}", stdout(&output));
        let text = stderr(&output);
        assert!(
            text.contains("stages.json:") && text.contains("stages[1].shape_function: found"),
            "{text}"
        );
    }
    assert!(!desk.path("out").exists(), "nothing is written");
}

/// A stage that was cut goes on from the checkpoint in its folder, and the stages before it stay as they are.
#[test]
fn a_stage_goes_on_from_its_checkpoint() {
    let desk = Desk::new();
    let whole = desk.scene("stages.json", &staged());
    assert_eq!(code(&desk.run(&whole, "whole", &[])), 0);
    // The end of a run is one of the things that a restart may change.
    let mut short = staged();
    short["stages"][1]["time"] = json!(0.2);
    short["stages"][1]["results"] = json!({"print": 4});
    let short = desk.scene("stages.json", &short);
    assert_eq!(code(&desk.run(&short, "cut", &[])), 0);
    let before = fs::read(desk.path("cut/1-settle/history.csv")).expect("a history");
    let whole = desk.scene("stages.json", &staged());
    let checkpoint = desk.name("cut/2-swing/checkpoint.bin");
    let output = desk.run(&whole, "cut", &["--restart", &checkpoint]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        !stdout(&output).contains("stage settle"),
        "{}",
        stdout(&output)
    );
    for key in ["state_hash", "steps", "time", "energy"] {
        assert_eq!(
            desk.summary("whole/2-swing")[key],
            desk.summary("cut/2-swing")[key],
            "{key}"
        );
    }
    assert_eq!(
        before,
        fs::read(desk.path("cut/1-settle/history.csv")).expect("a history")
    );
    // Another place, and another scene.
    fs::copy(
        desk.path("cut/2-swing/checkpoint.bin"),
        desk.path("lost.bin"),
    )
    .expect("a copy");
    let output = desk.run(&whole, "cut", &["--restart", &desk.name("lost.bin")]);
    assert_eq!(code(&output), 2);
    let text = stderr(&output);
    assert!(
        text.contains("the folder of a stage, 1-settle, 2-swing"),
        "{text}"
    );
    let mut other = staged();
    other["stages"][1]["pic_fraction"] = json!(0.1);
    let other = desk.scene("stages.json", &other);
    let output = desk.run(&other, "cut", &["--restart", &checkpoint]);
    assert_eq!(code(&output), 2);
    let text = stderr(&output);
    assert!(
        text.contains("A restart may change `time`") && text.contains("initial_state"),
        "{text}"
    );
}

/// Gravity, damping, box loads and planes change between stages. Sinking is that of confined compression: of the weight
/// rho g (H y - y^2/2)/M, of a force p y/M; once more the force sinks it less beside a plane that holds it upright.
#[test]
fn loads_damping_and_planes_change_between_stages() {
    let desk = Desk::new();
    let mut scene = staged();
    let object = scene.as_object_mut().expect("an object");
    object["body"]["column"]
        .as_object_mut()
        .expect("a body")
        .remove("initial_stress");
    object["time"] = json!(1.0);
    object["gravity"] = json!([0, 0]);
    let damped = json!({"type": "local", "value": 0.7});
    let force = 4e5;
    let load = |times: f64| json!([{"force": [0, -times * force], "point_p1": [0, 7.5], "point_p2": [4, 8]}]);
    object["stages"] = json!([
        {"name": "empty"},
        {"name": "weight", "gravity": [0, -9.81], "damping": damped},
        {"name": "load", "gravity": [0, -9.81], "damping": damped, "box_load": load(1.0)},
        {"name": "held", "gravity": [0, -9.81], "damping": damped, "box_load": load(2.0),
         "mesh": {"boundary_conditions": {"plane_X0": "antisymmetric"}}}
    ]);
    let path = desk.scene("loads.json", &scene);
    let output = desk.run(&path, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let sunk = |stage: &str| {
        -column(&desk, &format!("out/{stage}/history.csv"), "top_uy")
            .last()
            .copied()
            .expect("a row")
    };
    assert_eq!(sunk("1-empty"), 0.0);
    // The highest particle is a quarter of a cell below the top.
    let (h, y) = (8.0, 7.75);
    let weight = 2000.0 * 9.81 * (h * y - 0.5 * y * y) / CONFINED;
    let found = sunk("2-weight");
    assert!((found / weight - 1.0).abs() < 0.02, "{found} {weight}");
    // The pressure grows over the upper half metre: half of it is above 7.75 m, three quarters between 7.5 and 7.75 m.
    let load = force / 4.0 * (7.5 + 0.75 * 0.25) / CONFINED;
    let found = sunk("3-load");
    assert!((found / load - 1.0).abs() < 0.03, "{found} {load}");
    let found = sunk("4-held");
    assert!(found > 0.0 && found < 0.8 * load, "{found} {load}");
}
