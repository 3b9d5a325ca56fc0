//! The sphere on a terrain.

use super::{failing, holds};
use proctor_scene::Scene;
use proctor_scene::simulation::Options;
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::SphereOnTerrain;

#[test]
fn gates_hold() {
    holds(&SphereOnTerrain::GIVEN);
}

/// A wrong gravity changes the fall and the momentum that the weight gives.
#[test]
fn a_wrong_scene_breaks_the_gates_on_motion() {
    let wrong = SphereOnTerrain { pull: 1.01 };
    let rung = wrong
        .rungs(Size::Quick)
        .into_iter()
        .find(|rung| rung.variant == "smooth USF")
        .expect("a smooth terrain");
    let solved = wrong
        .solve(&rung, &Options::default(), &mut |_| ())
        .expect("it runs");
    let verdict = wrong.judge(Size::Quick, &[(rung.clone(), solved)]);
    let failing: Vec<String> = failing(&verdict)
        .into_iter()
        .filter(|line| line.starts_with(&rung.label))
        .collect();
    for name in ["fall until touch", "momentum", "energy"] {
        assert!(
            failing.iter().any(|line| line.contains(name)),
            "{name}: {failing:?}"
        );
    }
}

/// The scene is that of the fixture but for its end and what it writes.
#[test]
fn the_scene_is_that_of_the_file() {
    let path = "../fixtures/scenes/sphere_on_terrain.json";
    let file = proctor_files::json::read(std::path::Path::new(path)).expect("it is sound");
    let case = SphereOnTerrain::GIVEN;
    let own = case.scene(&case.rungs(Size::Quick)[0]);
    let physics = |s: &Scene| {
        (
            (s.time, s.time_step, s.gravity, s.mesh.clone()),
            (s.weighting, s.scheme, s.transfer, s.damping),
            s.materials[0].law.clone(),
            s.materials[0].density,
            s.bodies
                .iter()
                .map(|b| (b.shape.clone(), b.particles_per_cell, b.velocity))
                .collect::<Vec<_>>(),
            s.surfaces
                .iter()
                .map(|t| (t.surface.clone(), t.friction, t.distance_threshold))
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(
        format!("{:?}", physics(&own)),
        format!("{:?}", physics(&file))
    );
}
