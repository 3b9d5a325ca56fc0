//! The tests of the files in one program, so that the kernel is linked once.
//!
//! `cargo test --test files scene::keys` runs those of one file.

#[path = "../../tests/common/mod.rs"]
mod common;
mod inactive;
mod output;
mod reading;
mod scene;
mod surface;
