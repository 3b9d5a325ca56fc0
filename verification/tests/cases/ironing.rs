//! The indenter in the block.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Ironing;

#[test]
fn gates_hold() {
    holds(&Ironing::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = Ironing {
        reference_force: 1.15,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
