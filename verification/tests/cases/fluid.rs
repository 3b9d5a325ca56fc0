//! Fluids at rest, in sound and in flow.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Fluid;

#[test]
fn gates_hold() {
    holds(&Fluid::GIVEN);
}

/// Viscosity is in sound and in what starts to flow; a force in everything that it drives.
#[test]
fn wrong_references_break_the_gates() {
    let viscous = Fluid {
        reference_viscosity: 1.1,
        ..Fluid::GIVEN
    };
    let verdict = viscous.judge(Size::Quick, &solve(&viscous));
    let failed = failing(&verdict);
    for name in [
        "sound: error",
        "force: error",
        "drag: error",
        "Bingham force: error",
    ] {
        assert!(
            failed.iter().any(|gate| gate.starts_with(name)),
            "{name}: {failed:?}"
        );
    }
    let heavy = Fluid {
        reference_force: 1.05,
        ..Fluid::GIVEN
    };
    let verdict = heavy.judge(Size::Quick, &solve(&heavy));
    for gate in &verdict.gates {
        let is_of_force = gate.name.contains("error") && !gate.name.starts_with("sound");
        assert!(
            !(is_of_force && gate.passed()),
            "{}: {}",
            gate.name,
            gate.value
        );
    }
}
