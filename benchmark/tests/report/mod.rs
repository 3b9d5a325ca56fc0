//! The page of a record: what its first screen answers, what is folded, what changed since a base.

mod before;
mod first_screen;
mod gates;
mod heat;
mod html;
mod made_up;
mod parts;
mod since;
