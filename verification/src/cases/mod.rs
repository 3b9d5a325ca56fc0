//! The cases: one small file each.

mod base_acceleration;
mod boussinesq;
mod hertz;
mod rolling_disk;
mod statics;

pub use base_acceleration::BaseAcceleration;
pub use boussinesq::Boussinesq;
pub use hertz::Hertz;
pub use rolling_disk::RollingDisk;

use crate::case::{Case, CaseError, Rung, Solved};
use crate::convergence::{ConvergenceTable, Row};
use proctor_kernel::scene::{Law, Material, ObjectiveRate};

/// All cases, in the order in which they are shown.
pub(crate) static ALL: &[&dyn Case] = &[
    &Boussinesq::GIVEN,
    &BaseAcceleration::GIVEN,
    &Hertz::GIVEN,
    &RollingDisk::GIVEN,
];

/// An error of a rung.
fn failed(case: &dyn Case, rung: &Rung, reason: &dyn std::fmt::Display) -> CaseError {
    CaseError {
        case: case.name(),
        rung: rung.label.clone(),
        reason: reason.to_string(),
    }
}

/// Errors of the named quantities over the rungs of a variant, coarse to fine.
fn table(solved: &[(Rung, Solved)], variant: &str, names: &[&'static str]) -> ConvergenceTable {
    let mut table = ConvergenceTable::new(names.iter().copied());
    for (rung, solved) in solved.iter().filter(|(rung, _)| rung.variant == variant) {
        let row = Row {
            h: rung.cell,
            errors: names.iter().map(|name| solved.error(name)).collect(),
            particles: solved.particles,
            steps: solved.steps as usize,
        };
        // One error per name, by construction.
        let _ = table.push(row);
    }
    table
}

/// The one linear elastic material of a case \[kg/m³, Pa\].
fn elastic(density: f64, young: f64, poisson: f64) -> Vec<Material> {
    vec![Material {
        name: "elastic".to_owned(),
        id: 1,
        density,
        law: Law::LinearElastic {
            young,
            poisson,
            rate: ObjectiveRate::HughesWinget,
        },
    }]
}
