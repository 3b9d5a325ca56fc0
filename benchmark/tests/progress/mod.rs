//! Progress of work: expected and measured times.

mod estimate;
mod ladders;
