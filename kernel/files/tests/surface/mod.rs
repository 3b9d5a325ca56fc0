//! Rigid surfaces from files: STL, the fixtures and scenes with them, and a restart beside one.

mod fixtures;
mod restart;
// The slope on which the kernel's own tests slide a block.
#[path = "../../../tests/surface/slope.rs"]
mod slope;
mod stl;
