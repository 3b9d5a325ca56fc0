//! The `proctor` command.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    proctor_benchmark::command()
}
