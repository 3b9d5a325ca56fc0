//! Equal bits of contact of every kind: whatever the number of threads and the lanes.

use crate::common::{lanes, options};
use crate::touching::{Touching, touching};
use proctor_kernel::lanes::LaneChoice;
use proctor_kernel::scene::Vector;
use proctor_kernel::simulation::{Options, Simulation};

/// Numbers of threads; a machine need not have so many cores.
const THREADS: [usize; 5] = [1, 2, 3, 4, 8];

/// What contact leaves: the hash of the particles, forces on the bodies, and vertices of their boundaries as bits.
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
    for vertex in simulation.boundaries().0 {
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
