//! Scenes: the manuals' inputs as printed, our own keys, bad input, and records.

mod any_input;
mod bad_cases;
mod bad_input;
mod glossary;
mod harmonic;
mod keys;
mod layers;
mod manual;
mod mortar;
mod position;
mod records;
mod soils;
mod stages;
mod terrain;
mod unknown;
mod written;
