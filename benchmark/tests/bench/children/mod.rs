//! Processes of other solvers: their scenes and their output.

mod said;
mod written;
