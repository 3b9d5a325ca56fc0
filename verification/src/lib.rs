//! Exact solutions, verification cases and observed orders for the MPM kernel.
#![forbid(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod case;
pub mod cases;
pub mod check;
pub mod convergence;
pub mod element;
pub mod exact;
pub mod generated;
pub mod guest;
pub mod mill;
pub mod random;
pub mod refine;
pub mod sensitivity;
pub mod settings;
pub mod stability;
pub mod study;
