//! Exact solutions, verification cases and observed orders for the MPM kernel.
#![forbid(unsafe_code)]

pub mod exact;
