//! The vibrating bar.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Bar;

#[test]
fn gates_hold() {
    holds(&Bar::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = Bar {
        reference_stiffness: 1.01,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
