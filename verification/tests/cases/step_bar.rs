//! The bar under a step, and against a wall.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::StepBar;

#[test]
fn gates_hold() {
    holds(&StepBar::GIVEN);
}

/// Waves that are too fast move the front and part the bar too soon; a load that is too large breaks all that is in
/// proportion to it.
#[test]
fn wrong_references_break_the_gates() {
    let stiff = StepBar {
        reference_stiffness: 1.1,
        ..StepBar::GIVEN
    };
    let verdict = stiff.judge(Size::Quick, &solve(&stiff));
    for name in ["error of L2(u)", "error of way of", "error of duration"] {
        let mut gates = verdict.gates.iter().filter(|g| g.name.contains(name));
        assert!(gates.all(|gate| !gate.passed()), "{name}: {verdict:?}");
    }
    let heavy = StepBar {
        reference_load: 1.06,
        ..StepBar::GIVEN
    };
    let verdict = heavy.judge(Size::Quick, &solve(&heavy));
    for name in ["error of L2(u)", "speed", "pressure"] {
        let mut gates = verdict.gates.iter().filter(|g| g.name.contains(name));
        assert!(gates.all(|gate| !gate.passed()), "{name}: {verdict:?}");
    }
    assert!(failing(&verdict).len() >= 5);
}
