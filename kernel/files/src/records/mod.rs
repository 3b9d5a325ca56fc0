//! Accelerograms and particle lists: tables of numbers in text files.

mod harmonic;
mod particles;
mod table;

pub use harmonic::{Harmonic, accelerogram, to_csv};
pub use particles::read_particles;
pub(crate) use table::Table;
pub use table::read;
