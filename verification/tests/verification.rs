//! The tests of the verification in one program, so that the kernel is linked once.
//!
//! `cargo test --test verification cases::` runs those of one file.

mod cases;
mod convergence;
mod element;
mod exact;
mod generated;
mod guest;
mod mill;
mod refine;
mod sensitivity;
mod stability;
mod study;
