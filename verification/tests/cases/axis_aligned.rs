//! The axis-aligned manufactured solution.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::AxisAligned;

#[test]
fn gates_hold() {
    for case in [AxisAligned::PLANE, AxisAligned::SPACE] {
        holds(&case);
    }
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = AxisAligned {
        reference_amplitude: 1.1,
        ..AxisAligned::PLANE
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
