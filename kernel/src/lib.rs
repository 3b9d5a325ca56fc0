//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`scene::Scene`] (checked values) -> [`plan::Plan`] (only what is needed) ->
//! [`simulation::Simulation`] (state and explicit cycle) -> frames, history, summary.

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
#[cfg(feature = "frames")]
pub mod output;
pub mod particles;
pub mod plan;
#[cfg(feature = "frames")]
pub mod run;
pub mod scene;
pub mod simulation;
pub mod stage;
pub mod surface;
pub mod team;
pub mod weights;
