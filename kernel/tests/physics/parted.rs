//! Matter that parts in the cycle: water without tension that splashes, sand that is dropped.

use crate::common::{APIC, body, cuboid, empty, material, options};
use proctor_kernel::layout::Layout;
use proctor_laws::{AnyLaw, ConeMatch, DruckerPrager, EquationOfState, MohrCoulomb, Newtonian};
use proctor_scene::simulation::Simulation;
use proctor_scene::{Dimension, DomainUpdate, PlaneCondition, Scene, Weighting};

const BULK: f64 = 2e6;
const DENSITY: f64 = 1000.0;

/// A block of water that falls into a corner at a speed.
fn splash(speed: f64, exponent: f64, viscosity: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [30, 30, 1], 0.04);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity = [0.0, -9.8, 0.0];
    scene.transfer = APIC;
    let mut block = body(1, cuboid([0.2, 0.2, 0.0], [0.4, 0.4, 0.0]));
    block.velocity = [-speed, -speed, 0.0];
    block.particles_per_cell[2] = 1;
    scene.bodies = vec![block];
    let state = EquationOfState {
        bulk: BULK,
        exponent,
        carries_tension: false,
    };
    let mut water = material(Newtonian::new(BULK, viscosity).with_state(state));
    water.density = DENSITY;
    scene.materials = vec![water];
    scene
}

/// Water that has parted has the waves of water at rest: no step is shorter than speeds and pressure ask for, however far its
/// particles fly apart.
#[test]
fn a_splash_takes_the_steps_of_water_at_rest() {
    for (speed, exponent, viscosity) in [(2.0, 0.0, 0.0), (4.0, 0.0, 0.0), (3.0, 7.0, 1.0)] {
        let scene = splash(speed, exponent, viscosity);
        let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
        let first = simulation.step(f64::INFINITY).expect("a step").dt;
        let (mut steps, mut shortest) = (0, f64::INFINITY);
        while simulation.time() < 0.3 {
            let info = simulation.step(0.3).expect("a step");
            if info.time < 0.3 {
                shortest = info.dt.min(shortest);
            }
            steps += 1;
        }
        let most = (simulation.sets()[0].columns[Layout::VOLUME].iter())
            .zip(&simulation.sets()[0].columns[Layout::MASS])
            .map(|(v, m)| v * DENSITY / m)
            .fold(0.0, f64::max);
        assert!(most > 1.5, "it does not splash: {most}");
        // Under the pressure of the impact, rho c v, and with the speed that it gives.
        assert!(shortest > 0.4 * first, "{speed}: {shortest} {first}");
        assert!(f64::from(steps) < 1.6 * 0.3 / first, "{speed}: {steps}");
    }
}

/// Domains of particles without pressure do not grow: a splash stops no run.
#[test]
fn domains_of_what_has_parted_stay() {
    for update in [
        DomainUpdate::Determinant,
        DomainUpdate::Stretch,
        DomainUpdate::LeftStretch,
    ] {
        let mut scene = splash(3.0, 0.0, 0.0);
        scene.weighting = Weighting::ContiguousGimp(update);
        let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
        let end = if update == DomainUpdate::Determinant {
            0.3
        } else {
            // Shear of water under pressure stretches domains for good.
            0.05
        };
        simulation.run_until(end).expect("a step");
    }
}

/// Sand that falls into a box comes to rest at its own volume, within 3 %.
#[test]
fn dropped_sand_rests_at_its_own_volume() {
    let (young, poisson) = (1e6, 0.3);
    let laws: [AnyLaw; 2] = [
        MohrCoulomb::new(young, poisson, [30.0, 0.0, 0.0]).into(),
        DruckerPrager::new(young, poisson, [30.0, 0.0, 0.0], ConeMatch::PlaneStrain).into(),
    ];
    for law in laws {
        let mut scene = empty(Dimension::Two, [8, 14, 1], 0.1);
        scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
        scene.gravity = [0.0, -9.81, 0.0];
        scene.transfer = APIC;
        let mut sand = body(1, cuboid([0.1, 0.4, 0.0], [0.6, 1.0, 0.0]));
        sand.particles_per_cell[2] = 1;
        scene.bodies = vec![sand];
        let mut ground = material(law.clone());
        ground.density = 1600.0;
        scene.materials = vec![ground];
        let mut simulation = Simulation::new(&scene, &options()).expect("it is sound");
        let volume = |simulation: &Simulation| -> f64 {
            simulation.sets()[0].columns[Layout::VOLUME].iter().sum()
        };
        let before = volume(&simulation);
        simulation.run_until(2.0).expect("a step");
        let after = volume(&simulation) / before;
        assert!((after - 1.0).abs() < 0.03, "{law:?}: {after}");
        assert!(simulation.kinetic_energy() < 1.0, "{law:?}");
    }
}
