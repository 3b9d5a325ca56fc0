//! Two blocks on an incline.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::InclinedTwoBlocks;

#[test]
fn gates_hold() {
    holds(&InclinedTwoBlocks::GIVEN);
}

/// A wrong gravity changes every way and acceleration. It pulls nothing.
#[test]
fn a_wrong_scene_breaks_every_gate_on_motion() {
    let wrong = InclinedTwoBlocks { pull: 1.01 };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in &verdict.gates {
        let moves = !gate.name.contains("over weight");
        assert_eq!(gate.passed(), !moves, "{}: {}", gate.name, gate.value);
    }
    assert!(!failing(&verdict).is_empty());
}
