//! The cases: one small file each.

mod boussinesq;
mod statics;

pub use boussinesq::Boussinesq;

use crate::case::{Case, CaseError, Rung};

/// All cases, in the order in which they are shown.
pub(crate) static ALL: &[&dyn Case] = &[&Boussinesq::GIVEN];

/// An error of a rung.
fn failed(case: &dyn Case, rung: &Rung, reason: &dyn std::fmt::Display) -> CaseError {
    CaseError {
        case: case.name(),
        rung: rung.label.clone(),
        reason: reason.to_string(),
    }
}
