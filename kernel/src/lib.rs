//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`scene::Scene`] (checked values) -> plan (only what is needed) -> simulation (state and explicit
//! cycle) -> frames, history, summary.

#![deny(unsafe_code)]

pub mod bodies;
pub mod constitutive;
pub mod grid;
pub mod lanes;
pub mod particles;
pub mod plan;
pub mod scene;
pub mod simulation;
pub mod stage;
pub mod weights;
