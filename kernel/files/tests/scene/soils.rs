//! Materials that yield: their keys, what they are where a scene does not say, and what does not go together.

use crate::scene::written::back;
use proctor_files::json::from_json;
use proctor_laws::{
    AnyLaw, ConeMatch, DruckerPrager, LinearElastic, MohrCoulomb, ObjectiveRate, Residual,
    Softening, Tresca, VonMises,
};
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::plan;
use proctor_scene::{Scene, SceneError};
use std::path::Path;

const YOUNG: f64 = 1e7;
const POISSON: f64 = 0.3;

/// A block of a material with these keys beside those of every material.
fn read(keys: &str) -> Result<Scene, SceneError> {
    let text = format!(
        r#"{{"time": 1, "mesh": {{"cells_dimension": [1, 1, 1], "cells_number": [1, 1, 1]}},
        "material": [{{"id": 0, "young": 1e7, "poisson": 0.3, "density": 2000, {keys}}}],
        "body": [{{"type": "cuboid", "id": 1, "material_id": 0, "point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}}]}}"#
    );
    from_json(&text, "soil.json", Path::new("."))
}

fn cases() -> Vec<(&'static str, AnyLaw)> {
    let soil = MohrCoulomb::new(YOUNG, POISSON, [30.0, 2e3, 0.0]);
    vec![
        (
            r#""type": "von_mises", "yield_stress": 1e5"#,
            VonMises::new(YOUNG, POISSON, 1e5, 0.0).into(),
        ),
        (
            r#""type": "von-mises", "yield_stress": 1e5, "hardening": -1e5, "hardening.saturation": 2e4, "hardening.rate": 30, "relaxation_time": 0.01"#,
            VonMises::new(YOUNG, POISSON, 1e5, -1e5)
                .saturating(2e4, 30.0)
                .relaxing(0.01)
                .into(),
        ),
        (
            r#""type": "von_mises", "yield_stress": 1e5, "hardening": 1e4, "hardening.curve": [[0.01, 1.2e5], [0.05, 1.1e5]]"#,
            VonMises::new(YOUNG, POISSON, 1e5, 1e4)
                .along(&[[0.01, 1.2e5], [0.05, 1.1e5]])
                .into(),
        ),
        (
            r#""type": "tresca", "cohesion": 3e4, "tensile": 1e4"#,
            Tresca::new(YOUNG, POISSON, 3e4).with_tensile(1e4).into(),
        ),
        (
            r#""type": "mohr-coulomb", "friction": 30, "cohesion": 2000"#,
            soil.into(),
        ),
        (
            r#""type": "mohr_coulomb", "friction": 30, "cohesion": 2000, "dilation": 10, "dilation.until": 0.02, "tensile": 500"#,
            MohrCoulomb::new(YOUNG, POISSON, [30.0, 2e3, 10.0])
                .with_tensile(500.0)
                .dilating_until(0.02)
                .into(),
        ),
        // As another solver writes it.
        (
            r#""type": "mohr-coulomb", "friction": 30, "cohesion": 2000, "softening": "exponential",
            "softening.exponential.eta": 12.5, "softening.friction.active": true, "softening.friction.residual": 20,
            "softening.cohesion.active": true, "softening.cohesion.residual": 0, "softening.tensile.active": false"#,
            soil.softening(
                Softening::Exponential { eta: 12.5 },
                Residual {
                    friction: Some(20.0),
                    cohesion: Some(0.0),
                    ..Residual::default()
                },
            )
            .into(),
        ),
        // A strength that is said to soften, to what is not said, stays what it is.
        (
            r#""type": "mohr_coulomb", "friction": 30, "cohesion": 2000, "softening": "linear", "softening.linear.to": 0.1,
            "softening.cohesion.active": "true""#,
            soil.softening(
                Softening::Linear { from: 0.0, to: 0.1 },
                Residual {
                    cohesion: Some(2e3),
                    ..Residual::default()
                },
            )
            .into(),
        ),
        (
            r#""type": "drucker_prager", "friction": 30, "cohesion": 2000, "dilation": 5, "match": "outer""#,
            DruckerPrager::new(YOUNG, POISSON, [30.0, 2e3, 5.0], ConeMatch::Outer).into(),
        ),
        (
            r#""type": "elastic", "objective_rate": "jaumann""#,
            LinearElastic::with_rate(YOUNG, POISSON, ObjectiveRate::JaumannForward).into(),
        ),
    ]
}

#[test]
fn materials_are_read_and_written_back() {
    for (keys, law) in cases() {
        let scene = read(keys).unwrap_or_else(|error| panic!("{keys}: {error}"));
        assert_eq!(scene.materials[0].law, law, "{keys}");
        assert_eq!(back(&scene).materials[0].law, law, "{keys}");
    }
}

#[test]
fn what_does_not_go_together_has_its_place() {
    for (keys, path, found) in [
        (r#""friction": 90, "cohesion": 1"#, "friction", "90"),
        (r#""friction": -1, "cohesion": 1"#, "friction", "-1"),
        (r#""friction": 30, "cohesion": -1"#, "cohesion", "-1"),
        (r#""friction": 30"#, "cohesion", "nothing"),
        (
            r#""friction": 0, "cohesion": 0"#,
            "cohesion",
            "no strength at all",
        ),
        (
            r#""friction": 30, "cohesion": 1, "dilation": 31"#,
            "dilation",
            "31, more than the friction of 30",
        ),
        (
            r#""friction": 45, "cohesion": 1, "tensile": 1.01"#,
            "tensile",
            "1.01, more than friction and cohesion admit",
        ),
        (
            r#""friction": 30, "cohesion": 1, "relaxation_time": -1"#,
            "relaxation_time",
            "-1",
        ),
        (
            r#""friction": 30, "cohesion": 1, "softening": "exponential", "softening.exponential.eta": 5,
            "softening.cohesion.active": true, "softening.cohesion.residual": 2"#,
            "softening.cohesion.residual",
            "2, more than the 1 that it softens from",
        ),
        (
            r#""friction": 30, "cohesion": 1, "softening": "exponential", "softening.cohesion.active": true"#,
            "softening.exponential.eta",
            "0, with which nothing softens",
        ),
        (
            r#""friction": 30, "cohesion": 1, "softening": "linear", "softening.linear.from": 0.2, "softening.linear.to": 0.1"#,
            "softening.linear.to",
            "0.1, not beyond",
        ),
        (
            r#""friction": 30, "cohesion": 1, "softening.cohesion.active": true"#,
            "softening",
            "none, and an active",
        ),
        (
            r#""friction": 30, "cohesion": 1, "softening": "sudden""#,
            "softening",
            "sudden",
        ),
        (
            r#""friction": 30, "cohesion": 1, "yield_stress": 1"#,
            "yield_stress",
            "of the material type mohr_coulomb",
        ),
        (
            r#""friction": 30, "cohesion": 1, "match": "inner""#,
            "match",
            "mohr_coulomb material",
        ),
        (
            r#""friction": 30, "cohesion": 1, "hardening.curve": [[0.01, 2]]"#,
            "hardening.curve",
            "of the material type mohr_coulomb",
        ),
    ] {
        let error = read(&format!(r#""type": "mohr_coulomb", {keys}"#)).expect_err(keys);
        let problem = (error.problems.iter()).find(|p| p.path == format!("material[0].{path}"));
        let problem = problem.unwrap_or_else(|| panic!("{keys}: {error}"));
        assert!(problem.found.contains(found), "{keys}: {problem}");
        assert!(
            !problem.accepted.is_empty() && problem.location.is_some(),
            "{problem}"
        );
    }
    for (rows, found) in [
        ("[[0.1, 2], [0.1, 3]]", "row 1, not beyond 0.1"),
        ("[[0.1, -2]]", "a yield stress of -2 in row 0"),
        ("[[1e-7, 3], [2e-7, 1]]", "softening that no point can bear"),
    ] {
        let keys = format!(r#""type": "von_mises", "yield_stress": 1, "hardening.curve": {rows}"#);
        let error = read(&keys).expect_err(rows);
        let [problem] = &error.problems[..] else {
            panic!("{rows}: {error}")
        };
        assert_eq!(problem.path, "material[0].hardening.curve");
        assert!(problem.found.contains(found), "{rows}: {problem}");
        assert!(problem.location.is_some(), "{problem}");
    }
    let error = read(r#""type": "von_mises", "yield_stress": 1, "hardening": -1.2e7"#)
        .expect_err("softening that is too steep");
    assert_eq!(error.problems.len(), 1, "{error}");
    assert!(error.problems[0].accepted.contains("-3 G"), "{error}");
}

/// A doubtful soil runs with a warning. Over no strain the strength would fall infinitely fast: that follows from the marks,
/// and is not said beside them.
#[test]
fn softening_over_no_strain_is_refused_for_its_marks_alone() {
    let keys = r#""type": "mohr_coulomb", "friction": 30, "cohesion": 1000, "softening": "linear",
        "softening.cohesion.active": true, "softening.cohesion.residual": 100, "regularisation": "crack_band",
        "regularisation.width": 0.1"#;
    let error = read(keys).expect_err("is bad input");
    let paths: Vec<&str> = error.problems.iter().map(|p| p.path.as_str()).collect();
    assert!(
        matches!(&paths[..], [only] if only.ends_with("softening.linear.to")),
        "{error}"
    );
}

#[test]
fn what_is_doubtful_is_warned_of() {
    for (keys, words) in [
        (
            r#""type": "mohr_coulomb", "friction": 0.5, "cohesion": 1"#,
            "looks like radians",
        ),
        (
            r#""type": "mohr_coulomb", "friction": 30, "dilation": -2, "cohesion": 1"#,
            "shrinks",
        ),
        (
            r#""type": "mohr_coulomb", "friction": 30, "cohesion": 1, "softening": "exponential",
            "softening.exponential.eta": 5, "softening.cohesion.active": true, "softening.cohesion.residual": 0"#,
            "proportional to the cell size",
        ),
        (
            r#""type": "von_mises", "yield_stress": 1, "hardening": -1"#,
            "proportional to the cell size",
        ),
        (
            r#""type": "von_mises", "yield_stress": 1, "hardening.curve": [[0.1, 0.9], [0.2, 1]]"#,
            "proportional to the cell size",
        ),
        (
            r#""type": "drucker_prager", "friction": 0.5, "cohesion": 1"#,
            "looks like radians",
        ),
    ] {
        let scene = read(keys).unwrap_or_else(|error| panic!("{keys}: {error}"));
        let warnings = plan(&scene, PlanOptions::default()).warnings;
        assert!(
            warnings.iter().any(|warning| warning.contains(words)),
            "{keys}: {warnings:?}"
        );
    }
}
