//! The behaviour of the `proctor` command: exit codes, messages, files.

mod accept;
mod again;
mod any_input;
mod arena;
mod bad_input;
mod bench;
mod caution;
#[cfg(unix)]
mod commits;
mod compare;
mod drift;
mod element;
mod energy;
mod folder;
#[cfg(unix)]
mod foreign_ci;
mod generated;
#[cfg(unix)]
mod geomechanics;
#[cfg(unix)]
mod guest_bounds;
#[cfg(unix)]
mod guest_reports;
#[cfg(unix)]
mod guest_words;
mod guests;
mod history;
mod keys;
mod memory;
mod mill;
mod new;
mod picture;
mod pipe;
mod plan;
mod precision;
mod refine;
mod report;
mod restart;
mod run;
mod runs;
#[cfg(unix)]
mod scripts;
mod soils;
mod stability;
mod stages;
mod standard_input;
mod support;
mod terminal;
mod threads;
mod verify;
