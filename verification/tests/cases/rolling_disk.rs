//! The disk on the inclined plane.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::RollingDisk;

#[test]
fn gates_hold() {
    holds(&RollingDisk::GIVEN);
}

/// Twice the bound on the way of the disk that sticks, four times that of the one that slips; the ratio of turn and way
/// does not depend on gravity where friction does.
#[test]
fn a_wrong_reference_breaks_the_gates_on_the_way() {
    let wrong = RollingDisk {
        reference_gravity: 1.04,
        ..RollingDisk::GIVEN
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 2, "{failing:?}");
    let on_way = |line: &String| line.contains("error of the way");
    assert!(failing.iter().all(on_way), "{failing:?}");
}

/// A disk that sticks without creep is not the reference: the gate on its turn notices 3 %.
#[test]
fn a_disk_that_does_not_creep_breaks_the_gate_on_the_turn() {
    let mut solved = solve(&RollingDisk::GIVEN);
    let stick = solved.iter_mut().find(|(r, _)| r.variant == "stick");
    let (_, run) = stick.expect("a disk that sticks");
    let turn = run
        .quantities
        .iter_mut()
        .find(|q| q.name.starts_with("turn"));
    let turn = turn.expect("its turn");
    let creeping = turn.exact.expect("known");
    turn.value = 1.0;
    turn.error = Some((turn.value / creeping - 1.0).abs());
    let failing = failing(&RollingDisk::GIVEN.judge(Size::Quick, &solved));
    assert_eq!(failing.len(), 1, "{failing:?}");
    assert!(failing[0].starts_with("stick") && failing[0].contains("turn"));
}
