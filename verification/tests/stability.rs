//! Predicted and measured limits: against a laboratory of its own, against each other, and against what the kernel holds.
#![allow(missing_docs)]

#[path = "stability/extreme.rs"]
mod extreme;
#[path = "stability/laboratory.rs"]
mod laboratory;
#[path = "stability/limits.rs"]
mod limits;
#[path = "stability/scene.rs"]
mod scene;
#[path = "stability/table.rs"]
mod table;
#[path = "stability/tension.rs"]
mod tension;
