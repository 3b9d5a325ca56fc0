//! `proctor refine`, and `proctor verify refine` that judges its bars.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};

#[test]
fn the_rule_keeps_its_bounds_on_the_kept_ladders() {
    let ladders = fixture("fixtures/expected/full.json");
    let output = proctor(&["verify", "refine", "--ladders", &ladders]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    for word in ["held out", "by case", "PASS: 0 of 9 gates miss"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
}

/// A refined scene of the fixtures.
fn refine(scene: &str, more: &[&str]) -> std::process::Output {
    let scene = fixture(&format!("fixtures/refine/{scene}.json"));
    proctor(&[&["refine", scene.as_str()], more].concat())
}

#[test]
fn values_that_settle_have_bars_in_a_table_of_eighty_columns() {
    let output = refine("beam_apic", &["--finer", "1"]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    for word in ["h = 0.2, 0.1, 0.05 m", "± 95 %", "✓ tip_uy", "asymptotic"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert!(!text.contains('✗'), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn a_scene_whose_energies_do_not_settle_has_no_bar() {
    let output = refine("beam_musl", &["--finer", "1"]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}");
    assert!(
        text.contains("no bar is claimed (try --until 0.45)"),
        "{text}"
    );
    assert!(text.contains("✗ tip_uy") && !text.contains('✓'), "{text}");
    // Up to there it does.
    let output = refine("beam_musl", &["--finer", "1", "--until", "0.45"]);
    let text = stdout(&output);
    assert!(
        text.contains("at 0.45 s") && text.contains("! tip_uy"),
        "{text}"
    );
    assert!(!text.contains("no bar is claimed"), "{text}");
}

#[test]
fn the_place_of_the_mesh_is_looked_at_where_bodies_touch() {
    let output = refine("discs", &["--finer", "1"]);
    let text = stdout(&output);
    assert!(text.contains("mesh moved along x and y"), "{text}");
    assert!(text.contains("scene does not settle"), "{text}");
    let output = refine(
        "discs",
        &["--finer", "1", "--offsets", "0", "--until", "0.1"],
    );
    assert!(!stdout(&output).contains("moved"), "{}", stdout(&output));
    assert!(
        stderr(&output).contains("--offsets 3"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_record_holds_runs_bars_and_curves() {
    let desk = Desk::new();
    let (json, folder) = (desk.name("bars.json"), desk.name("bars"));
    let more = ["--finer", "1", "--json", &json, "--svg", &folder];
    let output = refine("beam_apic", &more);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = std::fs::read_to_string(&json).expect("a record");
    let record: Value = serde_json::from_str(&text).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows");
    let named = |name: &str| rows.iter().find(|row| row["name"] == name);
    let run = named("refine/beam_apic/h=0.1").expect("a run");
    assert!(
        run["value_tip_uy"].is_f64() && run["cell_size"] == 0.1,
        "{run}"
    );
    let bar = named("refine/beam_apic/tip_uy_bar").expect("a bar");
    for key in ["value", "uncertainty", "observed_order", "extrapolated"] {
        assert!(bar[format!("{key}_tip_uy")].is_f64(), "{key}: {bar}");
    }
    assert_eq!(bar["verdict"], "asymptotic");
    let curves = &record["details"]["refined"][0]["curves"];
    assert!(
        curves.as_array().is_some_and(|curves| curves.len() > 5),
        "{curves}"
    );
    let picture = std::fs::read_to_string(desk.path("bars/beam_apic-tip_uy-meshes.svg"));
    assert!(picture.expect("a picture").contains("extrapolated"));
    // The page shows it, and compared with itself nothing moved.
    let page = desk.name("page.html");
    assert_eq!(code(&proctor(&["report", &json, "--out", &page])), 0);
    let page = std::fs::read_to_string(page).expect("a page");
    assert!(page.contains("Error bars of scenes"));
    let same = proctor(&["compare", &json, &json]);
    assert_eq!(code(&same), 0, "{}{}", stdout(&same), stderr(&same));
    // A value that moved is given in bars; a bar that is wider, and a verdict that is lost, are worse.
    let moved = bar["value_tip_uy"].as_f64().expect("a value") + 1e-4;
    for (from, to, told) in [
        ("value_tip_uy", json!(moved), "of the bar"),
        ("uncertainty_tip_uy", json!(1.0), "uncertainty_tip_uy"),
        ("verdict", json!("swings"), "verdict asymptotic -> swings"),
    ] {
        let mut head = record.clone();
        let rows = head["benchmarks"].as_array_mut().expect("rows");
        let row = rows
            .iter_mut()
            .find(|row| row["name"] == "refine/beam_apic/tip_uy_bar");
        row.expect("a bar")[from] = to;
        let head = desk.scene("head.json", &head);
        let output = proctor(&["compare", &json, &head]);
        assert_eq!(code(&output), 1, "{}", stdout(&output));
        let text = stdout(&output);
        let words: Vec<&str> = text.split_whitespace().collect();
        assert!(words.join(" ").contains(told), "{told}: {text}");
    }
}

#[test]
fn the_width_of_bars_decides_where_it_is_asked_for() {
    let quantity = "t=tip_uy@end";
    for (within, expected) in [("5%", 0), ("0.01%", 1)] {
        let more = ["--finer", "1", "--quantity", quantity, "--within", within];
        let output = refine("beam_apic", &more);
        assert_eq!(code(&output), expected, "{}", stdout(&output));
        assert!(
            stdout(&output).contains("of the change"),
            "{}",
            stdout(&output)
        );
    }
    let more = ["--finer", "1", "--quantity", "t=tap_uy@end"];
    let output = refine("beam_apic", &more);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("tip_uy"), "{}", stderr(&output));
}

#[test]
fn fields_are_compared_between_meshes_and_no_bar_is_claimed_for_stress() {
    let more = [
        "--finer",
        "1",
        "--field",
        "displacement",
        "--field",
        "stress",
    ];
    let output = refine("beam_apic", &more);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    assert!(text.contains("✓ rms displacement"), "{text}");
    assert!(text.contains("✗ rms stress"), "{text}");
    assert_eq!(code(&refine("beam_apic", &["--field", "colour"])), 2);
}

#[test]
fn methods_have_one_limit_and_the_cheapest_is_named() {
    let methods = ["uGIMP-USL-FLIP", "cpGIMP-MUSL-APIC"];
    let more = ["--finer", "1", "--methods", &methods.join(",")];
    let output = refine("swing", &more);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    for word in [
        "cheapest for an error of 1 %",
        "all bars overlap",
        methods[0],
        methods[1],
    ] {
        assert!(text.contains(word), "{word}: {text}");
    }
    for (names, told) in [
        ("uGIMP-USL-FLIP", "found 1 methods"),
        ("uGIMP-USL-FLIP,FEM", "\"FEM\""),
    ] {
        let output = refine("swing", &["--finer", "1", "--methods", names]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(told), "{}", stderr(&output));
    }
}

#[test]
fn what_cannot_be_refined_is_refused_with_what_fits() {
    let scene: Value = serde_json::from_str(
        &std::fs::read_to_string(fixture("fixtures/refine/swing.json")).expect("a scene"),
    )
    .expect("JSON");
    let desk = Desk::new();
    let told = |scene: &Value, more: &[&str]| {
        let scene = desk.scene("scene.json", scene);
        let output = proctor(&[&["refine", scene.as_str()], more].concat());
        assert_eq!(code(&output), 2, "{}", stdout(&output));
        stderr(&output)
    };
    // 10 cells along x are 2.5 of four times the size.
    let text = told(&scene, &[]);
    for word in [
        "scene.json:",
        "cells_number",
        "8 or 12 cells along x",
        "--finer 1",
    ] {
        assert!(text.contains(word), "{word}: {text}");
    }
    let mut thin = scene.clone();
    thin["body"]["column"]["point_p2"] = json!([0.3, 2]);
    let text = told(&thin, &["--finer", "1"]);
    for word in ["scene.json:", "cells across it", "--finer 2"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    let text = told(&scene, &["--finer", "1", "--until", "9"]);
    assert!(text.contains("--until: found 9 s"), "{text}");
    let mut soft = scene.clone();
    soft["material"]["soil"] = json!({
        "type": "mohr_coulomb", "id": 1, "density": 2000, "young": 1e6, "poisson": 0.3,
        "friction": 30, "cohesion": 1e4, "dilation": 0, "softening": "exponential",
        "softening.cohesion.active": true, "softening.exponential.eta": 5,
        "softening.cohesion.residual": 0
    });
    let text = told(&soft, &["--finer", "1"]);
    assert!(
        text.contains("crack_band") || text.contains("accepted"),
        "{text}"
    );
    let mut listed = scene;
    listed["body"]["column"] = json!({
        "type": "particles", "id": 1, "material_id": 1,
        "particles": [[0.25, 0.25, 0.25], [0.75, 0.25, 0.25]]
    });
    let text = told(&listed, &["--finer", "1"]);
    assert!(
        text.contains("body.column: found a body from a list of particles")
            && text.contains("accepted: bodies with a shape"),
        "{text}"
    );
}

#[test]
fn a_record_without_ladders_is_refused() {
    let desk = Desk::new();
    let missing = desk.name("none.json");
    let output = proctor(&["verify", "refine", "--ladders", &missing]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("--ladders FILE"),
        "{}",
        stderr(&output)
    );
    let output = proctor(&["verify", "--ladders", &missing]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("without `refine`"),
        "{}",
        stderr(&output)
    );
}
