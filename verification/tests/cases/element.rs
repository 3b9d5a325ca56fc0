//! Laws at a material point.

use super::{holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Element;

#[test]
fn gates_hold() {
    holds(&Element::GIVEN);
}

/// A stiffness that is off breaks every path, a strength that is off every surface.
#[test]
fn wrong_references_break_the_gates() {
    let stiff = Element {
        reference_stiffness: 1.01,
        ..Element::GIVEN
    };
    let verdict = stiff.judge(Size::Quick, &solve(&stiff));
    for gate in verdict
        .gates
        .iter()
        .filter(|g| !g.name.contains("states of"))
    {
        let order = gate.name.contains("one over");
        assert!(order || !gate.passed(), "{}: {}", gate.name, gate.value);
    }
    let weak = Element {
        reference_strength: 0.99,
        ..Element::GIVEN
    };
    let verdict = weak.judge(Size::Quick, &solve(&weak));
    for gate in verdict.gates.iter().filter(|g| g.name.contains("surface")) {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}
