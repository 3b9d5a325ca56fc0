//! The behaviour of the `proctor` command: exit codes, messages, files.
#![allow(missing_docs)]

mod bad_input;
mod bench;
mod compare;
mod pipe;
mod plan;
mod precision;
mod restart;
mod run;
mod support;
mod verify;
