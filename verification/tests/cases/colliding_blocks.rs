//! Colliding bodies.

use super::{holds, solve};
use proctor_scene::simulation::Options;
use proctor_verification::case::{Case, Gate, Rung, Size};
use proctor_verification::cases::CollidingBlocks;

#[test]
fn gates_hold() {
    holds(&CollidingBlocks::GIVEN);
}

/// Stiffer bars part sooner, with the same velocities.
#[test]
fn a_wrong_reference_breaks_the_gates_on_the_duration() {
    let wrong = CollidingBlocks {
        reference_stiffness: 0.7,
        ..CollidingBlocks::GIVEN
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let durations = verdict.gates.iter().filter(|g| g.name.contains("duration"));
    assert_eq!(durations.clone().count(), 15);
    for gate in durations {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}

/// Gates of one rung, judged alone.
fn gates_of(case: &CollidingBlocks, rung: &Rung) -> Vec<Gate> {
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let solved = case
        .solve(rung, &options, &mut |_| ())
        .unwrap_or_else(|e| panic!("{}: {e}", rung.label));
    let verdict = case.judge(Size::Quick, &[(rung.clone(), solved)]);
    let own = format!("{}: ", rung.label);
    let gates = verdict.gates.into_iter();
    gates.filter(|g| g.name.starts_with(&own)).collect()
}

/// The finest rung of all bars has a gate on its impulse. With a reference that is off by twice the gate, either way, it
/// fails, and no other gate notices.
#[test]
fn an_impulse_off_by_twice_its_gate_breaks_it() {
    let of_impulse = |gate: &&Gate| gate.name.ends_with(": impulse");
    let mut found = 0;
    for rung in CollidingBlocks::GIVEN.rungs(Size::Quick) {
        if !rung.variant.starts_with("bars") {
            continue;
        }
        let given = gates_of(&CollidingBlocks::GIVEN, &rung);
        let Some(impulse) = given.iter().find(of_impulse) else {
            continue;
        };
        println!(
            "{}: {:.3e} of {:.3e}",
            impulse.name, impulse.value, impulse.bound
        );
        found += 1;
        for sign in [1.0, -1.0] {
            let wrong = CollidingBlocks {
                reference_impulse: 1.0 + sign * 2.0 * impulse.bound,
                ..CollidingBlocks::GIVEN
            };
            for (gate, before) in gates_of(&wrong, &rung).iter().zip(&given) {
                let ours = of_impulse(&gate);
                assert_eq!(gate.passed(), !ours, "{}: {}", gate.name, gate.value);
                assert!(ours || gate.value.to_bits() == before.value.to_bits());
            }
        }
    }
    // Three schemes, two more ratios of masses, one of lengths, one of impedances, and three dimensions.
    assert_eq!(found, 8);
}
