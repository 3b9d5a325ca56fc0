//! `proctor element`: materials on the paths of the laboratory.

use crate::command::support::{Desk, fixture, proctor, stderr, stdout};
use std::fs;

const SCENE: &str = "fixtures/scenes/soil_element.json";

#[test]
fn strength_is_told_beside_its_closed_form() {
    let output = proctor(&[
        "element",
        &fixture(SCENE),
        "--test",
        "triaxial",
        "--pressure",
        "1e5",
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    let mut compared = 0;
    for line in text.lines().filter(|line| line.contains("strength q")) {
        let numbers: Vec<&str> = line
            .split(": ")
            .nth(1)
            .expect("two numbers")
            .split(" Pa")
            .collect();
        assert_eq!(
            numbers[0],
            numbers[1].rsplit(' ').next().expect("a number"),
            "{line}"
        );
        compared += 1;
    }
    // Those without hardening and softening: sand, clay, gravel, lead.
    assert!(compared >= 4, "{text}");
    assert!(
        text.contains("rock (elastic): triaxial test from 1.000e5 Pa"),
        "{text}"
    );
}

#[test]
fn states_and_curves_are_written() {
    let desk = Desk::new();
    let folder = desk.path("curves");
    let folder = folder.to_str().expect("a path");
    let output = proctor(&[
        "element",
        &fixture(SCENE),
        "--material",
        "1",
        "--test",
        "shear",
        "--pressure",
        "1e5",
        "--steps",
        "20",
        "--csv",
        folder,
        "--svg",
        folder,
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let table = fs::read_to_string(desk.path("curves/sand-shear.csv")).expect("a table");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(
        lines.len(),
        22,
        "a heading, the start and a state for each step"
    );
    let columns: Vec<&str> = lines[0].split(',').collect();
    assert!(
        columns.contains(&"plastic_work") && columns.contains(&"stress_xz"),
        "{columns:?}"
    );
    for line in &lines[1..] {
        let numbers: Vec<f64> = line
            .split(',')
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        assert_eq!(numbers.len(), columns.len());
    }
    for word in ["q", "volume"] {
        let picture = fs::read_to_string(desk.path(&format!("curves/sand-shear-{word}.svg")));
        assert!(picture.expect("a picture").contains("shear test from"));
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    for (arguments, words) in [
        (&["--test", "triaxal"][..], "did you mean `triaxial`?"),
        (&["--material", "99"], "accepted: 1, 2, 3"),
        (&["--pressure", "-1"], "0 or greater [Pa]"),
        (&["--strain", "0"], "greater than 0, at most 1"),
        (&["--steps", "0"], "from 1 to"),
        (&["--time", "inf"], "a finite number greater than 0 [s]"),
    ] {
        let scene = fixture(SCENE);
        let all: Vec<&str> = ["element", &scene]
            .into_iter()
            .chain(arguments.iter().copied())
            .collect();
        let output = proctor(&all);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

/// Runs a table of the first material of the scene.
fn of_table(desk: &Desk, text: &str, more: &[&str]) -> std::process::Output {
    fs::write(desk.path("path.csv"), text).expect("a table");
    let (scene, table) = (fixture(SCENE), desk.name("path.csv"));
    let first = ["element", &scene, "--material", "1", "--table", &table];
    proctor(&[&first[..], more].concat())
}

#[test]
fn a_table_is_a_path() {
    let desk = Desk::new();
    let folder = desk.name("states");
    let text = "time, strain_zz, stress_xx, stress_yy\n0, 0, -1e5, -1e5\n1, -0.01, -1e5, -1e5\n\n2, 0.0, -2e5, -1e5\n";
    let more = [
        "--pressure",
        "1e5",
        "--steps",
        "50",
        "--csv",
        &folder,
        "--svg",
        &folder,
    ];
    let output = of_table(&desk, text, &more);
    assert!(
        output.status.success(),
        "{}{}",
        stdout(&output),
        stderr(&output)
    );
    assert!(stdout(&output).contains("path of the table from 1.000e5 Pa"));
    let states = fs::read_to_string(desk.path("states/sand-table.csv")).expect("states");
    assert_eq!(states.lines().count(), 1 + 1 + 2 * 50);
    let columns: Vec<&str> = states
        .lines()
        .next()
        .expect("a header")
        .split(',')
        .collect();
    let last = states.lines().last().expect("a state").split(',');
    let last: Vec<f64> = last.map(|cell| cell.parse().expect("a number")).collect();
    for (name, wanted) in [("time", 2.0), ("strain_zz", 0.0), ("stress_xx", -2e5)] {
        let at = columns.iter().position(|column| *column == name);
        let found = last[at.expect("a column")];
        assert!((found - wanted).abs() <= 1e-8 * 2e5, "{name}: {found}");
    }
    let picture = fs::read_to_string(desk.path("states/sand-table-q.svg")).expect("a picture");
    assert!(picture.contains("time (s)"));
}

#[test]
fn tables_that_are_no_path_are_refused_with_their_place() {
    for (text, words) in [
        (
            "time,strain_zx\n1,0.1\n",
            ":1:6: found the column \"strain_zx\"",
        ),
        (
            "time,strain_zz,stress_zz\n1,0,0\n",
            ":1:16: found the columns strain_zz and stress_zz",
        ),
        (
            "time,strain_zz,strain_zz\n1,0,0\n",
            ":1:16: found the column \"strain_zz\" again",
        ),
        ("strain_zz\n0.1\n", "no column time"),
        (
            "time,strain_zz\n1, much\n",
            ":2:4: found \"much\" in column strain_zz",
        ),
        ("time,strain_zz\n1,inf\n", "a finite number"),
        ("time,strain_zz\n1,0.1\n1,0.2\n", ":3:1: found the time 1"),
        ("time,strain_zz\n-1,0.1\n", "0 or greater [s]"),
        (
            "time,strain_zz\n0,0.1\n",
            "0.1 in column strain_zz at time 0",
        ),
        ("time,strain_zz\n1\n", "1 columns"),
        ("time,strain_zz\n", "no row to go to"),
        ("", "no row to go to"),
    ] {
        let output = of_table(&Desk::new(), text, &[]);
        assert_eq!(output.status.code(), Some(2), "{text}");
        let message = stderr(&output);
        assert!(message.contains(words), "{text}: {message}");
        assert!(message.contains("path.csv"), "{message}");
        assert!(message.contains("accepted"), "{message}");
    }
    let output = proctor(&["element", &fixture(SCENE), "--table", "no/such.csv"]);
    assert_eq!(output.status.code(), Some(2));
    let output = of_table(&Desk::new(), "time\n1\n", &["--test", "shear"]);
    assert_eq!(output.status.code(), Some(2));
}

/// No strength, no panic, and words that say what is there instead.
#[test]
fn fluids_go_every_path() {
    let desk = Desk::new();
    let text = fs::read_to_string(fixture(SCENE)).expect("a scene");
    let mut scene: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let fluid = |law: &str, more: serde_json::Value| {
        let mut all = serde_json::json!({
            "type": law, "id": 1, "bulk": 1e6, "viscosity": 10.0, "density": 1000.0
        });
        for (key, value) in more.as_object().expect("keys") {
            all[key] = value.clone();
        }
        all
    };
    for material in [
        fluid("newtonian", serde_json::json!({})),
        fluid("bingham", serde_json::json!({ "yield_stress": 100.0 })),
    ] {
        scene["material"] = serde_json::json!({ "fluid": material });
        if let Some(column) = scene["body"]["column"].as_object_mut() {
            column.remove("initial_stress");
        }
        let path = desk.scene("fluid.json", &scene);
        let output = proctor(&["element", &path, "--strain", "0.01"]);
        assert!(
            matches!(output.status.code(), Some(0 | 1)),
            "{}",
            stderr(&output)
        );
        let text = stdout(&output);
        assert_eq!(
            text.matches("a fluid: its shear stress").count(),
            7,
            "{text}"
        );
        assert!(
            !text.contains("strength q") && !text.contains("NaN"),
            "{text}"
        );
    }
}
