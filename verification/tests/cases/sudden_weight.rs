//! The column that is let go.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::SuddenWeight;

#[test]
fn gates_hold() {
    holds(&SuddenWeight::GIVEN);
}

#[test]
fn wrong_references_break_the_gates() {
    let heavy = SuddenWeight {
        reference_gravity: 1.05,
        ..SuddenWeight::GIVEN
    };
    let verdict = heavy.judge(Size::Quick, &solve(&heavy));
    // All but the return to zero, which knows no weight.
    assert_eq!(
        failing(&verdict).len(),
        verdict.gates.len() - 1,
        "{verdict:?}"
    );
    let fast = SuddenWeight {
        reference_speed: 1.05,
        ..SuddenWeight::GIVEN
    };
    let verdict = fast.judge(Size::Quick, &solve(&fast));
    for gate in verdict.gates.iter().filter(|g| g.name.contains("L2")) {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}
