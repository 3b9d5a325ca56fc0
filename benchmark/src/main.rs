//! The `proctor` command.
#![forbid(unsafe_code)]

fn main() {}
