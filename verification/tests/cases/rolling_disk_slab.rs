//! The rolling disk as a slab.

use super::holds;
use proctor_verification::cases::RollingDiskSlab;

#[test]
fn gates_hold() {
    holds(&RollingDiskSlab::GIVEN);
}
