//! The tests of the command and its parts in one program, so that the kernel is linked once.
//!
//! `cargo test --test benchmark judge::ledger` runs those of one file.

mod bench;
mod command;
mod documents;
mod export;
mod figures;
mod history;
mod judge;
mod record;
mod report;
mod show;
mod statistics;
