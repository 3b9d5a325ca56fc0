//! USF and its start.

use super::{holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::StaggeredStart;

#[test]
fn gates_hold() {
    holds(&StaggeredStart::GIVEN);
}

/// The two starts are different: at once the error falls with the first power of the step, staggered with the second.
#[test]
fn a_start_at_once_is_of_order_one() {
    let solved = solve(&StaggeredStart::GIVEN);
    let verdict = StaggeredStart::GIVEN.judge(Size::Quick, &solved);
    let order = |variant: &str| {
        let name = format!("{variant}: observed order of L2(u)");
        let gate = verdict.gates.iter().find(|gate| gate.name == name);
        gate.expect("a gate").value
    };
    assert!(order("staggered") > 1.7, "{}", order("staggered"));
    let at_once = order("at once");
    assert!((0.85..1.15).contains(&at_once), "{at_once}");
}

#[test]
fn a_wrong_reference_breaks_the_gates() {
    let wrong = StaggeredStart {
        reference_amplitude: 1.1,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in verdict.gates.iter().filter(|g| g.name.contains("L2(u)")) {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}
