//! The cases, quick: they solve, their gates hold, and a wrong reference breaks the gates. The modules mirror
//! `src/cases`.

mod angular_momentum;
mod axis_aligned;
mod bar;
mod bar_energy;
mod base_acceleration;
mod block_on_two_blocks;
mod boussinesq;
mod cantilever;
mod collapse;
mod colliding_blocks;
mod element;
mod fluid;
mod footing;
mod grains;
mod hertz;
mod hertz_slab;
mod hertz_sphere;
mod homogeneous;
mod inclined_block;
mod inclined_two_blocks;
mod ironing;
mod plastic_wave;
mod rings;
mod rolling_disk;
mod rolling_disk_slab;
mod rotation;
mod self_weight;
mod shear_and_turn;
mod slipping_disk;
mod slope;
mod softening_bar;
mod sphere_on_terrain;
mod spin;
mod spinning_collision;
mod staggered_start;
mod step_bar;
mod sudden_weight;
mod tilted_incline;
mod vortex;
mod yielding_column;

use proctor_scene::simulation::Options;
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

/// Solves all quick rungs on one thread.
fn solve(case: &dyn Case) -> Vec<(Rung, Solved)> {
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    case.rungs(Size::Quick)
        .into_iter()
        .map(|rung| {
            let solved = case
                .solve(&rung, &options, &mut |share| {
                    assert!((0.0..=1.0).contains(&share));
                })
                .unwrap_or_else(|e| panic!("{e}"));
            (rung, solved)
        })
        .collect()
}

/// Lines of the gates that fail.
fn failing(verdict: &Verdict) -> Vec<String> {
    verdict
        .gates
        .iter()
        .filter(|gate| !gate.passed())
        .map(|g| format!("{}: {:e} {:?} {:e}", g.name, g.value, g.relation, g.bound))
        .collect()
}

/// Asserts that all gates of a case hold, that without any run none does, and that each fails as soon as the number
/// that it names is off by twice its bound, and for no other number; the verdict.
fn holds(case: &dyn Case) -> Verdict {
    let solved = solve(case);
    let verdict = case.judge(Size::Quick, &solved);
    assert_eq!(failing(&verdict), Vec::<String>::new());
    assert!(verdict.passed());
    let nothing = case.judge(Size::Quick, &[]);
    assert_eq!(failing(&nothing).len(), nothing.gates.len());
    errors_are_those_of_their_values(&solved);
    let mut judged = vec![];
    for Reaction { gate, to } in reactions(case, Size::Quick, &solved) {
        assert!(!to.is_empty(), "nothing makes it fail: {}", gate.name);
        for number in to {
            let (name, Number { rung, quantity }) = (&gate.name, number);
            judged.push(quantity);
            assert!(
                name.contains(quantity),
                "{name}: fails for {quantity}, {rung}"
            );
        }
    }
    let shown = |name| {
        let mut own = SHOWN.iter().filter(|(of, ..)| *of == case.name());
        own.any(|(_, names, _)| names.contains(&name))
    };
    for (rung, run) in &solved {
        for q in &run.quantities {
            let should_be = q.error.is_some() || q.exact == Some(0.0);
            let seen = !should_be || judged.contains(&q.name) || shown(q.name);
            assert!(seen, "{}: no gate judges {}", rung.label, q.name);
        }
    }
    verdict
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
                case.scene(rung)
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
