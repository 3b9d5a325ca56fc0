//! The book that is written from records and keys.

mod diagrams;
