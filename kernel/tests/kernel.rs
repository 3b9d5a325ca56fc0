//! The tests of the kernel in one program, so that what is compiled for all lanes is compiled and linked once.
//!
//! `cargo test --test kernel physics::limits` runs those of one file.

mod bodies;
mod common;
mod lanes;
mod laws;
mod memory;
mod mortar;
mod physics;
mod plan;
mod properties;
mod ranks;
mod revolution;
mod scene;
mod surface;
mod team;
mod tension;
mod water;
