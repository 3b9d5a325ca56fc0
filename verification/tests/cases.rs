//! The cases, quick: gates hold, every gate reacts to the number that it names and to no other, and a wrong reference breaks its
//! gates. The short ladder of a case is run once for all of these tests.

mod facts;
mod ironing;
mod peers;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, OnceLock};

use proctor_scene::simulation::Options;
use proctor_verification::case::{
    Case, Gate, Quantity, Relation, Rung, RungResult, Size, Verdict, all, find,
};
use proctor_verification::check::{self, Runs, failing};

/// One thread.
fn one_thread() -> Options {
    Options {
        threads: Some(1),
        ..Options::default()
    }
}

/// The short ladders of a case, with the correct reference and with the wrong ones, run once.
fn ladders(case: &Case) -> &'static [Runs] {
    static RUNS: LazyLock<Vec<OnceLock<Vec<Runs>>>> =
        LazyLock::new(|| all().iter().map(|_| OnceLock::new()).collect());
    let place = all().iter().position(|other| other.name() == case.name());
    let place = place.unwrap_or_else(|| panic!("no case {}", case.name()));
    RUNS[place].get_or_init(|| {
        check::ladders(case, &one_thread()).unwrap_or_else(|error| panic!("{error}"))
    })
}

/// The short ladder of a case, run once.
fn quick(case: &Case) -> &'static [(Rung, RungResult)] {
    &ladders(case)[0]
}

/// Cases whose short ladder takes more than five seconds in a release.
const LONG: [&str; 7] = [
    "incompressible-box",
    "sphere-on-terrain",
    "hertz-slab",
    "rolling-disk-slab",
    "tilted-incline",
    "clay-footing",
    "drawdown",
];

/// Every gate holds, has its reason and reacts to the number that it names, and every wrong reference breaks its gates; on as many
/// threads as there are, and with all faults of all cases at once.
#[test]
fn no_case_has_a_fault() {
    let found = faults_of(|case| !LONG.contains(&case.name()));
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
#[ignore = "takes 60 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn no_case_has_a_fault_in_a_long_ladder() {
    assert!(LONG.iter().all(|name| find(name).is_some()));
    let found = faults_of(|case| LONG.contains(&case.name()));
    assert!(found.is_empty(), "{found:#?}");
}

/// Faults of some of the cases.
fn faults_of(asked: impl Fn(&Case) -> bool) -> Vec<String> {
    let cases: Vec<_> = all().iter().filter(|case| asked(case)).collect();
    let (next, found) = (AtomicUsize::new(0), Mutex::new(vec![]));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let check = |case: &Case| {
        let faults = check::faults(case, ladders(case), &check::shown(case));
        let faults = faults
            .into_iter()
            .map(|fault| format!("{}: {fault}", case.name()));
        found.lock().expect("no thread panics here").extend(faults);
    };
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    check(case);
                }
            });
        }
    });
    found.into_inner().expect("no thread panics here")
}

#[test]
fn an_error_that_is_not_that_of_its_value_is_a_fault() {
    let case = find("radial-vibration").expect("there is one");
    let mut ladders = ladders(case).to_vec();
    let (_, run) = ladders[0].last_mut().expect("a rung");
    let of_exact =
        |q: &&mut Quantity| q.error.is_some() && q.exact.is_some_and(|exact| exact != 0.0);
    let q = run.quantities.iter_mut().find(of_exact);
    let q = q.expect("a number with an exact value");
    let name = q.name;
    q.error = q.error.map(|error| 0.999 * error);
    let faults = check::faults(case, &ladders, &check::shown(case));
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert!(
        faults[0].contains(&format!("{name}: the error")),
        "{faults:?}"
    );
}

/// Cases whose reference is the run of another one.
const WITHOUT_WRONG: [&str; 2] = ["hertz-slab", "rolling-disk-slab"];

#[test]
fn every_case_has_a_wrong_reference() {
    let without = all().iter().filter(|case| case.wrong().is_empty());
    let without: Vec<_> = without.map(|case| case.name()).collect();
    assert_eq!(without, WITHOUT_WRONG);
}

#[test]
fn cases_have_distinct_names_and_are_found_by_them() {
    for case in all() {
        assert_eq!(find(case.name()).map(Case::name), Some(case.name()));
        assert!(!case.question().is_empty());
    }
    assert!(find("no-such-case").is_none());
}

#[test]
fn rungs_have_distinct_labels_and_sound_scenes() {
    for case in all() {
        for size in [Size::Quick, Size::Full] {
            let rungs = case.rungs(size);
            for (i, rung) in rungs.iter().enumerate() {
                assert!(rungs[..i].iter().all(|other| other.label != rung.label));
                let scene = case.scene_of(rung);
                let scene = scene.unwrap_or_else(|e| panic!("{}: {e}", rung.label));
                scene
                    .check()
                    .unwrap_or_else(|e| panic!("{}: {e}", rung.label));
            }
        }
    }
}

#[test]
fn a_gate_on_nothing_fails() {
    for relation in [Relation::AtMost, Relation::AtLeast] {
        let gate = |value| Gate {
            name: String::new(),
            value,
            relation,
            bound: 1.0,
            reason: "",
        };
        assert!(!gate(f64::NAN).passed());
        assert!(gate(1.0).passed());
        assert_eq!(gate(0.5).passed(), relation == Relation::AtMost);
    }
    assert!(!Verdict::default().passed());
}
