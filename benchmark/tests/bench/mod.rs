//! The benchmark's parts: configuration, scenes, samples, frames of other solvers, comparison.

mod calibration;
mod config;
mod frames;
mod peers;
mod scenes;
mod sources;
