//! Vocabulary of the cases: nouns that several of them need.

pub mod far_boundary;
pub mod footing;
pub mod impulse;
pub mod incline;
pub mod lid;
pub mod mortar;
pub mod moved;
pub mod parts;
pub mod press;
pub mod pressures;
pub mod relaxation;
pub mod round;
pub mod run_out;
pub mod slab;
pub mod stepping;
pub mod vibration;
pub mod wet;
pub mod yielding;
