//! Error bars of results without an exact answer, from runs on three meshes.
//!
//! The [`rule`] turns two differences between meshes into a bar and a verdict. [`series`] reduces histories to such
//! differences and holds the gates of a scene. [`meshes`] puts a scene on coarser and finer meshes, and [`point`] reads a value at
//! one material point on each; [`field`] compares whole fields. [`calibration`] checks the rule on ladders whose errors are known.

pub mod calibration;
pub mod field;
pub mod meshes;
pub mod point;
pub mod rule;
pub mod series;

pub use meshes::Meshes;
pub use rule::{Estimate, Rule, Verdict};
