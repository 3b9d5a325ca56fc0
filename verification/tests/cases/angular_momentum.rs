//! The angular momentum of a block that spins.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::AngularMomentum;

#[test]
fn gates_hold() {
    holds(&AngularMomentum::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = AngularMomentum {
        reference: 1.0 + 1e-9,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
