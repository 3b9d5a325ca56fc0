//! Scenes made of random choices, and their judges.

use std::collections::BTreeMap;

use proctor_verification::generated::{self, Deviation, Dice, FinalState, QUESTIONS};

/// Seed of the scenes that are kept.
const SEED: u64 = 1;

#[test]
#[ignore = "takes 10 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn two_hundred_scenes_hold() {
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    let mut wrong = vec![];
    for number in 0..200 {
        let answer = generated::answer(SEED, number);
        *counts.entry(answer.question.name).or_default() += 1;
        if answer.violates() {
            let found = match (&answer.found, answer.worst()) {
                (Err(error), _) => error.clone(),
                (_, worst) => format!("{worst:?}"),
            };
            let written = proctor_files::json::write_own(&answer.scene);
            let scene = written.map_or_else(|e| e.to_string(), |written| written.scene.to_string());
            wrong.push(format!(
                "{} {number}, {}: {found}\n{scene}",
                answer.question.name, answer.question.holds
            ));
        }
    }
    assert_eq!(counts.len(), QUESTIONS.len(), "{counts:?}");
    assert!(
        wrong.is_empty(),
        "{} violations:\n{}",
        wrong.len(),
        wrong.join("\n\n")
    );
}

/// Scenes whose result was decided by round-off, or grew without bound, each with its seed and number: soil at the end of a yield
/// surface that bears no tension, whose mean stress is the rest of a sum; and blocks on plates under local damping.
#[test]
fn what_round_off_or_damping_decided_holds() {
    for (seed, number) in [(1, 1462), (1, 9374), (1, 6566), (2, 2066)] {
        let answer = generated::answer(seed, number);
        let worst = answer.worst();
        assert!(!answer.violates(), "{seed} {number}: {worst:?}");
        // Where a plan foresees a share of the pressure, no more than that.
        let off = worst.map_or(f64::INFINITY, |worst| worst.value);
        assert!(off < 1.0, "{seed} {number}: {worst:?}");
    }
}

/// Scenes whose rows are off at the end of the run: plans warn of the first five, and the runs of the others tell that they do not rest.
#[test]
fn rows_that_are_off_are_foreseen_or_told() {
    for (seed, number) in [(1, 215), (1, 341), (1, 2227), (1, 3473), (4, 8045)] {
        let answer = generated::answer(seed, number);
        assert!(answer.deviates(), "{seed} {number}: {:?}", answer.worst());
        assert!(answer.foreseen && !answer.violates(), "{seed} {number}");
    }
    for (seed, number) in [(2, 320), (2, 2140), (2, 3617), (4, 6116)] {
        let answer = generated::answer(seed, number);
        assert!(
            answer.deviates() && !answer.foreseen,
            "{seed} {number}: {:?}",
            answer.worst()
        );
        assert!(answer.told && !answer.violates(), "{seed} {number}");
    }
}

#[test]
fn a_scene_follows_from_seed_and_number() {
    for number in 0..2 * QUESTIONS.len() as u64 {
        let scenes = |seed| {
            let (_, trial) = generated::trial(seed, number);
            trial
                .runs
                .into_iter()
                .map(|run| format!("{:?}", run.scene))
                .collect::<Vec<_>>()
        };
        assert_eq!(scenes(3), scenes(3));
        assert_ne!(scenes(3), scenes(4));
    }
}

/// A change of a result that is wrong by more than any bound, in one kind of number.
type Fault = fn(&mut FinalState);

/// The kinds of numbers that judges look at.
const FAULTS: [(&str, Fault); 6] = [
    ("velocities", |seen| {
        let scale = seen.fastest();
        for (k, p) in seen.particles.iter_mut().enumerate() {
            p.velocity[0] += 1e-4 * scale * (1.0 + k as f64);
        }
    }),
    ("stresses", |seen| {
        let scale = most(seen);
        for p in &mut seen.particles {
            p.stress = p.stress.map(|s| s + 0.2 * scale);
        }
    }),
    // Where none should be, what is there is round-off.
    ("stresses without a cause", |seen| {
        for p in &mut seen.particles {
            p.stress = p.stress.map(|s| 1e9 * s);
        }
    }),
    ("positions", |seen| {
        for p in &mut seen.particles {
            let way = p.position[0] - p.start[0];
            p.position[0] += 1e-3 * way.abs().max(1e-9 * p.start[0].abs());
        }
    }),
    ("masses", |seen| {
        for p in &mut seen.particles {
            p.mass *= 1.0 + 1e-9;
        }
    }),
    ("times", |seen| seen.time *= 1.0 + 1e-9),
];

/// Largest stress of a run \[Pa\]; that of the start, or 1, where there is none.
fn most(seen: &FinalState) -> f64 {
    let all = seen.particles.iter().flat_map(|p| p.stress);
    let most = all.fold(0.0_f64, |most, s| most.max(s.abs()));
    if most > 0.0 { most } else { 1.0 }
}

/// Each distance that a judge gives leaves its bound when the numbers that it is about are wrong.
#[test]
fn each_judge_notices_a_wrong_result() {
    for (index, question) in QUESTIONS.iter().enumerate() {
        let trial = (question.make)(&mut Dice::new(SEED, index as u64));
        let seen = generated::results(&trial.runs)
            .unwrap_or_else(|error| panic!("{}: {error}", question.name));
        let right = (trial.judge)(&seen);
        assert!(!right.is_empty(), "{} compares nothing", question.name);
        for (k, distance) in right.iter().enumerate() {
            let noticed = FAULTS.iter().any(|(_, fault)| {
                let mut wrong = seen.clone();
                if let Some(last) = wrong.last_mut() {
                    fault(last);
                }
                let found = (trial.judge)(&wrong);
                found.get(k).is_none_or(Deviation::violates)
            });
            assert!(
                noticed,
                "{}: nothing moves `{}`",
                question.name, distance.what
            );
        }
    }
}

#[test]
fn what_is_not_a_number_violates() {
    assert!(Deviation::new("nothing", f64::NAN, 1.0).violates());
    assert!(Deviation::new("nothing", 2.0, 1.0).violates());
    assert!(!Deviation::new("nothing", 0.0, 0.0).violates());
    // A particle that is lost is not a number either.
    let (_, trial) = generated::trial(SEED, 0);
    let mut seen = generated::results(&trial.runs).expect("a scene that runs");
    seen[0].particles[0].position = [f64::NAN; 3];
    assert!((trial.judge)(&seen).iter().any(Deviation::violates));
}
