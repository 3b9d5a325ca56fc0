//! Scenes: the manuals' inputs as printed, our own keys, bad input, records, and scenes built by a library user.
#![cfg(feature = "json")]

mod any_input;
mod bad_cases;
mod bad_input;
mod keys;
mod library;
mod manual;
mod mortar;
mod records;
