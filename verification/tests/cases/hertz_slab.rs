//! The half disk as a slab.

use super::holds;
use proctor_verification::cases::HertzSlab;

#[test]
fn gates_hold() {
    holds(&HertzSlab::GIVEN);
}
