//! The box under a surface load.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Boussinesq;

#[test]
fn gates_hold() {
    holds(&Boussinesq::GIVEN);
}

#[test]
fn a_reference_with_another_poissons_ratio_is_noticed() {
    let wrong = Boussinesq {
        reference_poisson: 0.28,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    for variant in ["patch", "node"] {
        for gate in ["error of u_z", "observed order"] {
            assert!(
                failing
                    .iter()
                    .any(|f| f.starts_with(variant) && f.contains(gate)),
                "{variant}, {gate} not in {failing:?}"
            );
        }
    }
}
