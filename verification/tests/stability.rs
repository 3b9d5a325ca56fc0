//! Predicted and measured limits: against a laboratory of its own, against each other, and against what the kernel holds.

mod arnoldi;
mod extreme;
mod frozen;
mod laboratory;
mod limits;
mod measured;
mod nonlinear;
mod round;
mod scene;
mod table;
mod tension;
