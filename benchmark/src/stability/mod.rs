//! Where each method is stable: the map and the scenes that are not linear, run side by side, as rows and as a picture.

mod detail;
mod rows;
mod run;

pub use detail::{StabilityCell, StabilityDetail};
pub use run::{Asked, Done, Job, Outcome, jobs, run};
