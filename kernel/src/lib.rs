//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`simulation::Model`] (settings, plan, bodies) and [`simulation::Start`] (particles, interactions) ->
//! [`simulation::Cycle`] (state and explicit cycle). A cycle gives its results by queries, and its whole state as a
//! [`simulation::SavedState`].
//!
//! It knows no scene, no law of a material, no contact and no file. Laws, conditions and interactions come by the traits
//! [`laws::Law`], [`simulation::Condition`] and [`simulation::Interaction`]; `proctor-laws`, `proctor-contact` and
//! `proctor-scene` beside it implement them, and have nothing that a program's own does not have.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod lanes;
pub mod laws;
pub mod layout;
pub mod model;
pub mod particles;
pub mod plan;
pub mod simulation;
pub mod transfers;
pub mod weighting;

// What the cycle is made of: open to the tests and benchmarks beside it, and not meant for a user. What a user's own
// condition or interaction meets of it is in `simulation`.
#[doc(hidden)]
pub mod grid;
#[doc(hidden)]
pub mod sorting;
#[doc(hidden)]
pub mod stage;
#[doc(hidden)]
pub mod weights;

pub use proctor_geometry::{bodies, enclosed, memory, number, shape, sheet, solid, stratum, team};
