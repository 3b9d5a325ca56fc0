//! Rigid surfaces: checks, the search for the nearest triangle, and contact in the cycle.

mod beside_contact;
mod contact;
mod penalty;
mod pressed;
mod search;
mod slide;
mod slope;
mod solid;
mod symmetry;
mod topology;
