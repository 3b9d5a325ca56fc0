//! Folders of runs, read back.

mod compare;
mod history;
