//! The half disk on a rigid plane.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Hertz;

#[test]
fn gates_hold() {
    holds(&Hertz::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = Hertz {
        reference_load: 1.2,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
