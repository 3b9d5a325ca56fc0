//! The cases, quick: gates hold, every gate reacts to the number that it names and to no other, and a wrong reference breaks its
//! gates. The short ladder of a case is run once for all of these tests.

mod facts;
mod ironing;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, OnceLock};

use proctor_scene::simulation::Options;
use proctor_verification::case::wrong::Reference;
use proctor_verification::case::{Case, Gate, Relation, Rung, Size, Solved, Verdict, all, find};
use proctor_verification::sensitivity::{Number, Reaction, reactions};

/// Errors and balances that no gate of the quick ladder judges, by case, and why. What is not here is judged.
const SHOWN: &[(&str, &[&str], &str)] = &[
    (
        "boussinesq",
        &["L2(u), all", "L2(stress)"],
        "the displacement under a nodal load grows with 1/h, stresses with it",
    ),
    (
        "base-acceleration",
        &[
            "v(H - h/4, 0.2 s)",
            "L2(stress)",
            "lowest particles off by, over A",
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
        "rolling-disk-slab",
        &["growth of the area, less that of spin and load"],
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

/// A ladder, rung by rung.
type Ladder = Vec<(Rung, Solved)>;

/// Solves a rung on one thread.
fn solve(case: &Case, rung: &Rung) -> Solved {
    let mut progress = |share| assert!((0.0..=1.0).contains(&share));
    let solved = case.solve(rung, &one_thread(), &mut progress);
    solved.unwrap_or_else(|error| panic!("{error}"))
}

fn one_thread() -> Options {
    Options {
        threads: Some(1),
        ..Options::default()
    }
}

/// The short ladder of a case with the correct reference, then those with the wrong ones on the rungs that they are run on: one run
/// of a rung for all of them where a run does not depend on the reference.
fn ladders(case: &Case) -> &'static [Ladder] {
    static RUNS: LazyLock<Vec<OnceLock<Vec<Ladder>>>> =
        LazyLock::new(|| all().iter().map(|_| OnceLock::new()).collect());
    let place = all().iter().position(|other| other.name() == case.name());
    let place = place.unwrap_or_else(|| panic!("no case {}", case.name()));
    RUNS[place].get_or_init(|| {
        let wrong = case.wrong().iter().map(|wrong| Reference::with(*wrong));
        let references: Vec<_> = [Reference::CORRECT].into_iter().chain(wrong).collect();
        let mut ladders = vec![vec![]; references.len()];
        for rung in case.rungs(Size::Quick) {
            let once = case.solve_against(&rung, &one_thread(), &references);
            let all: Vec<_> = match once {
                Some(all) => {
                    let all = all.unwrap_or_else(|error| panic!("{error}"));
                    all.into_iter().map(Some).collect()
                }
                None => {
                    let wrong = case.wrong().iter().map(|wrong| {
                        let is_run = (wrong.on)(&rung);
                        is_run.then(|| solve(&case.with(*wrong), &rung))
                    });
                    [Some(solve(case, &rung))].into_iter().chain(wrong).collect()
                }
            };
            for (ladder, solved) in ladders.iter_mut().zip(all) {
                ladder.extend(solved.map(|solved| (rung.clone(), solved)));
            }
        }
        ladders
    })
}

/// The short ladder of a case, run once.
fn quick(case: &Case) -> &'static [(Rung, Solved)] {
    &ladders(case)[0]
}

/// Does a check of every case, on as many threads as there are; says of all that fail at once.
fn of_all(check: impl Fn(&Case) + Sync) {
    let (next, failed) = (AtomicUsize::new(0), Mutex::new(vec![]));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(case) = all().get(next.fetch_add(1, Ordering::Relaxed)) {
                    if catch_unwind(AssertUnwindSafe(|| check(case))).is_err() {
                        failed.lock().expect("no thread fails here").push(case.name());
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().expect("no thread fails here");
    assert!(failed.is_empty(), "{failed:?}: see above");
}

/// Lines of the gates that fail.
fn failing(verdict: &Verdict) -> Vec<String> {
    let failed = verdict.gates.iter().filter(|gate| !gate.passed());
    failed
        .map(|g| format!("{}: {:e} {:?} {:e}", g.name, g.value, g.relation, g.bound))
        .collect()
}

/// All gates hold, none does without any run, each has its reason, and each fails as soon as the number that it names is off by
/// twice its bound, and for no other number.
#[test]
fn every_gate_holds_and_reacts_to_the_number_that_it_names() {
    of_all(|case| {
        let solved = quick(case);
        let verdict = case.judge(Size::Quick, solved);
        assert_eq!(failing(&verdict), Vec::<String>::new(), "{}", case.name());
        assert!(verdict.passed(), "{}", case.name());
        let nothing = case.judge(Size::Quick, &[]);
        assert_eq!(failing(&nothing).len(), nothing.gates.len());
        errors_are_those_of_their_values(solved);
        let mut judged = vec![];
        for Reaction { gate, to } in reactions(case, Size::Quick, solved) {
            let name = format!("{}: {}", case.name(), gate.name);
            assert!(gate.reason.len() > 8, "{name}: without a reason");
            assert!(!to.is_empty(), "{name}: nothing makes it fail");
            for Number { rung, quantity } in to {
                judged.push(quantity);
                assert!(name.contains(quantity), "{name}: fails for {quantity}, {rung}");
            }
        }
        let shown = |name| {
            let mut own = SHOWN.iter().filter(|(of, ..)| *of == case.name());
            own.any(|(_, names, _)| names.contains(&name))
        };
        for (rung, run) in solved {
            for q in &run.quantities {
                let should_be = q.error.is_some() || q.exact == Some(0.0);
                let seen = !should_be || judged.contains(&q.name) || shown(q.name);
                assert!(seen, "{}, {}: no gate judges {}", case.name(), rung.label, q.name);
            }
        }
    });
}

/// Wrong references fail the gates that they must, and hold those that they must not touch.
#[test]
fn every_wrong_reference_breaks_its_gates() {
    of_all(|case| {
        for (wrong, solved) in case.wrong().iter().zip(&ladders(case)[1..]) {
            let verdict = case.with(*wrong).judge(Size::Quick, solved);
            let mut broken = 0;
            for gate in &verdict.gates {
                // Where some rungs alone are run, the gates on others say nothing.
                let own = |(rung, _): &(Rung, Solved)| gate.name.starts_with(&rung.label);
                if solved.len() < case.rungs(Size::Quick).len() && !solved.iter().any(own) {
                    continue;
                }
                let name = format!("{}, wrong {}: {}", case.name(), wrong.name, gate.name);
                broken += usize::from(!gate.passed());
                if let Some(must_fail) = wrong.must_fail(&gate.name) {
                    assert_eq!(!gate.passed(), must_fail, "{name}: {:e}", gate.value);
                }
            }
            assert!(broken > 0, "{}: a wrong {} breaks nothing", case.name(), wrong.name);
        }
    });
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
fn errors_are_those_of_their_values(solved: &[(Rung, Solved)]) {
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
        assert_eq!(find(case.name()).map(|found| found.name()), Some(case.name()));
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
                scene.check().unwrap_or_else(|e| panic!("{}: {e}", rung.label));
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
