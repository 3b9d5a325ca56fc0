//! The page of a record: what its first screen answers, what is folded, what changed since a base.
#![allow(missing_docs)]

mod first_screen;
mod made_up;
mod parts;
mod since;
