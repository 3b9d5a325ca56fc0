//! Lanes, and what is written in them: the same bits whatever their number, and laws against exact solutions.

mod functions;
mod laws;
mod operations;
mod stages;
