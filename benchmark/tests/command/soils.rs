//! Materials that cannot be, and stresses at the start that a material does not bear: file, line, key, what was found and what
//! is accepted, and exit code 2; what is doubtful is warned of.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use std::fs;

/// A column with keys of its material, of its body and of the scene, each on a line of its own.
fn scene(material: &str, body: &str, more: &str) -> String {
    format!(
        r#"{{
"dimension": 2, "time": 1e-4, "gravity": [0, -10],
"mesh": {{"cells_dimension": [0.5, 0.5], "cells_number": [2, 6]}},
"material": {{"ground": {{"id": 1, "density": 2000,
{material}
}}}},
"body": {{"column": {{"type": "cuboid", "id": 1, "material_id": 1, "point_p1": [0, 0], "point_p2": [1, 2]
{body}
}}}}
{more}
}}"#
    )
}

const SOLID: &str = r#""young": 1e7, "poisson": 0.3"#;

/// Keys of a material and of its body, the key that is wrong, and words of what was found and of what is accepted.
type Wrong = (
    String,
    &'static str,
    &'static str,
    &'static str,
    &'static str,
);

fn of_soil(keys: &str) -> String {
    format!(r#""type": "mohr_coulomb", {SOLID}, {keys}"#)
}

fn wrong() -> Vec<Wrong> {
    let row = |keys: String, key, found, accepted| (keys, "", key, found, accepted);
    let soft = r#""friction": 30, "cohesion": 1e4, "softening": "exponential", "softening.cohesion.active": true"#;
    let metal = format!(r#""type": "von_mises", {SOLID}, "yield_stress": 1e4"#);
    let fluid = r#""type": "newtonian", "bulk": 1e6"#;
    let drucker = format!(r#""type": "drucker_prager", {SOLID}"#);
    vec![
        row(
            of_soil(r#""friction": 90, "cohesion": 1"#),
            "friction",
            "90",
            "0 or greater and less than 90 [°]",
        ),
        row(
            of_soil(r#""friction": -5, "cohesion": 1"#),
            "friction",
            "-5",
            "0 or greater and less than 90 [°]",
        ),
        row(
            format!(r#"{drucker}, "friction": 95, "cohesion": 1"#),
            "friction",
            "95",
            "less than 90 [°]",
        ),
        row(
            of_soil(r#""friction": 30, "cohesion": 1, "dilation": 31"#),
            "dilation",
            "31",
            "up to 30 [°]",
        ),
        row(
            format!(r#"{drucker}, "friction": 30, "cohesion": 1, "dilation": 31"#),
            "dilation",
            "31",
            "up to 30 [°]",
        ),
        row(
            of_soil(r#""friction": 30, "cohesion": -1"#),
            "cohesion",
            "-1",
            "0 or greater [Pa]",
        ),
        row(
            format!(r#""type": "tresca", {SOLID}, "cohesion": -1"#),
            "cohesion",
            "-1",
            "0 or greater [Pa]",
        ),
        row(
            format!(r#"{fluid}, "viscosity": -1"#),
            "viscosity",
            "-1",
            "0 or greater [Pa s]",
        ),
        row(
            r#""type": "bingham", "bulk": 1e6, "viscosity": -2, "yield_stress": 10"#.to_owned(),
            "viscosity",
            "-2",
            "0 or greater [Pa s]",
        ),
        row(
            of_soil(&format!(
                r#"{soft}, "softening.exponential.eta": 5, "softening.cohesion.residual": 2e4"#
            )),
            "softening.cohesion.residual",
            "20000, more than the 10000 that it softens from",
            "up to 10000",
        ),
        row(
            format!(r#"{metal}, "hardening": -1.2e7"#),
            "hardening",
            "-12000000, softening that no point can bear",
            "greater than -3 G",
        ),
        row(
            format!(r#"{metal}, "hardening.curve": [[0.001, 2e4], [0.0015, 1e4]]"#),
            "hardening.curve",
            "softening that no point can bear",
            "greater than -3 G",
        ),
        row(
            format!(r#"{metal}, "hardening.curve": [[0.002, 2e4], [0.001, 3e4]]"#),
            "hardening.curve",
            "a plastic strain of 0.001 in row 1",
            "greater than 0.002",
        ),
        row(
            of_soil(&format!(
                r#"{soft}, "softening.exponential.eta": 1e6, "softening.cohesion.residual": 0"#
            )),
            "softening.cohesion.residual",
            "which no point can bear",
            "Pa per plastic strain",
        ),
        // In these cells: the largest is named.
        row(
            of_soil(&format!(
                r#"{soft}, "softening.exponential.eta": 900, "softening.cohesion.residual": 0,
"regularisation": "crack_band", "regularisation.width": 0.05"#
            )),
            "regularisation.width",
            "in cells of 0.5 m, which no point can bear",
            "cells of less than",
        ),
        (
            format!(r#""type": "tresca", {SOLID}, "cohesion": 4000"#),
            r#", "initial_stress": {"type": "at_rest", "ratio": 0.5, "level": 2}"#,
            "initial_stress",
            "Pa beyond the yield surface of ground",
            "a stress that the material bears",
        ),
        (
            format!(r#""type": "neo_hookean", {SOLID}"#),
            r#", "initial_stress": {"type": "isotropic", "value": -1e4}"#,
            "initial_stress",
            "a stress at the start of a neo_hookean material",
            "no `initial_stress`, or another material",
        ),
    ]
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    let desk = Desk::new();
    let path = desk.path("scene.json");
    let file = path.to_str().expect("a path");
    for (material, body, key, found, accepted) in wrong() {
        let text = scene(&material, body, "");
        fs::write(&path, &text).expect("written");
        let output = desk.run(file, "out", &[]);
        let said = stderr(&output);
        assert_eq!(code(&output), 2, "{material}: {said}");
        // A residual that is not given is the value that is wrong, and not told beside it.
        let told = said.contains("softening.");
        assert!(!told || key.starts_with("softening."), "{material}: {said}");
        let of_key = |line: &&str| line.contains(&format!("{key}: found")) && line.contains(found);
        let problem = said
            .lines()
            .find(|line| of_key(line) || key == "initial_stress" && line.contains(found));
        let problem = problem.unwrap_or_else(|| panic!("{material}: {said}"));
        let line = text
            .lines()
            .position(|line| line.contains(&format!("\"{key}\"")));
        let place = format!("scene.json:{}:", line.expect("the key is there") + 1);
        for words in [place.as_str(), key, accepted] {
            assert!(problem.contains(words), "{words} is not in: {problem}");
        }
    }
}

/// The excess and its place: at the foot of the column, under 2 m of 20 kPa each.
#[test]
fn a_stress_that_is_not_borne_is_told_with_its_depth() {
    let desk = Desk::new();
    let path = desk.path("scene.json");
    let (material, body, ..) = wrong().swap_remove(15);
    fs::write(&path, scene(&material, body, "")).expect("written");
    let file = path.to_str().expect("a path");
    let said = stderr(&desk.run(file, "out", &[]));
    // The lowest particles are at 0.125 m: 37.5 kPa against 18.75 kPa, where 8 kPa are borne.
    assert!(
        said.contains("0.125) m") && said.contains("-37500"),
        "{said}"
    );
}

#[test]
fn degrees_that_look_like_radians_are_warned_of() {
    let desk = Desk::new();
    let path = desk.path("scene.json");
    fs::write(
        &path,
        scene(&of_soil(r#""friction": 0.5236, "cohesion": 1"#), "", ""),
    )
    .expect("written");
    let output = proctor(&["plan", path.to_str().expect("a path")]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let said = stdout(&output) + &stderr(&output);
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("a friction of 0.5236 degrees looks like radians"),
        "{said}"
    );
}
