//! The block on an incline.

use super::{failing, holds, solve};
use proctor_scene::Scene;
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::InclinedBlock;

#[test]
fn gates_hold_and_a_picture_shows_all_frictions() {
    let verdict = holds(&InclinedBlock::GIVEN);
    assert_eq!(verdict.curves.len(), 1);
    let breaks = verdict.curves[0].points.iter().filter(|p| p.exact.is_nan());
    assert_eq!(breaks.count(), 5);
}

/// Gravity along the incline larger by 1/100, twice the bound: it slides faster. What sticks sticks with a little more,
/// too.
#[test]
fn a_wrong_scene_breaks_every_gate_on_sliding() {
    let wrong = InclinedBlock { pull: 1.01 };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    for gate in &verdict.gates {
        let slides = !gate.name.starts_with("stick");
        assert_eq!(gate.passed(), !slides, "{}: {}", gate.name, gate.value);
    }
    assert!(!failing(&verdict).is_empty());
}

/// The printed scene is that of the manual's file.
#[test]
fn the_printed_scene_is_that_of_the_file() {
    let path = "../fixtures/scenes/manual/inclined_block.json";
    let file = proctor_files::json::read(std::path::Path::new(path)).expect("it is sound");
    let case = InclinedBlock::GIVEN;
    let rungs = case.rungs(Size::Full);
    let rung = rungs.iter().find(|r| r.label == "printed h=1 mu=0.5");
    let own = case.scene(rung.expect("it is among the rungs"));
    let physics = |s: &Scene| {
        (
            (s.time, s.time_step, s.gravity, s.mesh.clone()),
            (s.weighting, s.scheme, s.transfer, s.contact_distance),
            s.materials[0].law.clone(),
            s.bodies
                .iter()
                .map(|b| (b.shape.clone(), b.particles_per_cell, b.velocity))
                .collect::<Vec<_>>(),
            s.contacts
                .iter()
                .map(|c| (c.friction, c.master, c.slave, c.normal))
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(
        format!("{:?}", physics(&own)),
        format!("{:?}", physics(&file))
    );
}
