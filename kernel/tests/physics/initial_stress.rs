//! Bodies that have a stress at the start.

use crate::common::{body, cuboid, empty, material, options};
use proctor_laws::{LinearElastic, MohrCoulomb, NeoHookean, VonMises};
use proctor_scene::simulation::{SetupError, Simulation};
use proctor_scene::{Dimension, InitialStress, PlaneCondition, Scene, StressScheme, Weighting};

const RATIO: f64 = 0.5;
const GRAVITY: f64 = 10.0;

/// Cells of the mesh of each axis, and of the ground along gravity.
const CELLS: usize = 4;
const HIGH: usize = 3;
const CELL: f64 = 0.1;
/// Upper end of the ground [m].
const LEVEL: f64 = HIGH as f64 * CELL;

fn at_rest(ratio: f64, surcharge: f64) -> InitialStress {
    InitialStress::AtRest {
        ratio,
        level: LEVEL,
        surcharge,
    }
}

/// Ground on a floor between walls, under its weight.
fn ground(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [CELLS; 3], CELL);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    let axes = dimension.axes();
    scene.gravity[axes - 1] = -GRAVITY;
    let mut upper = [CELLS as f64 * CELL; 3];
    upper[axes - 1] = LEVEL;
    upper[axes..].fill(0.0);
    let mut ground = body(1, cuboid([0.0; 3], upper));
    ground.particles_per_cell[axes..].fill(1);
    ground.initial_stress = at_rest(RATIO, 0.0);
    scene.bodies = vec![ground];
    scene
}

/// Fault of a scene.
fn wrong(scene: &Scene) -> String {
    scene.check().expect_err("it is not sound").to_string()
}

/// Ground at rest stays there: weight and stress balance at every node, with domains of particles to round-off. B-splines
/// take the stress at the particle alone, and are left with an error of that sum.
#[test]
fn ground_at_rest_stays_there() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
            for (weighting, most) in [
                (Weighting::UniformGimp, 1e-12),
                (Weighting::QuadraticBSpline, 5e-3),
            ] {
                let mut scene = ground(dimension);
                scene.scheme = scheme;
                scene.weighting = weighting;
                let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
                let strain = simulation.strain_energy();
                assert!(strain > 0.0);
                for _ in 0..50 {
                    simulation.step(f64::INFINITY).expect("a step");
                }
                let fall = GRAVITY * simulation.time();
                let speed = (0..simulation.sets()[0].len())
                    .flat_map(|p| simulation.sets()[0].velocity(p))
                    .fold(0.0_f64, |most, v| most.max(v.abs()));
                assert!(
                    speed < most * fall,
                    "{dimension:?} {scheme:?} {weighting:?}: {speed:e}"
                );
            }
        }
    }
}

/// The stress is what the weight above and the pressure on top make it, and a share of that across.
#[test]
fn stress_grows_with_depth() {
    let mut scene = ground(Dimension::Two);
    scene.bodies[0].initial_stress = at_rest(RATIO, 7.0);
    let density = scene.materials[0].density;
    let simulation = Simulation::new(&scene, &options()).expect("it is sound");
    let set = &simulation.sets()[0];
    for p in 0..set.len() {
        let depth = LEVEL - set.position(p)[1];
        let along = -(7.0 + density * GRAVITY * depth);
        let s = set.stress(p);
        for (found, exact) in s
            .iter()
            .zip([RATIO * along, along, RATIO * along, 0.0, 0.0, 0.0])
        {
            assert!(
                (found - exact).abs() <= 1e-12 * along.abs(),
                "{s:?} at {depth}"
            );
        }
    }
}

/// A stress that a material does not bear is refused with the worst point, and one that it bears just so is not.
#[test]
fn a_stress_beyond_the_yield_surface_is_refused() {
    let mut scene = ground(Dimension::Three);
    // Friction of 30 degrees bears an earth pressure of a third of the weight, and no less.
    scene.materials = vec![material(MohrCoulomb::new(1e4, 0.3, [30.0, 0.0, 0.0]))];
    let with = |ratio: f64| {
        let mut scene = scene.clone();
        scene.bodies[0].initial_stress = at_rest(ratio, 0.0);
        Simulation::new(&scene, &options()).map(|_| ())
    };
    assert!(with(1.0 / 3.0).is_ok());
    assert!(with(2.0).is_ok());
    let Err(SetupError::Load { path, reason }) = with(0.2) else {
        panic!("a fifth is too little");
    };
    assert_eq!(path, "bodies[0].initial_stress");
    assert!(reason.contains("beyond the yield surface"), "{reason}");
    // The worst point is at the bottom.
    let lowest = 0.25 * CELL;
    assert!(reason.contains(&format!("{lowest}) m")), "{reason}");
    assert!(with(4.0).is_err());
}

#[test]
fn an_initial_stress_that_cannot_be_is_refused() {
    let mut finite = ground(Dimension::Two);
    finite.materials = vec![material(NeoHookean::new(1e4, 0.3))];
    assert!(wrong(&finite).contains("neo_hookean material"));
    let mut sideways = ground(Dimension::Two);
    sideways.gravity = [1.0, -1.0, 0.0];
    assert!(wrong(&sideways).contains("along one axis"));
    let mut endless = ground(Dimension::Two);
    endless.bodies[0].initial_stress = InitialStress::Isotropic(f64::INFINITY);
    assert!(wrong(&endless).contains("initial_stress.value"));
    let mut soft = ground(Dimension::Two);
    soft.materials = vec![material(VonMises::new(1e4, 0.3, 1.0, 0.0))];
    soft.bodies[0].initial_stress = InitialStress::Isotropic(-1e3);
    assert!(
        Simulation::new(&soft, &options()).is_ok(),
        "pressure alone never yields it"
    );
    let mut elastic = ground(Dimension::Two);
    elastic.materials = vec![material(LinearElastic::new(1e4, 0.3))];
    assert!(Simulation::new(&elastic, &options()).is_ok());
}
