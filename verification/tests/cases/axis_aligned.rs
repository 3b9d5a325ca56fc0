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

/// Twice the bound on the displacement.
#[test]
fn a_wrong_reference_breaks_every_gate_on_the_displacement() {
    let wrong = AxisAligned {
        reference_amplitude: 1.008,
        ..AxisAligned::PLANE
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in verdict.gates.iter().filter(|g| g.name.contains("L2(u)")) {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
    assert!(failing(&verdict).len() >= 4);
}
