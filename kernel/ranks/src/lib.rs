//! Ranks of MPI: processes on one or several machines that share a simulation.
//!
//! The kernel names the messages ([`Ranks`](proctor_kernel::ranks::Ranks)); this package sends them by MPI. It is empty without
//! the feature `engine`, which needs an installation of MPI, a C compiler and libclang (on Debian `libopenmpi-dev`, `openmpi-bin`
//! and `libclang-dev`).

#![forbid(unsafe_code)]

#[cfg(feature = "engine")]
mod engine;

#[cfg(feature = "engine")]
pub use engine::{Engine, EngineError};
