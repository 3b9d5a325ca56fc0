//! The configurable benchmark: scenes x particles x threads x methods, single stages, other executables.
//!
//! Each repetition goes once through all combinations, so that a change of the machine's mood meets all of them
//! alike; nothing is run beside a sample.

pub mod children;
pub mod config;
pub mod counted;
pub mod counts;
pub mod machine;
mod memory;
mod plan;
pub mod rows;
mod sample;
pub mod scenes;
mod session;
pub mod sources;
pub mod tables;

pub use plan::{Slot, slots};
pub use sample::{Kind, Sample, Settings, Work};
pub use session::Session;
