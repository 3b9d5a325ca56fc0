//! Mass and momentum over whole steps of a body that touches no plane.

use crate::common::{
    DIMENSIONS, FLIP, NEO_HOOKEAN, TRANSFERS, block, material, momentum_scale, rough, run,
    simulation_from, weightings_and_schemes,
};
use proctor_scene::Weighting;
use proptest::prelude::*;

proptest! {
    #![proptest_config(crate::common::cases(6))]

    #[test]
    fn momentum_of_a_stressed_body_stays(seed in 0_u64..1_000_000, transfer in 0_usize..4, origin in prop_oneof![Just(0.0), Just(1.0e6)]) {
        for dimension in DIMENSIONS {
            for (weighting, scheme) in weightings_and_schemes() {
                let mut scene = block(dimension);
                scene.weighting = weighting;
                scene.scheme = scheme;
                scene.transfer = TRANSFERS[transfer];
                crate::common::calm(&mut scene);
                for axis in 0..2 {
                    scene.mesh.origin[axis] += origin;
                }
                let proctor_scene::Shape::Cuboid { p1, p2 } = &mut scene.bodies[0].shape else {
                    unreachable!("block() is a cuboid")
                };
                for axis in 0..2 {
                    p1[axis] += origin;
                    p2[axis] += origin;
                }
                // 1 m/s and 1e4 Pa: 3 % of the wave speed and 1 % of the modulus, rough from particle to
                // particle.
                let mut simulation = simulation_from(&scene, rough(dimension, 1.0, 1.0e4, seed));
                let (mass, before) = (simulation.mass(), simulation.momentum());
                let steps = 3;
                run(&mut simulation, steps);
                let scale = momentum_scale(&simulation);
                prop_assert_eq!(simulation.mass(), mass);
                let after = simulation.momentum();
                for axis in 0..3 {
                    // 1e-14 per step of the sum of m |v|.
                    prop_assert!(
                        (after[axis] - before[axis]).abs() <= 1.0e-14 * steps as f64 * scale,
                        "{weighting:?} {scheme:?} {before:?} {after:?} scale {scale}"
                    );
                }
            }
        }
    }
}

/// Forces must have acted, or the test above would hold for a code that does nothing.
#[test]
fn the_stressed_body_moves() {
    for dimension in DIMENSIONS {
        let mut simulation = simulation_from(&block(dimension), rough(dimension, 0.0, 1.0e4, 1));
        run(&mut simulation, 1);
        // dv = f dt/2 / m is about sigma/(h rho) dt/2, 5e-2 m/s here.
        assert!(momentum_scale(&simulation) > 1.0e-3 * simulation.mass());
    }
}

/// Without boundary the neo-Hookean law keeps momentum too; its stress comes from F alone.
#[test]
fn momentum_of_a_neo_hookean_body_stays() {
    for dimension in DIMENSIONS {
        let mut scene = block(dimension);
        scene.materials = vec![material(NEO_HOOKEAN)];
        scene.weighting = Weighting::QuadraticBSpline;
        scene.transfer = FLIP;
        let mut simulation = simulation_from(&scene, rough(dimension, 1.0, 0.0, 7));
        let before = simulation.momentum();
        run(&mut simulation, 40);
        assert!(simulation.strain_energy() > 0.0);
        let (after, scale) = (simulation.momentum(), momentum_scale(&simulation));
        for axis in 0..3 {
            assert!((after[axis] - before[axis]).abs() <= 40.0e-14 * scale);
        }
    }
}
