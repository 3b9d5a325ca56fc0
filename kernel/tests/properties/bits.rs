//! Equal bits: whatever the number of threads, the lanes, and the order in which particles are given.

use crate::common::{
    DIMENSIONS, NEVER, SCHEMES, TRANSFERS, WEIGHTINGS, block, body, cuboid, elastic, empty, lanes,
    light_nodes_act, material, noise, options, particles, rough, rough_drift,
};
use proctor_kernel::lanes::LaneChoice;
use proctor_kernel::scene::{
    BoxLoad, Damping, Dimension, Law, ParticleSeed, PlaneCondition, Scene, Shape, StressScheme,
    Transfer, Weighting,
};
use proctor_kernel::simulation::{Options, Simulation};
use std::sync::Arc;

/// A long strip, thick enough for five slabs of planes, that flies and breathes.
fn strip(
    dimension: Dimension,
    weighting: Weighting,
    scheme: StressScheme,
    transfer: Transfer,
) -> Scene {
    let mut scene = empty(dimension, [60, 7, 6], 0.1);
    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
    scene.bodies = vec![
        body(1, cuboid([0.3, 0.21, 0.2], [2.03, 0.41, 0.4])),
        body(2, cuboid([2.03, 0.21, 0.2], [3.9, 0.41, 0.4])),
    ];
    // Different laws side by side; the fast axis of the second body has one particle per cell. Soft, so that the
    // speed decides the time step and every particle crosses several cells.
    // Softer still where no step is safe.
    let young = if light_nodes_act(&scene) { 1.0 } else { 1.0e3 };
    scene.materials = vec![
        material(elastic(young, 0.3)),
        material(Law::NeoHookean {
            young,
            poisson: 0.3,
        }),
    ];
    scene.bodies[1].material = 1;
    scene.bodies[1].particles_per_cell = [2, 1, 1];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.gravity = [3.0, -10.0, 0.0];
    scene
}

/// Hash after the run, and the number of cells crossed by the first particle.
fn hash(scene: &Scene, threads: usize, lanes: LaneChoice) -> u64 {
    let initial = Some(rough_drift(scene.dimension, [8.0, 1.0, 0.0], 0.1, 1.0, 3));
    let all = Options {
        threads: Some(threads),
        lanes,
        initial,
        ..options()
    };
    let mut simulation = Simulation::new(scene, &all).expect("the scene is sound");
    let cell = |simulation: &Simulation| -> Vec<[i64; 2]> {
        particles(simulation)
            .iter()
            .map(|p| [0, 1].map(|axis| (p.1[axis] / 0.1).floor() as i64))
            .collect()
    };
    let before = cell(&simulation);
    crate::common::run_towards(&mut simulation, 30, NEVER);
    let crossed = before
        .iter()
        .zip(cell(&simulation))
        .filter(|(a, b)| *a != b)
        .count();
    assert!(
        2 * crossed > before.len(),
        "only {crossed} particles crossed a cell"
    );
    simulation.state_hash()
}

#[test]
fn threads_and_lanes_change_no_bit() {
    let lanes = lanes();
    let mut index = 0;
    for dimension in DIMENSIONS {
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                for transfer in TRANSFERS {
                    let mut scene = strip(dimension, weighting, scheme, transfer);
                    // Dampings and particle forces in turn: they take other paths through the mapping.
                    index += 1;
                    scene.damping = match index % 5 {
                        0 => Damping::Local { alpha: 0.2 },
                        1 => Damping::Viscous { alpha: 0.1 },
                        2 => Damping::Kinetic,
                        _ => Damping::None,
                    };
                    if index % 3 == 0 {
                        scene.box_loads = vec![BoxLoad {
                            p1: [0.0; 3],
                            p2: [1.0; 3],
                            force: [0.0, 5.0, 0.0],
                        }];
                    }
                    let expected = hash(&scene, 1, LaneChoice::Auto);
                    // Each thread count with other lanes in turn, and each of the lanes alone.
                    for &choice in &lanes {
                        assert_eq!(hash(&scene, 1, choice), expected, "{choice:?} {scene:?}");
                    }
                    for threads in [2, 3, 5] {
                        let choice = lanes[(index + threads) % lanes.len()];
                        assert_eq!(
                            hash(&scene, threads, choice),
                            expected,
                            "{threads} {choice:?} {scene:?}"
                        );
                    }
                }
            }
        }
    }
}

/// The state of all particles by position at the start, as bits.
fn by_start(simulation: &Simulation, start: &[[f64; 3]]) -> Vec<Vec<u64>> {
    let mut all: Vec<_> = particles(simulation)
        .into_iter()
        .map(|(id, x, v, s)| {
            let state = x
                .iter()
                .chain(&v)
                .chain(&s)
                .map(|c| c.to_bits())
                .collect::<Vec<u64>>();
            (start[id as usize].map(f64::to_bits), state)
        })
        .collect();
    all.sort();
    all.into_iter().map(|(_, state)| state).collect()
}

#[test]
fn the_order_of_a_particle_list_changes_no_bit() {
    for dimension in DIMENSIONS {
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                let mut scene = block(dimension);
                (scene.weighting, scene.scheme) = (weighting, scheme);
                crate::common::calm(&mut scene);
                scene.gravity = [40.0, -30.0, 0.0];
                let seeds = seeds(dimension);
                let mut expected = None;
                for seed in 0..3_u64 {
                    let mut list = seeds.clone();
                    list.sort_by(|a, b| {
                        noise(&a.position, seed).total_cmp(&noise(&b.position, seed))
                    });
                    let start: Vec<[f64; 3]> = list.iter().map(|s| s.position).collect();
                    scene.bodies = vec![body(1, Shape::Particles(Arc::new(list)))];
                    let initial = Some(rough(dimension, 0.5, 1.0e3, 5));
                    let mut simulation = Simulation::new(
                        &scene,
                        &Options {
                            initial,
                            ..options()
                        },
                    )
                    .expect("the scene is sound");
                    crate::common::run_towards(&mut simulation, 40, NEVER);
                    let state = by_start(&simulation, &start);
                    assert_eq!(state.len(), seeds.len());
                    assert_eq!(
                        *expected.get_or_insert_with(|| state.clone()),
                        state,
                        "{weighting:?} {scheme:?}"
                    );
                }
            }
        }
    }
}

/// Particles of different volume at irregular places.
fn seeds(dimension: Dimension) -> Vec<ParticleSeed> {
    let layers = if dimension == Dimension::Two { 1 } else { 6 };
    let mut seeds = vec![];
    for i in 0..7 {
        for j in 0..6 {
            for k in 0..layers {
                let x = [f64::from(i), f64::from(j), f64::from(k)];
                let mut position: [f64; 3] = std::array::from_fn(|axis| {
                    0.25 + 0.05 * x[axis] + 0.02 * noise(&x, axis as u64)
                });
                let mut volume = 0.05 * 0.05 * (1.0 + 0.3 * noise(&x, 9));
                if dimension == Dimension::Two {
                    position[2] = 0.0;
                } else {
                    volume *= 0.05;
                }
                seeds.push(ParticleSeed { position, volume });
            }
        }
    }
    seeds
}
