//! The files a run leaves behind, as plain data in and bytes out.
//!
//! ```text
//! OutputFolder ──► particles_000000.vtu … + particles.pvd   (Series, Frame)
//!              ──► history.csv                              (HistoryWriter)
//!              ──► summary.json                             (Summary)
//!              ──► checkpoint.bin                           (Checkpoint)
//! ```
//!
//! Nothing here knows the simulation: whoever runs it copies its state into these types. Every file is either
//! the old one or the whole new one, whenever the run is killed ([`atomic`]); `history.csv`, which grows line by
//! line, is the one exception, and [`HistoryWriter`] says how it is repaired.

pub mod atomic;
pub mod checkpoint;
pub mod earlier;
mod error;
pub mod history;
mod little_endian;
pub mod pieces;
pub mod pvd;
pub mod summary;
pub mod vtu;

pub use atomic::OutputFolder;
pub use checkpoint::{Checkpoint, CheckpointError};
pub use error::OutputError;
pub use history::HistoryWriter;
pub use pvd::Series;
pub use summary::Summary;
pub use vtu::{Array, ArrayData, Compression, Frame};
