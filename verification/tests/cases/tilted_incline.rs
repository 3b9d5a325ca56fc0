//! The block on a tilted plane.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::TiltedIncline;

#[test]
fn gates_hold() {
    holds(&TiltedIncline::GIVEN);
}

/// Gravity larger by a tenth: it slides faster by as much. Friction follows the weight, so what sticks sticks, and no
/// particle goes through.
#[test]
fn a_wrong_scene_breaks_every_gate_on_sliding() {
    let wrong = TiltedIncline { pull: 1.1 };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in &verdict.gates {
        let slides = ["mu=0 soft:", "mu=0.5 soft:"]
            .iter()
            .any(|mu| gate.name.contains(mu));
        let moves = slides && !gate.name.contains("penetration");
        assert_eq!(gate.passed(), !moves, "{}: {}", gate.name, gate.value);
    }
    assert!(!failing(&verdict).is_empty());
}
