//! Sums over particles: exact but for one rounding, whatever the order of storage and the number of threads.

use crate::common::{DIMENSIONS, body, cuboid, elastic, empty, material, options, run};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_scene::prelude::*;

/// Two blocks that meet in flight, so that particles are sorted and strained.
fn meeting(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [20; 3], 0.1);
    let (low, high) = ([0.3; 3], [0.8, 1.0, 0.9]);
    let mut left = body(1, cuboid(low, high));
    let mut right = body(2, cuboid([0.8, 0.5, 0.3], [1.4, 1.2, 0.9]));
    left.velocity = [3.0, 0.7, 0.0];
    right.velocity = [-2.0, 0.1, 0.0];
    scene.bodies = vec![left, right];
    scene.materials = vec![material(elastic(1e5, 0.3))];
    scene.gravity = [0.0, -10.0, 0.0];
    scene
}

fn flown(scene: &Scene, threads: usize) -> Simulation {
    let all = Options {
        threads: Some(threads),
        least_share: Some(1),
        ..options()
    };
    let mut simulation = Simulation::new(scene, &all).expect("a sound scene");
    run(&mut simulation, 60);
    simulation
}

/// The sum of numbers between 2^-50 and 2^16 by whole numbers, rounded once.
fn by_whole_numbers(terms: impl Iterator<Item = f64>) -> f64 {
    let unit = 2.0_f64.powi(-105);
    terms.map(|x| (x / unit) as i128).sum::<i128>() as f64 * unit
}

#[test]
fn a_sum_is_rounded_once() {
    for dimension in DIMENSIONS {
        let simulation = flown(&meeting(dimension), 1);
        let of = |term: &dyn Fn(&ParticleSet, usize) -> f64| {
            let sets = simulation.sets().iter();
            by_whole_numbers(sets.flat_map(|set| (0..set.len()).map(move |p| term(set, p))))
        };
        let mass = |set: &ParticleSet, p: usize| set.columns[Layout::MASS][p];
        assert_eq!(simulation.mass().to_bits(), of(&mass).to_bits());
        for axis in 0..dimension.axes() {
            let momentum = of(&|set, p| mass(set, p) * set.velocity(p)[axis]);
            assert_eq!(simulation.momentum()[axis].to_bits(), momentum.to_bits());
        }
        let kinetic = of(&|set, p| {
            let v = set.velocity(p);
            0.5 * mass(set, p) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
        });
        assert_eq!(simulation.kinetic_energy().to_bits(), kinetic.to_bits());
    }
}

#[test]
fn threads_change_no_bit_of_a_sum() {
    for dimension in DIMENSIONS {
        let scene = meeting(dimension);
        let sums = |threads: usize| {
            let mut simulation = flown(&scene, threads);
            let (energy, center) = (simulation.energy(), simulation.center(1));
            let all = [
                energy.kinetic,
                energy.strain,
                energy.external_work,
                energy.remainder,
                center.mass,
                center.position[0],
                center.velocity[1],
                simulation.momentum()[0],
                simulation.invariants().gain,
                simulation.invariants().lost_momentum,
            ];
            all.map(f64::to_bits)
        };
        let alone = sums(1);
        for threads in [2, 3, 5] {
            assert_eq!(sums(threads), alone, "{dimension:?}, {threads} threads");
        }
    }
}
