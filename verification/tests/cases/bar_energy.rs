//! The energy of a bar over ten periods.

use super::{holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::BarEnergy;

#[test]
fn gates_hold() {
    holds(&BarEnergy::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_the_gates() {
    let wrong = BarEnergy {
        reference_energy: 1.25,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in verdict.gates.iter().filter(|g| !g.name.contains("less")) {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
}
