//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`scene::Scene`] (checked values) -> plan (only what is needed) -> simulation (state and explicit
//! cycle) -> frames, history, summary.

#![deny(unsafe_code)]

pub mod lanes;
pub mod scene;
