//! Rigid surfaces: files, checks, the search for the nearest triangle, and contact in the cycle.

mod beside_contact;
mod contact;
#[cfg(feature = "json")]
mod fixtures;
#[cfg(feature = "frames")]
mod restart;
mod search;
mod slope;
mod stl;
mod topology;
