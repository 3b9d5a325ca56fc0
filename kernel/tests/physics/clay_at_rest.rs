//! Clay under the stress of ground at rest: it begins with the preconsolidation of its stress.

use crate::common::{body, cuboid, empty, material, options};
use proctor_laws::CamClay;
use proctor_scene::simulation::Simulation;
use proctor_scene::{Dimension, InitialStress, PlaneCondition, Scene};

/// Ratio of earth pressure at rest of this clay in first compression.
const RATIO: f64 = 0.642_867_258_385_059_3;
const LEVEL: f64 = 0.3;
const CRITICAL: f64 = 1.2;

fn clay() -> CamClay {
    CamClay::new(CRITICAL, 0.1, 0.02, 0.25).at_pressure(1.0)
}

fn ground(law: CamClay) -> Scene {
    let mut scene = empty(Dimension::Two, [4; 3], 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity[1] = -10.0;
    scene.materials = vec![material(law)];
    let mut ground = body(1, cuboid([0.0; 3], [0.4, LEVEL, 0.0]));
    ground.particles_per_cell[2] = 1;
    ground.initial_stress = InitialStress::AtRest {
        ratio: RATIO,
        level: LEVEL,
        surcharge: 0.0,
    };
    scene.bodies = vec![ground];
    scene
}

#[test]
fn preconsolidation_is_that_of_the_stress() {
    for over in [1.0, 1.5] {
        let scene = ground(clay().overconsolidated(over));
        let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
        {
            let set = &simulation.sets()[0];
            let column = set.column("preconsolidation").expect("the variable");
            for p in 0..set.len() {
                let [x, y, z, ..] = set.stress(p);
                let pressure = -(x + y + z) / 3.0;
                let deviator = (x - y).abs();
                let exact = over * (pressure + (deviator / CRITICAL).powi(2) / pressure);
                assert!((column[p] - exact).abs() < 1e-12 * exact);
            }
        }
        for _ in 0..50 {
            simulation.step(f64::INFINITY).expect("a step");
        }
        let fall = 10.0 * simulation.time();
        let set = &simulation.sets()[0];
        let fastest = (0..set.len())
            .flat_map(|p| set.velocity(p))
            .fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(fastest < 1e-10 * fall, "{fastest:e} of {fall:e}");
    }
}

/// The first step is that of the stiffness under the stress, not of the pressure at which no particle is.
#[test]
fn the_first_step_knows_the_stress() {
    let first = |law: CamClay| {
        let mut simulation = Simulation::new(&ground(law), &options()).expect("it is sound");
        simulation.step(f64::INFINITY).expect("a step");
        simulation.time()
    };
    let small = first(clay());
    assert_eq!(small, first(clay().at_pressure(10.0)));
    assert!(small > first(clay().at_pressure(1e5)));
}

#[test]
fn no_stress_and_too_much_are_refused() {
    let mut scene = ground(clay());
    scene.bodies[0].initial_stress = InitialStress::None;
    let refused = |scene: &Scene| {
        let Err(error) = Simulation::new(scene, &options()) else {
            panic!("it was accepted");
        };
        error.to_string()
    };
    let found = refused(&scene);
    assert!(found.contains("neither stiffness nor strength"), "{found}");
    let found = refused(&ground(clay().preconsolidated(10.0)));
    assert!(found.contains("beyond the yield surface"), "{found}");
}
