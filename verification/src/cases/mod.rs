//! The cases: one small file each.

mod base_acceleration;
mod boussinesq;
mod statics;

pub use base_acceleration::BaseAcceleration;
pub use boussinesq::Boussinesq;

use crate::case::{Case, CaseError, Rung};

/// All cases, in the order in which they are shown.
pub(crate) static ALL: &[&dyn Case] = &[&Boussinesq::GIVEN, &BaseAcceleration::GIVEN];

/// An error of a rung.
fn failed(case: &dyn Case, rung: &Rung, reason: &dyn std::fmt::Display) -> CaseError {
    CaseError {
        case: case.name(),
        rung: rung.label.clone(),
        reason: reason.to_string(),
    }
}
