//! Accelerograms and particle lists: tables of numbers in text files.

mod harmonic;
mod table;

pub use harmonic::{Harmonic, accelerogram, to_csv};
pub(crate) use table::Table;
pub use table::{read, read_particles};
