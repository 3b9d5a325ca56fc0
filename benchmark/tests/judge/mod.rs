//! The judge, on records made by hand and by dice.

mod accuracy;
mod cannot_compare;
mod equal_error;
mod ledger;
mod noise;
mod recorded;
mod synthetic;
mod tampered;
mod time;
