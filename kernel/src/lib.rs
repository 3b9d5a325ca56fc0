//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`scene::Scene`] (checked values) -> [`plan::Plan`] (only what is needed) ->
//! [`simulation::Simulation`] (state and explicit cycle) -> what can be asked of it, and
//! [`simulation::Saved`], its state as one plain value.
//!
//! It reads and writes no files: `proctor-files`, the package beside it, does, and needs nothing of the kernel that another
//! user of the library could not have.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod bodies;
pub mod constitutive;
pub mod contact;
pub mod grid;
pub mod lanes;
pub mod memory;
pub mod mortar;
pub mod particles;
pub mod plan;
pub mod scene;
pub mod simulation;
pub mod stage;
pub mod surface;
pub mod team;
pub mod weights;
