//! The block on a tilted plane.

use super::holds;
use proctor_scene::simulation::Options;
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
    let wrong = TiltedIncline { pull: 1.02 };
    let rungs = wrong.rungs(Size::Quick).into_iter();
    let solved: Vec<_> = rungs
        .filter(|rung| rung.variant == "USL")
        .map(|rung| {
            let solved = wrong.solve(&rung, &Options::default(), &mut |_| ());
            (rung, solved.expect("it runs"))
        })
        .collect();
    assert_eq!(solved.len(), 3);
    let verdict = wrong.judge(Size::Quick, &solved);
    for gate in verdict.gates.iter().filter(|g| g.name.starts_with("USL")) {
        let slides = ["mu=0 soft:", "mu=0.5 soft:"]
            .iter()
            .any(|mu| gate.name.contains(mu));
        let moves = slides && !gate.name.contains("penetration");
        assert_eq!(gate.passed(), !moves, "{}: {}", gate.name, gate.value);
    }
}
