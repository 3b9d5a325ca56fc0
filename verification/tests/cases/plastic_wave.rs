//! The wave in solids that yield.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::PlasticWave;

#[test]
fn gates_hold() {
    holds(&PlasticWave::GIVEN);
}

/// A solid that is too strong has another wave and less to dissipate, but the load gives the same momentum; a load that is
/// too large breaks all.
#[test]
fn wrong_references_break_the_gates() {
    let strong = PlasticWave {
        reference_strength: 1.15,
        ..PlasticWave::GIVEN
    };
    let solved = solve(&strong);
    let verdict = strong.judge(Size::Quick, &solved);
    for gate in &verdict.gates {
        let same = gate.name.contains("momentum");
        assert_eq!(gate.passed(), same, "{}: {}", gate.name, gate.value);
    }
    let heavy = PlasticWave {
        reference_load: 1.05,
        ..PlasticWave::GIVEN
    };
    let verdict = heavy.judge(Size::Quick, &solve(&heavy));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
