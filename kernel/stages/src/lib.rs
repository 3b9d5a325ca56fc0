//! The stages of an explicit material point step, and what they work on: particles, grid, weighting functions, transfers.
//!
//! ```text
//! particles ──p2g──► mass, momentum, force ──solve──► velocity ──g2p──► velocity, position, strain ──law──► stress
//! ```
//!
//! Each stage is a function of columns of particles and lines of nodes, for a range of rows of cells that one thread owns.
//! It knows no time, no step and no condition: `proctor-kernel`, which hands all of this on under the same names, calls the
//! stages in the order of a step.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod history;
pub mod lanes;
pub mod laws;
pub mod layout;
pub mod model;
pub mod particles;
pub mod ranks;
pub mod transfers;
pub mod weighting;

// Open to the cycle, and to the tests and benchmarks beside it; not meant for a user.
#[doc(hidden)]
pub mod fields;
#[doc(hidden)]
pub mod grid;
#[doc(hidden)]
pub mod sorting;
#[doc(hidden)]
pub mod stage;
#[doc(hidden)]
pub mod weights;

use proctor_geometry::{exact_sum, team};
