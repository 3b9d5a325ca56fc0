//! The sensitivity of gates, on cases made up for it.

use proctor_scene::simulation::Options;
use proctor_verification::case::gates::Runs;
use proctor_verification::case::ladder::Ladder;
use proctor_verification::case::{Case, Gate, Quantity, Relation, Rung, RungResult, Size, Verdict};
use proctor_verification::sensitivity::reactions;

/// A case that is judged by gates of the test's own.
fn made(judge: fn(&Runs<'_>) -> Verdict) -> Case {
    Case::new("made", "What do gates react to?")
        .ladder(Ladder::sizes(&[("made", &[0.2, 0.1])], &[]))
        .solve_by(|rung, _, _, _| Ok(solved(rung)))
        .judge_by(judge)
}

fn solved(rung: &Rung) -> RungResult {
    let quantity = |name, value, exact, error| Quantity {
        name,
        value,
        exact,
        error,
        unit: "1",
    };
    let error = 0.1 * rung.cell * rung.cell;
    RungResult {
        particles: 1,
        steps: 1,
        time: 1.0,
        quantities: vec![
            quantity("force", 500.0 * (1.0 + error), Some(500.0), Some(error)),
            quantity("balance", 1e-16, Some(0.0), None),
            quantity("count", 0.0, Some(0.0), None),
        ],
        drawings: vec![],
        curve: None,
    }
}

/// The verdict of gates.
fn of(gates: Vec<Gate>) -> Verdict {
    Verdict {
        gates,
        ..Verdict::default()
    }
}

/// Names of the quantities that each gate reacts to, with the cell sizes.
fn reacted(case: &Case) -> Vec<Vec<String>> {
    let solved: Vec<_> = case
        .rungs(Size::Quick)
        .into_iter()
        .map(|rung| {
            let run = case.solve(&rung, &Options::default(), &mut |_| ());
            (rung, run.expect("made up"))
        })
        .collect();
    reactions(case, Size::Quick, &solved)
        .into_iter()
        .map(|reaction| {
            let to = reaction.to.into_iter();
            to.map(|n| format!("{} {}", n.rung, n.quantity)).collect()
        })
        .collect()
}

fn gate(value: f64, relation: Relation, bound: f64) -> Gate {
    Gate {
        name: "a gate".to_owned(),
        value,
        relation,
        bound,
        reason: "made up",
    }
}

#[test]
fn a_gate_reacts_to_the_number_that_it_judges_and_to_no_other() {
    let case = made(|runs| {
        let solved = runs.solved;
        let fine = &solved[1].1;
        of(vec![
            gate(fine.error("force"), Relation::AtMost, 0.01),
            gate(fine.value("balance"), Relation::AtMost, 1e-10),
            gate(fine.value("count"), Relation::AtMost, 0.0),
            gate(fine.value("force"), Relation::AtLeast, 450.0),
        ])
    });
    let expected = ["force", "balance", "count", "force"];
    let expected = expected.map(|name| vec![format!("made h=0.1 {name}")]);
    assert_eq!(reacted(&case), expected);
}

#[test]
fn an_observed_order_reacts_to_both_of_its_errors() {
    let case = made(|runs| {
        let solved = runs.solved;
        let [coarse, fine] = [0, 1].map(|k: usize| solved[k].1.error("force"));
        of(vec![gate((coarse / fine).log2(), Relation::AtLeast, 1.7)])
    });
    let expected = vec!["made h=0.2 force".to_owned(), "made h=0.1 force".to_owned()];
    assert_eq!(reacted(&case), [expected]);
}

/// 500 N less 499 N: the large numbers need not be moved by twice the bound of themselves.
#[test]
fn a_gate_on_a_small_difference_reacts() {
    let case = made(|runs| {
        let solved = runs.solved;
        let added = solved[1].1.value("force") - 499.0;
        of(vec![gate((added - 1.0).abs(), Relation::AtMost, 5.0)])
    });
    assert_eq!(reacted(&case), [vec!["made h=0.1 force".to_owned()]]);
}

/// Faults that the judge must not contain: a bound on a number of the scene, one so wide that twice of it passes, one on a name
/// that no run has, and one that holds for either side.
#[test]
fn gates_that_cannot_fail_react_to_nothing() {
    let case = made(|runs| {
        let solved = runs.solved;
        let fine = &solved[1].1;
        of(vec![
            gate(fine.time, Relation::AtLeast, 1.0),
            gate(fine.error("force"), Relation::AtMost, 0.01),
            gate(0.1 * fine.error("force"), Relation::AtMost, 0.01),
            gate(fine.value("no such"), Relation::AtMost, 1.0),
            gate(fine.value("balance").min(0.0), Relation::AtMost, 1e-10),
        ])
    });
    let reacted = reacted(&case);
    let counts: Vec<usize> = reacted.iter().map(Vec::len).collect();
    assert_eq!(counts, [0, 1, 0, 0, 0], "{reacted:?}");
}
