//! `proctor verify mill`.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};

/// A problem that misses a gate: linear functions under a stress of the size of the stiffness.
fn hats() -> Value {
    let text = std::fs::read_to_string(fixture("fixtures/mill/hats-under-stress.json"));
    serde_json::from_str(&text.expect("a problem")).expect("JSON")
}

/// A problem in a file, with something changed.
fn changed(desk: &Desk, pointer: &str, value: Value) -> String {
    let mut problem = hats();
    let (parent, key) = pointer.rsplit_once('/').expect("a key");
    problem.pointer_mut(parent).expect("an object")[key] = value;
    desk.scene("problem.json", &problem)
}

#[test]
fn a_few_problems_are_judged_and_counted() {
    let desk = Desk::new();
    let (result, folder) = (desk.name("result.json"), desk.name("misses"));
    let run = |threads: &str| {
        proctor(&[
            "verify",
            "mill",
            "--count",
            "4",
            "--seed",
            "5",
            "--threads",
            threads,
            "--json",
            &result,
            "--out",
            &folder,
        ])
    };
    let output = run("1");
    let text = std::fs::read_to_string(&result).expect("a result");
    let result: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(result["asked"], 4);
    let problems = result["problems"].as_array().expect("problems");
    assert_eq!(problems.len(), 4);
    let methods = result["methods"].as_array().expect("methods");
    let total: u64 = methods.iter().filter_map(|m| m["problems"].as_u64()).sum();
    assert_eq!(total, 4);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    for method in methods {
        let name = method["method"].as_str().expect("a name");
        assert!(stdout(&output).contains(name), "{name}");
    }
    // All but the time is the same with other threads.
    let told = |text: String| {
        text.lines()
            .filter(|line| !line.contains("PASS"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(told(stdout(&output)), told(stdout(&run("2"))));
}

/// A run that begins at a number judges the same problems as one that comes to it.
#[test]
fn a_run_begins_at_a_number() {
    let desk = Desk::new();
    let problems = |first: &str, count: &str| {
        let (result, folder) = (desk.name("result.json"), desk.name("problems"));
        let mut words = vec!["verify", "mill", "--seed", "5", "--keep"];
        words.extend(["--first", first, "--count", count]);
        words.extend(["--json", &result, "--out", &folder]);
        let output = proctor(&words);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let text = std::fs::read_to_string(&result).expect("a result");
        let result: Value = serde_json::from_str(&text).expect("JSON");
        result["problems"].as_array().expect("problems").clone()
    };
    let (all, last) = (problems("0", "3"), problems("2", "1"));
    assert_eq!(last.len(), 1);
    assert_eq!(last[0]["number"], 2);
    assert_eq!(last[0], all[2]);
    // The file of a problem that holds, which holds again.
    let file = last[0]["problem"].as_str().expect("a file");
    let again = proctor(&["verify", "mill", "--problem", file]);
    assert_eq!(code(&again), 0, "{}{}", stdout(&again), stderr(&again));
}

/// A file may ask for other particles and a shorter step than those that are drawn, and says so when it is written again.
#[test]
fn particles_and_step_of_a_file_are_taken() {
    let desk = Desk::new();
    let mut problem = hats();
    problem["method"]["particles_per_cell"] = json!(3);
    problem["method"]["share_of_step"] = json!(0.3);
    let given = desk.scene("given.json", &problem);
    let (result, folder) = (desk.name("result.json"), desk.name("misses"));
    let output = proctor(&[
        "verify",
        "mill",
        "--problem",
        &given,
        "--json",
        &result,
        "--out",
        &folder,
    ]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let line = stdout(&output);
    let (_, written) = line.split_once("--problem ").expect("a file");
    let written = written.lines().next().expect("a path");
    let text = std::fs::read_to_string(written).expect("a file");
    assert_eq!(serde_json::from_str::<Value>(&text).expect("JSON"), problem);
    let usual = desk.scene("usual.json", &hats());
    let usual_result = desk.name("usual-result.json");
    proctor(&[
        "verify",
        "mill",
        "--problem",
        &usual,
        "--json",
        &usual_result,
        "--out",
        &folder,
    ]);
    let errors = |path: &str| {
        let text = std::fs::read_to_string(path).expect("a result");
        let result: Value = serde_json::from_str(&text).expect("JSON");
        result["problems"][0]["errors"].clone()
    };
    assert_ne!(errors(&result), errors(&usual_result));
}

/// A problem that misses a gate is written, and its file gives the same miss.
#[test]
fn a_miss_is_a_file_that_is_run_again() {
    let desk = Desk::new();
    let folder = desk.name("misses");
    let given = desk.scene("given.json", &hats());
    let first = proctor(&["verify", "mill", "--problem", &given, "--out", &folder]);
    assert_eq!(code(&first), 1, "{}", stderr(&first));
    let line = stdout(&first)
        .lines()
        .find(|line| line.starts_with('✗'))
        .map(str::to_owned);
    let line = line.expect("a miss");
    assert!(line.contains("order of L2(u)"), "{line}");
    let (_, written) = line.split_once("--problem ").expect("a file");
    let text = std::fs::read_to_string(written).expect("a file");
    assert_eq!(serde_json::from_str::<Value>(&text).expect("JSON"), hats());
    let again = proctor(&["verify", "mill", "--problem", written, "--out", &folder]);
    assert!(stdout(&again).contains(&line), "{}", stdout(&again));
}

/// The same problem with domains that follow the deformation keeps all gates.
#[test]
fn a_problem_of_a_file_may_hold() {
    let desk = Desk::new();
    let given = changed(&desk, "/method/weighting", json!("cpGIMP-V"));
    let output = proctor(&["verify", "mill", "--problem", &given, "--quiet"]);
    assert_eq!(code(&output), 0, "{}", stdout(&output));
}

#[test]
fn what_is_no_problem_is_refused_with_the_key() {
    let desk = Desk::new();
    for (pointer, value, said) in [
        ("/axes", json!(4), "`axes`"),
        ("/ladder", json!([8]), "`ladder`"),
        ("/ladder", json!([12, 24]), "multiples of 8"),
        ("/ladder", json!([16, 8]), "rising"),
        ("/family", json!("triangle"), "box, floating, frame, affine"),
        ("/material/law", json!("jelly"), "von_mises"),
        ("/material/viscosity", json!(-1.0), "not negative [Pa s]"),
        ("/friction", json!(-0.5), "not negative"),
        ("/material/young", json!(-1.0), "a positive number [Pa]"),
        ("/material/poisson", json!(0.5), "0 to 0.49"),
        ("/method/weighting", json!("hats"), "cpGIMP"),
        ("/method/scheme", json!(3), "`method.scheme`"),
        ("/method/particles_per_cell", json!(9), "accepted: 1 to 8"),
        ("/method/share_of_step", json!(1.5), "above 0, up to 1"),
        ("/motion/bubble", json!(1), "a power from 2 to 16"),
        ("/motion/polynomials", json!([]), "2 axes"),
        (
            "/motion/stretch",
            json!([[-1e3, 0.0, 0.0], [0.0, -1e3, 0.0], [0.0, 0.0, 0.0]]),
            "stretches",
        ),
        ("/motion/axis", json!([0.0, 0.0, 2.0]), "unit vector"),
        ("/motion/drift", json!([0.0, 0.0, 2.0]), "across the plane"),
        ("/end", json!(0.0), "a positive number [s]"),
    ] {
        let given = changed(&desk, pointer, value);
        let output = proctor(&["verify", "mill", "--problem", &given]);
        assert_eq!(code(&output), 2, "{pointer}: {}", stdout(&output));
        assert!(
            stderr(&output).contains(said),
            "{pointer}: {}",
            stderr(&output)
        );
    }
}

/// A page shows each order of a result once and names the problems that missed. A file that is no result is refused.
#[test]
fn orders_stand_on_a_page() {
    let desk = Desk::new();
    let order = |value: f64| json!({ "what": "order of L2(u)", "value": value, "bound": 1.5, "least": true, "holds": value >= 1.5 });
    let problem = |number: u64, value: f64| json!({ "number": number, "family": "cut", "law": "elastic", "method": "uGIMP USL FLIP", "gates": [order(value)] });
    let problems = [
        problem(0, 2.03),
        problem(1, 0.4),
        json!({ "number": 2, "refused": [] }),
    ];
    let result = json!({ "seed": 3, "misses": 1, "refused": 5, "problems": problems });
    let result = desk.scene("mill.json", &result);
    let record = fixture("fixtures/expected/errors.json");
    let page = desk.name("page.html");
    let made = proctor(&["report", &record, "--mill", &result, "--out", &page]);
    assert_eq!(code(&made), 0, "{}", stderr(&made));
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("Seed 3: 2 manufactured problems, of which 1 miss a gate; 5 draws"));
    assert!(html.contains("2 problems, least 0.40, median 2.03; theory expects 2."));
    assert!(html.contains("order of L2(u) 4.00e-1, bound 1.50e0"));
    let wrong = proctor(&["report", &record, "--mill", &record, "--out", &page]);
    assert_eq!(code(&wrong), 2);
    assert!(stderr(&wrong).contains("proctor verify mill --json FILE"));
}

#[test]
fn the_mill_and_cases_do_not_mix() {
    for arguments in [
        &["verify", "mill", "bar"][..],
        &["verify", "mill", "--quick"],
        &["verify", "mill", "--list"],
        &["verify", "mill", "--count", "0"],
        &["verify", "mill", "--generated", "3"],
        &[
            "verify",
            "mill",
            "--count",
            "3",
            "--problem",
            "problem.json",
        ],
        &[
            "verify",
            "mill",
            "--first",
            "3",
            "--problem",
            "problem.json",
        ],
        &["verify", "bar", "--count", "3"],
        &["verify", "bar", "--first", "3"],
        &["verify", "bar", "--keep"],
        &["verify", "--count", "3"],
        &["verify", "--problem", "problem.json"],
        &["verify", "mill", "--problem", "nowhere.json"],
    ] {
        assert_eq!(code(&proctor(arguments)), 2, "{arguments:?}");
    }
}
