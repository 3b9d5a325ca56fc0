//! The benchmark's parts: configuration, scenes, samples, frames of other solvers, comparison.

mod config;
mod frames;
mod peers;
mod scenes;
