//! Stability of each method: the map and the scenes that are not linear, run side by side, as rows and as a picture; and the
//! stiff and extreme scenes.

mod detail;
pub mod extreme;
mod rows;
mod run;

pub use detail::{StabilityCell, StabilityDetail};
pub use extreme::ExtremeDetail;
pub use run::{Job, JobResult, MapRequest, Outcome, jobs, round_jobs, run};
