//! Error against run time: every case with an exact solution, solved with many settings.

pub mod bounds;
pub mod choices;
pub mod cost;
pub mod costs;
pub mod findings;
pub mod peers;
pub mod problems;
pub mod rows;
pub mod run;

pub use choices::{Effort, Line, Plan};
pub use findings::Findings;
mod forms;

pub use peers::{Peer, PeerLine, PeerRun};
pub use run::{CaseStudy, Run, RunNumbers, Sample};
