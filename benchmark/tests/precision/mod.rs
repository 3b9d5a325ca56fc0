//! Studies of error over time.

mod bounds;
mod cost;
