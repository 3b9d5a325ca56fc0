//! The bar that parts.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::SofteningBar;

#[test]
fn gates_hold() {
    holds(&SofteningBar::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_the_gates() {
    let tough = SofteningBar {
        reference_opening: 1.1,
    };
    let verdict = tough.judge(Size::Quick, &solve(&tough));
    let failed = failing(&verdict);
    assert!(
        failed.iter().any(|gate| gate.contains("crack band")),
        "{verdict:?}"
    );
}
