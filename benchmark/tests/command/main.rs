//! The behaviour of the `proctor` command: exit codes, messages, files.
#![allow(missing_docs)]

mod bad_input;
mod bench;
mod pipe;
mod plan;
mod restart;
mod run;
mod support;
mod verify;
