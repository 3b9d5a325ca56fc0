//! The tests of the command and its parts in one program, so that the kernel is linked once.
//!
//! `cargo test --test benchmark judge::ledger` runs those of one file.

mod bench;
mod book;
mod command;
mod documents;
mod export;
mod figures;
mod forecast;
mod history;
mod judge;
mod measure;
mod precision;
mod progress;
mod record;
mod refine;
mod report;
mod runs;
mod show;
mod side_by_side;
mod stability;
mod statistics;
mod suite;
