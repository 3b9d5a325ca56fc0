//! The column that yields under its own weight.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::YieldingColumn;

#[test]
fn gates_hold() {
    holds(&YieldingColumn::GIVEN);
}

/// The vertical stress is the weight above however strong the column is; what depends on the law notices.
#[test]
fn wrong_references_break_the_gates() {
    let strong = YieldingColumn {
        reference_strength: 1.25,
        ..YieldingColumn::GIVEN
    };
    let verdict = strong.judge(Size::Quick, &solve(&strong));
    for gate in &verdict.gates {
        let same = gate.name.contains("vertical");
        assert_eq!(gate.passed(), same, "{}: {}", gate.name, gate.value);
    }
    let heavy = YieldingColumn {
        reference_gravity: 1.04,
        ..YieldingColumn::GIVEN
    };
    let verdict = heavy.judge(Size::Quick, &solve(&heavy));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}
