//! Equal bits of contact of every kind: whatever the number of threads and the lanes.

use crate::common::{SCHEMES, TRANSFERS, WEIGHTINGS, lanes, options};
use crate::properties::touching::{Touching, touching};
use proctor_kernel::lanes::LaneChoice;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{StressScheme, Vector};

/// Numbers of threads; a machine need not have so many cores.
const THREADS: [usize; 5] = [1, 2, 3, 4, 8];

/// Result of contact: the hash of the particles, forces on the bodies, and vertices of their boundaries as bits.
fn result(touching: &Touching, threads: usize, lanes: LaneChoice) -> (u64, Vec<[u64; 3]>) {
    let all = Options {
        threads: Some(threads),
        least_share: Some(1),
        lanes,
        ..options()
    };
    let mut simulation = Simulation::new(&touching.scene, &all).expect("the scene is sound");
    touching.run(&mut simulation);
    let mut vectors: Vec<Vector> = vec![];
    for set in 0..simulation.sets().len() {
        vectors.push(simulation.contact_force(set));
        if !touching.scene.surfaces.is_empty() {
            vectors.push(simulation.surface_impulse(0, set));
        }
    }
    for vertex in simulation.boundaries().vertices {
        vectors.extend([vertex.position, vertex.force]);
    }
    let bits = |v: &Vector| v.map(f64::to_bits);
    (simulation.state_hash(), vectors.iter().map(bits).collect())
}

#[test]
fn threads_and_lanes_change_no_bit_of_contact() {
    let lanes = lanes();
    assert!(lanes.contains(&LaneChoice::Scalar));
    for touching in touching() {
        let expected = result(&touching, 1, LaneChoice::Scalar);
        for threads in THREADS {
            for &choice in &lanes {
                assert!(
                    result(&touching, threads, choice) == expected,
                    "{}: {threads} threads, {choice:?}",
                    touching.name
                );
            }
        }
    }
}

/// One scene of each kind, with every weighting function, scheme and transfer that it accepts.
#[test]
#[ignore = "takes 61 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn threads_and_lanes_change_no_bit_of_contact_whatever_the_method() {
    let lanes = lanes();
    let mut compared = 0;
    let kinds = touching().into_iter();
    for mut touching in kinds.filter(|one| one.scene.scheme == StressScheme::Usl) {
        for (w, weighting) in WEIGHTINGS.into_iter().enumerate() {
            for (s, scheme) in SCHEMES.into_iter().enumerate() {
                for (t, transfer) in TRANSFERS.into_iter().enumerate() {
                    let scene = &mut touching.scene;
                    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                    if scene.check().is_err() {
                        continue;
                    }
                    compared += 1;
                    let expected = result(&touching, 1, lanes[0]);
                    let alone = lanes[1..].iter().map(|choice| (1, *choice));
                    // Lanes in turn, so that each number of threads meets each of them.
                    let of_threads = [2, 3, 5].into_iter().enumerate();
                    let together = of_threads
                        .map(|(k, threads)| (threads, lanes[(w + s + t + k) % lanes.len()]));
                    for (threads, choice) in alone.chain(together) {
                        assert!(
                            result(&touching, threads, choice) == expected,
                            "{}: {weighting:?} {scheme:?} {transfer:?}: {threads} threads, {choice:?}",
                            touching.name
                        );
                    }
                }
            }
        }
    }
    assert!(compared > 300, "{compared}");
}
