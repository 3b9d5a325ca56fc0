//! The monitor: energies, momenta, extremes and faults of a run, and the quality of its results.

pub(super) mod energy;
mod extremes;
mod faults;
mod initial_imbalance;
pub(super) mod invariants;
pub(super) mod measure;
pub(super) mod result_quality;
mod spin;
