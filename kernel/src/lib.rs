//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`scene::Scene`] (checked values) -> plan (only what is needed) -> simulation (state and explicit
//! cycle) -> frames, history, summary.

#[cfg(feature = "frames")]
pub mod output;
pub mod scene;
