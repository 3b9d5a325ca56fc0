//! Accelerograms and particle lists: tables of numbers in text files.

mod harmonic;
#[cfg(feature = "json")]
mod table;

pub use harmonic::{Harmonic, accelerogram, to_csv};
#[cfg(feature = "json")]
pub use table::{read, read_particles};
