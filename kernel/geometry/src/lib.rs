//! Geometry for the cycle of `proctor-kernel`, which has it under the same names: shapes and the particles that fill them
//! ([`bodies`]); and what all of it shares: the background mesh, the memory of the machine, a team of threads. Boundaries and
//! surfaces that meet are in `proctor-contact`.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod bodies;
pub mod enclosed;
pub mod exact_sum;
pub mod memory;
pub mod mesh;
pub mod number;
pub mod polygon;
pub mod shape;
pub mod sheet;
pub mod solid;
pub mod stratum;
pub mod team;
pub mod vector;
