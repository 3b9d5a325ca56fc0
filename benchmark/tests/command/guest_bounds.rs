//! Bounds of other solvers, the list of open cases, and frames that are judged without running a solver.

use crate::command::guests::{errors, found, precision};
use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// Formats of an export of a record.
fn export(format: &str, record: &str) -> String {
    let output = proctor(&["export", "--format", format, record]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    stdout(&output)
}

#[test]
fn a_bound_is_held_or_told_in_every_shape_of_the_record() {
    let desk = Desk::new();
    let same = json!({ "same": env!("CARGO_BIN_EXE_proctor") });
    let config = desk.scene("guests.json", &json!({ "executables": same }));
    let record = desk.name("r.json");
    let run = |bounds: &[&str]| {
        let mut arguments = vec!["precision", "step-bar", "--quick", "--repetitions", "1"];
        arguments.extend(["--executables", &config, "--json", &record]);
        arguments.extend(bounds);
        proctor(&arguments)
    };
    // Without a bound twice the own error is accepted, which an equal program has half of.
    let output = run(&[]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}");
    assert!(
        text.contains("PASS  same/step-bar: error of the displacement, finest run: "),
        "{text}"
    );
    assert!(
        text.contains("twice the error of this program's own process"),
        "{text}"
    );
    let badge: Value = serde_json::from_str(&export("badge", &record)).expect("JSON");
    assert_eq!(badge["message"], "1 of 1 gates hold");
    assert_eq!(badge["color"], "brightgreen");
    let output = run(&["--bound", "step-bar=0.1%"]);
    assert_eq!(code(&output), 1);
    assert!(
        stdout(&output).contains("FAIL  same/step-bar"),
        "{}",
        stdout(&output)
    );
    let xml = export("junit", &record);
    assert!(
        xml.contains("<testsuite name=\"same/step-bar\" tests=\"1\" failures=\"1\""),
        "{xml}"
    );
    assert!(xml.contains("bound at most 0.001"), "{xml}");
    let summary = export("summary", &record);
    for words in [
        "### Proctor: FAIL, 0 of 1 gates hold",
        "| step-bar | same |",
        "at most 0.001",
    ] {
        assert!(summary.contains(words), "{words}: {summary}");
    }
    // The page of such a record is a page of what was measured, with the solver on its first screen and in the charts.
    let page = desk.name("page.html");
    assert_eq!(code(&proctor(&["report", &record, "--out", &page])), 0);
    let page = fs::read_to_string(page).expect("a page");
    let (first, _) = page.split_once("<main").expect("a first screen");
    assert!(
        first.contains("<strong>FAIL</strong> 0 of 1 gates hold"),
        "{first}"
    );
    assert!(
        first.contains("<h2 id=\"guests\">Other solvers</h2>"),
        "{first}"
    );
    let rows: Value =
        serde_json::from_str(&fs::read_to_string(&record).expect("a record")).expect("JSON");
    let chart = rows["details"]["studies"][0]["figures"][1].to_string();
    assert!(chart.contains("same (process)"), "error against cell size");
}

#[test]
fn a_bound_of_no_case_and_one_that_is_none_are_bad_input() {
    let desk = Desk::new();
    let config = desk.scene(
        "guests.json",
        &json!({ "executables": { "same": "proctor" } }),
    );
    for (bound, words) in [
        ("step-barr=1%", "did you mean `step-bar`?"),
        ("step-bar=0", "such as self-weight=2%"),
    ] {
        let output = proctor(&[
            "precision",
            "step-bar",
            "--executables",
            &config,
            "--bound",
            bound,
        ]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[test]
fn the_list_says_which_cases_are_open_and_what_each_needs() {
    let output = proctor(&["precision", "--guests"]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0);
    let line = |case: &str| {
        let found = text
            .lines()
            .find(|line| line.split_whitespace().next() == Some(case));
        found.unwrap_or_else(|| panic!("{case}: {text}")).to_owned()
    };
    assert!(
        line("step-bar").ends_with("2D or 3D, nodal loads"),
        "{text}"
    );
    assert!(
        line("self-weight").ends_with("2D or 3D, gravity, kinetic damping")
            && !line("boussinesq").contains("2D"),
        "{text}"
    );
    assert!(line("plastic-wave").contains("plasticity"), "{text}");
    assert!(
        text.contains("problems are open to other solvers"),
        "{text}"
    );
    // Two of them as reports: what a solver writes for the second stands in its line.
    assert!(
        line("footing").ends_with("stresses") && line("collapse").contains("2D or 3D"),
        "{text}"
    );
    assert!(
        line("sphere-on-terrain").ends_with("several bodies, STL, stresses")
            && line("vortex").ends_with("2D or 3D, several bodies"),
        "{text}"
    );
    let (_, reports) = text.split_once("\nReports: ").expect("reports");
    assert!(
        reports.contains("collapse: run-out over width; experiments of Lube et al. 2005"),
        "{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

/// A case that `verify` knows is known: its study is missing for a reason, and so are other solvers.
#[test]
fn a_case_without_a_study_or_without_other_solvers_says_why() {
    let desk = Desk::new();
    let config = desk.scene(
        "guests.json",
        &json!({ "executables": { "same": "proctor" } }),
    );
    let said = |arguments: &[&str]| {
        let output = proctor(arguments);
        assert_eq!(code(&output), 2, "{}", stdout(&output));
        assert_eq!(stdout(&output), "");
        stderr(&output)
    };
    for (case, words) in [
        (
            "plastic-wave",
            "there is no study of it: its question is to the laws",
        ),
        ("plastic-wave", "`proctor arena` with other solvers"),
        (
            "spin",
            "there is no study of it: all nodes move as prescribed",
        ),
    ] {
        let text = said(&["precision", case, "--executables", &config]);
        assert!(
            text.contains(words) && !text.contains("not known"),
            "{text}"
        );
    }
    for (case, words) in [
        (
            "yielding-column",
            "not for other solvers: its answer depends on the way",
        ),
        ("slope", "not for other solvers: its clay softens"),
        (
            "fluid",
            "not for other solvers: the scenes of other solvers have no fluids",
        ),
        (
            "angular-momentum",
            "not for other solvers: an affine transfer keeps",
        ),
    ] {
        let text = said(&["precision", "--guests", case]);
        assert!(text.contains(words), "{text}");
        assert!(
            text.contains(&format!("`proctor verify {case}` runs it")),
            "{text}"
        );
    }
    // The list has each case of `verify`, open or with its reason.
    let list = stdout(&proctor(&["precision", "--guests"]));
    let words: Vec<&str> = list.split([' ', ',', '\n']).collect();
    for case in proctor_verification::case::all() {
        let studies = case.studied().unwrap_or_default();
        let name = studies.first().map_or(case.name(), |study| study.name());
        assert!(words.contains(&name), "{name}: {list}");
    }
    assert!(
        list.contains("A second error, that of the stress"),
        "{list}"
    );
}

/// A solver of another language in a hundred and fifty lines; where Python has no numpy it says so.
#[test]
fn the_numpy_example_is_as_good_as_the_kernel_on_a_wave() {
    let desk = Desk::new();
    let script = fixture("fixtures/guests/numpy_mpm.py");
    let numpy = json!({ "numpy": { "command": ["python3", script, "{scene}", "{out}"] } });
    let (exit, text, record) = precision(&desk, "step-bar", &numpy);
    if text.contains("this solver needs numpy") || text.contains("No such file") {
        assert_eq!(exit, 1, "{text}");
        println!("left out: no numpy");
        return;
    }
    assert_eq!(exit, 0, "{text}");
    let own = errors(&record, "step-bar", "proctor", "displacement");
    let found = errors(&record, "step-bar", "numpy", "displacement");
    assert_eq!((own.len(), found.len()), (3, 3), "{text}");
    assert!(found[2] < 1.1 * own[2], "{found:?} {own:?}");
    // Its frames hold stresses.
    let own = errors(&record, "step-bar", "proctor", "stress");
    let found = errors(&record, "step-bar", "numpy", "stress");
    assert_eq!((own.len(), found.len()), (3, 3), "{text}");
    assert!(found[2] < 1.2 * own[2], "{found:?} {own:?}");
}

#[test]
fn frames_are_judged_without_running_a_solver() {
    let desk = Desk::new();
    let same = json!({ "same": env!("CARGO_BIN_EXE_proctor") });
    let (_, text, record) = precision(&desk, "step-bar", &same);
    let due = errors(&record, "step-bar", "same", "displacement");
    // What is kept: frames of each run, and beside them the exact field with the error of each particle.
    let run = found(&desk.path("kept/step-bar"), "same-against-exact.vtu");
    assert_eq!(run.len(), 3, "{text}");
    for path in &run {
        let frame = proctor_benchmark::frames::read(path).expect("a frame");
        let exact = frame.vectors("Exact displacement").expect("exact values");
        let computed = frame
            .vectors("Computed displacement")
            .expect("computed values");
        let (_, error) = &frame.arrays["Error"];
        assert!(!error.is_empty() && exact.len() == error.len());
        let distance = |i: usize| {
            let squares = (0..3).map(|axis| (exact[i][axis] - computed[i][axis]).powi(2));
            squares.sum::<f64>().sqrt()
        };
        assert!(
            error
                .iter()
                .enumerate()
                .all(|(i, error)| (error - distance(i)).abs() <= 1e-12 * distance(i))
        );
    }
    let finest = run
        .iter()
        .find(|path| path.to_string_lossy().contains("l_h_64"))
        .expect("the finest run");
    let frames = finest.with_file_name("same").display().to_string();
    for (bound, exit, word) in [("1%", 0, "PASS"), ("0.1%", 1, "FAIL")] {
        let output = proctor(&["judge", "step-bar", &frames, "--bound", bound]);
        assert_eq!(code(&output), exit, "{}", stderr(&output));
        let told = stdout(&output);
        assert!(told.starts_with(word), "{told}");
        let percent = format!("relative error {:.3} %", 100.0 * due[2]);
        assert!(told.contains(&percent), "{told} {due:?}");
    }
    for (arguments, words) in [
        (
            ["step-bar", frames.as_str(), "--run", "nope"],
            "accepted: pressed_l_h_16, pressed_l_h_32, pressed_l_h_64",
        ),
        (
            ["step-barr", frames.as_str(), "--bound", "1%"],
            "did you mean `step-bar`?",
        ),
        (
            ["step-bar", "/none", "--bound", "1%"],
            "no .vtu frame below /none",
        ),
        (
            ["hertz", frames.as_str(), "--bound", "1%"],
            "frames of particles hold none",
        ),
    ] {
        let mut all = vec!["judge"];
        all.extend(arguments);
        let output = proctor(&all);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}
