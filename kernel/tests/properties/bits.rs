//! Equal bits: whatever the number of threads, the lanes, and the order in which particles are given.

use crate::common::{
    DIMENSIONS, FLIP, NEVER, SCHEMES, WEIGHTINGS, block, body, cuboid, elastic, empty, lanes,
    light_nodes_act, material, noise, options, particles, rough, rough_drift, transfers_of,
};
use proctor_kernel::lanes::LaneChoice;
use proctor_laws::NeoHookean;
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{
    BoxLoad, Contact, ContactNormal, Damping, Dimension, ParticleSeed, Permeability,
    PlaneCondition, PoreWater, Scene, Shape, StressScheme, Transfer, VolumetricStrain, Weighting,
};
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
        material(NeoHookean::new(young, 0.3)),
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
        least_share: Some(1),
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
                for transfer in transfers_of(weighting) {
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

/// The same with water in the pores, whose stages are of their own.
#[test]
fn threads_and_lanes_change_no_bit_of_water() {
    let lanes = lanes();
    for (index, dimension) in DIMENSIONS.into_iter().enumerate() {
        for scheme in [StressScheme::Usl, StressScheme::Musl] {
            for average in [VolumetricStrain::Particle, VolumetricStrain::CellAverage] {
                let mut scene = strip(dimension, Weighting::UniformGimp, scheme, FLIP);
                scene.volumetric_strain = average;
                scene.water_planes = scene.mesh.planes;
                // As soft as the skeleton, so that particles cross cells.
                let water = |density: f64| PoreWater {
                    porosity: 0.6,
                    grain_density: density,
                    density,
                    bulk: 500.0,
                    conductivity: [0.1, 0.2, 0.3],
                    permeability: Permeability::KozenyCarman,
                    conductivity_gravity: 10.0,
                };
                let waters = scene.materials.iter().map(|m| Some(water(m.density)));
                scene.pore_water = waters.collect();
                scene.transfer.pic_fraction = 0.01;
                let expected = hash(&scene, 1, LaneChoice::Auto);
                for &choice in &lanes {
                    assert_eq!(hash(&scene, 1, choice), expected, "{choice:?} {scene:?}");
                }
                for threads in [2, 3, 5] {
                    let choice = lanes[(index + threads) % lanes.len()];
                    let found = hash(&scene, threads, choice);
                    assert_eq!(found, expected, "{threads} {choice:?} {scene:?}");
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

/// Particles of a list in an order of its own for each seed.
fn shuffled(seeds: &[ParticleSeed], seed: u64) -> Vec<ParticleSeed> {
    let mut list = seeds.to_vec();
    list.sort_by(|a, b| noise(&a.position, seed).total_cmp(&noise(&b.position, seed)));
    list
}

/// The state by position at the start, after some steps from a rough start in which what lies right of x = 0.61 m flies
/// left. Bodies of a pair must have met by then.
fn permuted(scene: &Scene, lists: &[Vec<ParticleSeed>]) -> Vec<Vec<u64>> {
    let start: Vec<[f64; 3]> = lists.iter().flatten().map(|s| s.position).collect();
    let still = rough(scene.dimension, 0.5, 1.0e3, 5);
    let initial: InitialField = Arc::new(move |x| {
        let mut state = still(x);
        if x[0] > 0.61 {
            state.velocity[0] -= 4.0;
        }
        state
    });
    let all = Options {
        initial: Some(initial),
        ..options()
    };
    let mut simulation = Simulation::new(scene, &all).expect("the scene is sound");
    if scene.contacts.is_empty() {
        crate::common::run_towards(&mut simulation, 40, NEVER);
    } else {
        let mut touched = false;
        while simulation.time() < 0.02 {
            crate::common::run_towards(&mut simulation, 1, 0.02);
            touched |= simulation.contact_force(0) != [0.0; 3];
        }
        assert!(touched, "the bodies do not meet");
    }
    let state = by_start(&simulation, &start);
    assert_eq!(state.len(), start.len());
    state
}

#[test]
fn the_order_of_a_particle_list_changes_no_bit() {
    for dimension in DIMENSIONS {
        let seeds = seeds(dimension);
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                for transfer in transfers_of(weighting) {
                    let mut scene = block(dimension);
                    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                    crate::common::calm(&mut scene);
                    scene.gravity = [40.0, -30.0, 0.0];
                    let mut run = |seed: u64| {
                        let list = shuffled(&seeds, seed);
                        scene.bodies = vec![body(1, Shape::Particles(Arc::new(list.clone())))];
                        permuted(&scene, &[list])
                    };
                    let expected = run(0);
                    for seed in 1..3 {
                        assert!(
                            run(seed) == expected,
                            "{dimension:?} {weighting:?} {scheme:?} {transfer:?}"
                        );
                    }
                }
            }
        }
    }
}

/// Two lists that press on each other, with the bodies in either order too: identifiers of bodies decide in which order
/// pairs act, whatever the numbers of the particles.
#[test]
fn the_order_of_lists_in_contact_changes_no_bit() {
    for dimension in DIMENSIONS {
        let near = seeds(dimension);
        let far: Vec<ParticleSeed> = near
            .iter()
            .map(|seed| {
                let mut seed = *seed;
                seed.position[0] += 0.41;
                seed
            })
            .collect();
        for (index, weighting) in WEIGHTINGS.into_iter().enumerate() {
            for scheme in SCHEMES {
                for transfer in transfers_of(weighting) {
                    let mut scene = block(dimension);
                    scene.mesh.cells[0] = 14;
                    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                    // No step is safe for such an impact where light nodes act.
                    if light_nodes_act(&scene) {
                        continue;
                    }
                    scene.gravity = [0.0, -30.0, 0.0];
                    scene.contacts = vec![Contact {
                        name: "pair".into(),
                        id: 1,
                        friction: 0.3,
                        master: 4,
                        slave: 2,
                        normal: [
                            ContactNormal::Master,
                            ContactNormal::Slave,
                            ContactNormal::Collinear,
                        ][index % 3],
                    }];
                    let mut run = |seed: u64, turned: bool| {
                        let lists = [shuffled(&near, seed), shuffled(&far, seed + 7)];
                        let mut lists = lists.to_vec();
                        let list = |id: i64, of: &[ParticleSeed]| {
                            body(id, Shape::Particles(Arc::new(of.to_vec())))
                        };
                        scene.bodies = vec![list(4, &lists[0]), list(2, &lists[1])];
                        if turned {
                            scene.bodies.reverse();
                            lists.reverse();
                        }
                        permuted(&scene, &lists)
                    };
                    let expected = run(0, false);
                    for (seed, turned) in [(1, false), (2, true)] {
                        assert!(
                            run(seed, turned) == expected,
                            "{dimension:?} {weighting:?} {scheme:?} {transfer:?} {turned}"
                        );
                    }
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
