//! The benchmark's parts: configuration, scenes, samples, frames of other solvers, comparison.

mod calibration;
mod children;
mod config;
mod counted;
mod frames;
mod peers;
mod scenes;
mod sources;
mod words;
