//! Exact solutions, verification cases and observed orders for the MPM kernel.
#![forbid(unsafe_code)]

pub mod case;
pub mod cases;
pub mod convergence;
pub mod exact;
pub mod sensitivity;
pub mod settings;
pub mod study;
