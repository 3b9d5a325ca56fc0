//! `proctor element`: materials on the paths of the laboratory.

use crate::support::{Desk, fixture, proctor, stderr, stdout};
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
