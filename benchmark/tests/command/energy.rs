//! The energy balance of a run as its user reads it, with work of bodies that are driven and with what contact stores.

use crate::command::support::{Desk, code, fixture, stderr, stdout};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;

/// Runs a scene of the repository for so long; returns the energy in its summary, the first and the last row of its history,
/// and what was printed.
fn run(name: &str, time: f64) -> (Value, [BTreeMap<String, f64>; 2], String) {
    let desk = Desk::new();
    let text = fs::read_to_string(fixture(&format!("fixtures/scenes/{name}.json")));
    let mut scene: Value = serde_json::from_str(&text.expect("a fixture")).expect("JSON");
    scene["time"] = json!(time);
    scene["results"]["print"] = json!(2);
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let history = fs::read_to_string(desk.path("out").join("history.csv")).expect("a history");
    let mut lines = history.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().expect("names").collect();
    let rows: Vec<BTreeMap<String, f64>> = lines
        .map(|cells| {
            let values = cells.map(|cell| cell.parse().expect("a number"));
            names
                .iter()
                .map(|name| (*name).to_owned())
                .zip(values)
                .collect()
        })
        .collect();
    let [first, .., last] = &rows[..] else {
        panic!("one row: {history}");
    };
    let ends = [first.clone(), last.clone()];
    (desk.summary("out")["energy"].clone(), ends, stdout(&output))
}

/// While a piston speeds up, its own kinetic energy is part of the work too: 54 J of 118 J, without which more was stored than
/// given.
#[test]
fn the_work_that_speeds_up_a_piston_is_in_the_balance() {
    let (energy, _, text) = run("piston_2d", 0.03);
    let of = |key: &str| energy[key].as_f64().expect("a number");
    let stored = of("kinetic") + of("strain");
    // 300 kg at 0.6 m/s.
    let piston = 0.5 * 300.0 * 0.6 * 0.6;
    assert!(
        of("kinetic") > piston && of("strain") > 0.1 * piston,
        "{energy}"
    );
    assert!(
        (stored / of("external_work") - 1.0).abs() < 0.01,
        "{energy}"
    );
    assert!(
        of("dissipated").abs() < 0.01 * of("external_work"),
        "{energy}"
    );
    assert!(
        text.contains("external work   118.") && !text.contains("dissipated      -"),
        "{text}"
    );
}

/// The energy in the barrier of a mortar contact has a line of its own, in the summary and the history as on the terminal: the
/// printed energies add up.
#[test]
fn what_contact_stores_is_told() {
    let (energy, [first, last], text) = run("rolling_disc_2d", 0.02);
    let of = |key: &str| energy[key].as_f64().expect("a number");
    // The disc begins within reach of the plane.
    let start = first["energy_contact"];
    let stored = of("contact");
    assert!(
        start > 0.0 && (stored - start).abs() > 0.01 * start,
        "{energy}"
    );
    assert_eq!(last["energy_contact"], stored);
    let present = of("kinetic") + of("strain") + stored;
    let missing = start + of("external_work") - present;
    assert!(
        (missing - of("dissipated")).abs() < 1e-9 * present,
        "{energy}"
    );
    let line = text.lines().find(|line| line.starts_with("contact energy"));
    let told: Vec<&str> = line.unwrap_or_default().split_whitespace().collect();
    let [_, _, value, "J"] = told[..] else {
        panic!("{text}");
    };
    let value: f64 = value.parse().expect("a number");
    assert!((value / stored - 1.0).abs() < 1e-3, "{value} {stored}");
}
