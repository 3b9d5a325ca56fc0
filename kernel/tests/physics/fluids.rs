//! Fluids in the cycle: at rest under their weight, and the step that viscosity leaves.

use crate::common::{SCHEMES, body, cuboid, empty, material, options, rough, simulation};
use proctor_laws::{Bingham, EquationOfState, Newtonian};
use proctor_scene::simulation::{Bound, Simulation};
use proctor_scene::{
    Dimension, DomainUpdate, InitialStress, PlaneCondition, Scene, StressScheme, TimeStep,
    Weighting,
};

const DENSITY: f64 = 1000.0;
const BULK: f64 = 1.0e6;
const GRAVITY: f64 = 10.0;
const CELL: f64 = 0.1;

/// A basin filled up to 0.3 m, at the pressure of its depth.
fn basin(dimension: Dimension, exponent: f64) -> Scene {
    let axes = dimension.axes();
    let mut scene = empty(dimension, [4; 3], CELL);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity[axes - 1] = -GRAVITY;
    let mut upper = [4.0 * CELL; 3];
    upper[axes - 1] = 3.0 * CELL;
    upper[axes..].fill(0.0);
    let mut water = body(1, cuboid([0.0; 3], upper));
    water.particles_per_cell[axes..].fill(1);
    water.initial_stress = InitialStress::AtRest {
        ratio: 1.0,
        level: 3.0 * CELL,
        surcharge: 0.0,
    };
    scene.bodies = vec![water];
    let state = EquationOfState {
        bulk: BULK,
        exponent,
        carries_tension: true,
    };
    let mut fluid = material(Newtonian::new(BULK, 0.0).with_state(state));
    fluid.density = DENSITY;
    scene.materials = vec![fluid];
    scene
}

/// The density of a scene is that of the body as it lies there, and the pressure is that of the start: weight and pressure
/// balance at every node to round-off, as in ground at rest.
#[test]
fn water_at_rest_stays_there() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for scheme in SCHEMES {
            for (weighting, exponent) in [
                (Weighting::UniformGimp, 0.0),
                (Weighting::UniformGimp, 7.0),
                (Weighting::ContiguousGimp(DomainUpdate::Determinant), 0.0),
            ] {
                let mut scene = basin(dimension, exponent);
                (scene.scheme, scene.weighting) = (scheme, weighting);
                // Soft enough for its own weight to press it by a tenth.
                for (bulk, limit) in [(BULK, 1e-10), (3e4, 1e-11)] {
                    let state = EquationOfState {
                        bulk,
                        exponent,
                        carries_tension: true,
                    };
                    let own = Newtonian::new(bulk, 0.0).with_state(state);
                    scene.materials[0].law = own.into();
                    stays(&scene, limit);
                    let own = Bingham::new(bulk, 1.0, 1.0, 0.3 * bulk).with_state(state);
                    scene.materials[0].law = own.into();
                    stays(&scene, limit);
                }
            }
        }
    }
}

/// Checks that a basin has the mass and the pressure of its depth, and stays at rest but for a share of a fall.
fn stays(scene: &Scene, limit: f64) {
    let axes = scene.dimension.axes();
    let words = format!(
        "{:?} {:?} {:?}",
        scene.dimension, scene.scheme, scene.materials[0].law
    );
    let mut simulation = Simulation::new(scene, &options()).expect("it is sound");
    let filled = DENSITY * 3.0 * CELL * (4.0 * CELL).powi(axes as i32 - 1);
    assert!((simulation.mass() / filled - 1.0).abs() < 1e-12, "{words}");
    let stored = simulation.strain_energy();
    assert!(stored > 0.0);
    for _ in 0..50 {
        simulation.step(f64::INFINITY).expect("a step");
    }
    let fall = GRAVITY * simulation.time();
    let set = &simulation.sets()[0];
    let speed = (0..set.len()).flat_map(|p| set.velocity(p));
    let speed = speed.map(f64::abs).fold(0.0, f64::max);
    assert!(speed < limit * fall, "{words}: {speed} m/s of {fall}");
    for p in 0..set.len() {
        let exact = DENSITY * GRAVITY * (3.0 * CELL - set.position(p)[axes - 1]);
        for s in &set.stress(p)[..3] {
            assert!((s + exact).abs() < 1e-9 * exact, "{words}: {s} {exact}");
        }
    }
    let change = simulation.strain_energy() / stored - 1.0;
    assert!(change.abs() < 1e-9, "{words}: {change}");
}

/// A pressed fluid has the energy of its pressure, and the waves of it at the first step too, c² = (K + n p)/rho with the
/// density of the scene.
#[test]
fn a_pressed_fluid_has_the_waves_and_the_energy_of_its_pressure() {
    let pressure = 0.3 * BULK;
    let mut scene = block(Dimension::Two, 0.0, 0.0);
    scene.bodies[0].initial_stress = InitialStress::Isotropic(-pressure);
    let state = EquationOfState {
        bulk: BULK,
        exponent: 7.0,
        carries_tension: true,
    };
    let own = Newtonian::new(BULK, 0.0).with_state(state);
    scene.materials[0].law = own.into();
    let mut simulation = simulation(&scene);
    let stored = simulation.strain_energy();
    let j = state.volume_ratio(-pressure);
    let exact = state.energy_density(j) * 16.0 * CELL * CELL / j;
    assert!((stored / exact - 1.0).abs() < 1e-12, "{stored} {exact}");
    let found = simulation.step(f64::INFINITY).expect("a step").dt_critical;
    let speed = ((BULK + 7.0 * pressure) / DENSITY).sqrt();
    let exact = simulation.stability_number() * CELL / speed;
    assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
}

/// A free block of a viscous fluid that ends beyond lines of the mesh by some cells.
fn block(dimension: Dimension, viscosity: f64, beyond: f64) -> Scene {
    let axes = dimension.axes();
    let mut scene = empty(dimension, [8; 3], CELL);
    let (mut lower, mut upper) = ([(2.0 - beyond) * CELL; 3], [(6.0 + beyond) * CELL; 3]);
    lower[axes..].fill(0.0);
    upper[axes..].fill(0.0);
    let mut one = body(1, cuboid(lower, upper));
    one.particles_per_cell[axes..].fill(1);
    scene.bodies = vec![one];
    let mut fluid = material(Newtonian::new(BULK, viscosity));
    fluid.density = DENSITY;
    scene.materials = vec![fluid];
    scene
}

/// Kinetic energy over that of the start after some steps of a share of the step that the kernel calls critical, where each
/// particle begins with a small velocity of its own.
fn growth(scene: &Scene, share: f64, steps: usize) -> f64 {
    let mut first = simulation(scene);
    let critical = first.step(f64::INFINITY).expect("a step").dt_critical;
    let mut scene = scene.clone();
    scene.time_step = TimeStep::Fixed {
        dt: share * critical,
        allow_unstable: true,
    };
    let mut options = options();
    options.initial = Some(rough(scene.dimension, 1e-9, 0.0, 1));
    let mut simulation = Simulation::new(&scene, &options).expect("it is sound");
    let start = simulation.kinetic_energy();
    for _ in 0..steps {
        if simulation.step(f64::INFINITY).is_err() {
            return f64::INFINITY;
        }
    }
    simulation.kinetic_energy() / start
}

/// With viscosity small, equal to and large against c h rho: stable at the step that the kernel calls critical, and
/// unstable at twice that.
#[test]
fn viscosity_bounds_the_step() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for scheme in [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl] {
            for viscosity in [30.0, 3.0e3, 1.0e5] {
                // The nodes behind the lines have the least mass, and are the first to become unstable.
                let mut scene = block(dimension, viscosity, 1e-6);
                scene.scheme = scheme;
                let mut one = simulation(&scene);
                let bound = one.step(f64::INFINITY).expect("a step").bound;
                assert_eq!(bound, Bound::Viscosity);
                let held = growth(&scene, 1.0, 400);
                assert!(held < 1.0, "{dimension:?} {scheme:?} {viscosity}: {held}");
                let lost = growth(&scene, 2.0, 400);
                assert!(lost > 1.0, "{dimension:?} {scheme:?} {viscosity}: {lost}");
            }
        }
    }
}
