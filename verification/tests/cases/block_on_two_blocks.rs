//! A block on two others.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::BlockOnTwoBlocks;

#[test]
fn gates_hold() {
    holds(&BlockOnTwoBlocks::GIVEN);
}

#[test]
fn a_wrong_weight_and_a_shifted_block_break_their_gates() {
    let wrong = BlockOnTwoBlocks {
        shift: 0.02,
        heavier: 1.01,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    // Of each rung the force on the block and the shares, both off by about twice the bound. Balance holds for any block.
    assert_eq!(
        failing(&verdict).len(),
        verdict.gates.len() / 2,
        "{verdict:?}"
    );
}
