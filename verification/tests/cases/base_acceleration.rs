//! The shaken column and the manual's shaken block.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::BaseAcceleration;

#[test]
fn gates_hold() {
    holds(&BaseAcceleration::GIVEN);
}

#[test]
fn wrong_references_break_every_gate() {
    let wrong = BaseAcceleration {
        reference_stiffness: 1.01,
        reference_frequency: 1.005,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
