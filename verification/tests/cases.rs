//! The cases, quick: gates hold, every gate reacts to the number that it names and to no other, and a wrong reference breaks its
//! gates. The short ladder of a case is run once for all of these tests.

mod facts;
mod ironing;
mod peers;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, OnceLock};

use proctor_scene::simulation::Options;
use proctor_verification::case::{
    Case, Gate, Relation, Rung, RungResult, Size, Verdict, all, find,
};
use proctor_verification::check::{self, Runs, failing};

/// Errors and balances that no gate of the quick ladder judges, by case, and why. What is not here is judged.
const SHOWN: &[(&str, &[&str], &str)] = &[
    (
        "boussinesq",
        &["L2(u), all", "L2(stress)"],
        "the displacement under a nodal load grows with 1/h, stresses with it",
    ),
    (
        "incompressible-box",
        &["u_z at (.5,.5,.5)", "L2(u), r >= 0.2 m", "residual"],
        "beside the settlement of the patch; the whole ladder judges the order of L2, and *boussinesq* the residual",
    ),
    (
        "base-acceleration",
        &[
            "v(H - h/4, 0.2 s)",
            "L2(stress)",
            "difference of the lowest particles over A",
        ],
        "particles h/4 from an edge: the velocities of the edges themselves are judged, and L2(v)",
    ),
    (
        "staggered-start",
        &["L2(stress)"],
        "nothing is known of its order with USF, and what GIMP's domains leave of it does not fall with the cells",
    ),
    (
        "inclined-block",
        &["displacement at 2 s, elastic"],
        "of blocks that walk, beside finite elements",
    ),
    (
        "inclined-two-blocks",
        &["displacement, mu = 0.2, elastic"],
        "of `precision`, against finite elements of the block; the ladder judges the rigid one",
    ),
    (
        "block-on-two-blocks",
        &[
            "mean vertical stress in the pillars",
            "mean vertical stress in the block",
        ],
        "of `precision`; the reference leaves out the widening, 0.14 %",
    ),
    (
        "hertz",
        &[
            "peak pressure",
            "L2(p) against the barrier layer",
            "the layer's own L2 distance from Hertz",
        ],
        "with 3.4 cells over the half-width the pressure oscillates; the whole ladder judges the first two",
    ),
    (
        "hertz-slab",
        &[
            "L2(p) against Hertz",
            "L2(p) against the barrier layer",
            "the layer's own L2 distance from Hertz",
        ],
        "judged against the plane, not against Hertz",
    ),
    (
        "hertz-sphere",
        &["L2(p) against Hertz"],
        "2.4 cells over the contact radius",
    ),
    (
        "hertz-ball",
        &["L2(p) against Hertz"],
        "judged by radius and peak; the study has it",
    ),
    (
        "rolling-disk-slab",
        &["growth of the area minus that of spin and load"],
        "judged in the plane",
    ),
    (
        "cantilever",
        &[
            "the same, farthest vertex",
            "vertices from the reference, rms",
        ],
        "the paper gives neither; the first is a corner alone",
    ),
];

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

/// Every gate holds, has its reason and reacts to the number that it names, and every wrong reference breaks its gates; on as many
/// threads as there are, and with all faults of all cases at once.
#[test]
fn no_case_has_a_fault() {
    let (next, found) = (AtomicUsize::new(0), Mutex::new(vec![]));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let check = |case: &Case| {
        let ladders = ladders(case);
        errors_are_those_of_their_values(&ladders[0]);
        let own = SHOWN.iter().filter(|(of, ..)| *of == case.name());
        let shown: Vec<&str> = own
            .flat_map(|(_, names, _)| names.iter().copied())
            .collect();
        let faults = check::faults(case, ladders, &shown);
        let faults = faults
            .into_iter()
            .map(|fault| format!("{}: {fault}", case.name()));
        found.lock().expect("no thread panics here").extend(faults);
    };
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(case) = all().get(next.fetch_add(1, Ordering::Relaxed)) {
                    check(case);
                }
            });
        }
    });
    let found = found.into_inner().expect("no thread panics here");
    assert!(found.is_empty(), "{found:#?}");
}

/// Cases whose reference is the run of another one.
const WITHOUT_WRONG: [&str; 2] = ["hertz-slab", "rolling-disk-slab"];

#[test]
fn every_case_has_a_wrong_reference() {
    let without = all().iter().filter(|case| case.wrong().is_empty());
    let without: Vec<_> = without.map(|case| case.name()).collect();
    assert_eq!(without, WITHOUT_WRONG);
}

/// Asserts that an error is that of its value from what is exact, so that moving the one is moving the other.
fn errors_are_those_of_their_values(solved: &[(Rung, RungResult)]) {
    for (rung, run) in solved {
        for q in &run.quantities {
            let (Some(error), Some(exact)) = (q.error, q.exact) else {
                assert_eq!(
                    q.error, None,
                    "{}: {} has no exact value",
                    rung.label, q.name
                );
                continue;
            };
            let off = if exact == 0.0 {
                // Of the unit of the value, or over what it would be without contact.
                assert!(error <= q.value.abs(), "{}: {}", rung.label, q.name);
                assert_eq!(error == 0.0, q.value == 0.0, "{}: {}", rung.label, q.name);
                continue;
            } else {
                (q.value / exact - 1.0).abs()
            };
            assert!(
                (error - off).abs() <= 1e-12 + 1e-9 * off,
                "{}: {}",
                rung.label,
                q.name
            );
        }
    }
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
