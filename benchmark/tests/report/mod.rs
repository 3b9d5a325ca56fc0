//! The page of a record: what its first screen answers, what is folded, what changed since a base.

mod first_screen;
mod made_up;
mod parts;
mod since;
