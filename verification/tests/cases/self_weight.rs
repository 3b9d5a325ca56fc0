//! The column under its own weight.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::SelfWeight;

#[test]
fn gates_hold() {
    holds(&SelfWeight::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = SelfWeight {
        reference_gravity: 1.04,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
