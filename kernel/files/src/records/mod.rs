//! Accelerograms and particle lists: tables of numbers in text files.

mod harmonic;
mod table;

pub use harmonic::{Harmonic, accelerogram, to_csv};
pub use table::{read, read_particles};
