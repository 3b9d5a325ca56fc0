//! The indenter in the block.

use super::{failing, holds, solve};
use proctor_kernel::scene::read;
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::Ironing;
use std::path::Path;

#[test]
fn gates_hold() {
    holds(&Ironing::GIVEN);
}

#[test]
fn a_wrong_reference_breaks_every_gate() {
    let wrong = Ironing {
        reference_force: 1.15,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    assert_eq!(failing(&verdict).len(), verdict.gates.len(), "{verdict:?}");
}

#[test]
fn the_scene_file_is_the_case_with_friction() {
    let file = Path::new("../fixtures/scenes/ironing_2d.json");
    let given = read(file).unwrap_or_else(|e| panic!("{e}"));
    let rungs = Ironing::GIVEN.rungs(Size::Full);
    let rung = rungs.iter().find(|r| r.variant == "600 Pa, friction");
    let meant = Ironing::GIVEN.scene(rung.expect("a rung"));
    let said = |scene: &proctor_kernel::scene::Scene| {
        let contact = &scene.mortar.contacts[0];
        format!(
            "{} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
            scene.time,
            scene.mesh,
            scene.weighting,
            scene.scheme,
            scene.transfer,
            scene.damping,
            scene.time_step,
            scene.bodies,
            scene.mortar.boundaries,
            (contact.master, contact.slave, contact.friction),
            (
                contact.critical_gap,
                contact.normal_stiffness,
                contact.tangential_stiffness
            ),
        )
    };
    assert_eq!(said(&given), said(&meant));
    let [given, meant] = [&given, &meant].map(|scene| &scene.mortar.lines[0]);
    let [points, exact] = [given, meant].map(|line| &line.chains[0].points);
    assert_eq!(points.len(), exact.len());
    for (a, b) in points.iter().zip(exact) {
        assert!((a - b).norm() < 1e-8, "{a} {b}");
    }
    let [motion, exact] = [given, meant].map(|line| line.motion.as_ref().expect("moves"));
    assert_eq!(motion.times, exact.times);
    for (a, b) in motion.values.iter().zip(&exact.values) {
        for axis in 0..3 {
            assert!((a[axis] - b[axis]).abs() < 1e-8, "{a:?} {b:?}");
        }
    }
}
