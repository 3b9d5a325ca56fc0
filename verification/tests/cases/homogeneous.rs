//! Tests of the laboratory.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Homogeneous;

#[test]
fn gates_hold() {
    holds(&Homogeneous::GIVEN);
}

/// Every stress notices a specimen that is stronger, every volume that is not prescribed a dilation that is larger, and what
/// is prescribed notices a larger strain.
#[test]
fn wrong_references_break_the_gates() {
    let judged = |case: Homogeneous| case.judge(Size::Quick, &solve(&case));
    let strong = judged(Homogeneous {
        reference_strength: 1.2,
        ..Homogeneous::GIVEN
    });
    for gate in strong.gates.iter().filter(|g| g.name.contains("stress")) {
        assert!(!gate.passed(), "{}: {}", gate.name, gate.value);
    }
    let loose = judged(Homogeneous {
        reference_dilation: 1.1,
        ..Homogeneous::GIVEN
    });
    for gate in loose.gates.iter().filter(|g| g.name.contains("volume")) {
        let dilates = gate.name.contains("Mohr") || gate.name.contains("Drucker");
        let free = !gate.name.contains("oedometer");
        assert_eq!(gate.passed(), !(dilates && free), "{}", gate.name);
    }
    let far = judged(Homogeneous {
        reference_strain: 1.03,
        ..Homogeneous::GIVEN
    });
    let failed = failing(&far);
    for test in ["oedometer", "biaxial", "triaxial"] {
        for law in ["Mohr-Coulomb", "Drucker-Prager"] {
            let name = format!("{test}, {law}");
            let sees = |line: &&String| line.contains(&name) && line.contains("volume");
            assert!(failed.iter().any(|line| sees(&line)), "{name}: {failed:?}");
        }
    }
}
