//! Sweeps that begin with impulses.

use proctor_kernel::stage::touch::{Sweeps, Touch, TouchedNode, resolve};

const NODES: usize = 24;
const TOUCHES: usize = 15;
const CONVERGED: Sweeps = Sweeps {
    tolerance: 1e-13,
    few: 100_000,
    tolerance_of_few: 1e-13,
    most: 100_000,
};

/// Numbers from 0 to 1 without a pattern.
fn unit(seed: usize) -> f64 {
    (12.9898 * seed as f64).sin().abs().fract()
}

fn nodes() -> Vec<TouchedNode> {
    (0..NODES)
        .map(|node| TouchedNode {
            node,
            fields: vec![0],
            mobility: [0.5 + unit(node); 3],
            change: [0.0; 3],
        })
        .collect()
}

/// Particles that share nodes with their neighbours and fall at a floor that slopes.
fn touches() -> Vec<Touch> {
    (0..TOUCHES)
        .map(|p| {
            let weight = |n: usize| {
                let w = 0.05 + 0.2 * unit(100 * p + n);
                (p + n, [w; 3])
            };
            Touch {
                weights: (0..8).map(weight).collect(),
                normal: [-0.6, 0.0, 0.8],
                relative: [0.3 * unit(p + 7), 0.1, -1.0 + 0.5 * unit(p)],
                gap: 0.0,
                bound: 0.0,
                floor: 0.0,
                penalty: 0.0,
                friction: 0.3,
                normal_impulse: 0.0,
                tangential_impulse: [0.0; 3],
            }
        })
        .collect()
}

fn largest_difference(found: &[TouchedNode], expected: &[TouchedNode]) -> f64 {
    let pairs = found.iter().zip(expected);
    pairs
        .flat_map(|(a, b)| (0..3).map(move |axis| (a.change[axis] - b.change[axis]).abs()))
        .fold(0.0, f64::max)
}

#[test]
fn sweeps_that_begin_with_the_answer_end_with_it_at_once() {
    let (mut found, mut moved) = (touches(), nodes());
    assert!(resolve(&mut found, &mut moved, &CONVERGED) > 10);
    let (mut again, mut moved_again) = (found.clone(), nodes());
    let until = Sweeps {
        tolerance: 1e-9,
        ..CONVERGED
    };
    assert_eq!(resolve(&mut again, &mut moved_again, &until), 1);
    assert!(largest_difference(&moved_again, &moved) < 1e-9);
}

/// Whatever they begin with, the answer is the same: a wrong beginning costs sweeps, and no accuracy.
#[test]
fn sweeps_forget_with_what_they_began() {
    let (mut found, mut moved) = (touches(), nodes());
    resolve(&mut found, &mut moved, &CONVERGED);
    let (mut other, mut moved_other) = (touches(), nodes());
    for (p, touch) in other.iter_mut().enumerate() {
        touch.normal_impulse = 2.0 * unit(p + 50);
        touch.tangential_impulse = [0.2 * touch.normal_impulse, 0.0, 0.15 * touch.normal_impulse];
    }
    resolve(&mut other, &mut moved_other, &CONVERGED);
    assert!(largest_difference(&moved_other, &moved) < 1e-9);
}

/// After the few, a coarser change ends them; before them it does not.
#[test]
fn the_coarser_tolerance_counts_from_the_few_on() {
    let ended = |few: usize, most: usize| {
        let until = Sweeps {
            tolerance: 0.0,
            few,
            tolerance_of_few: 1.0,
            most,
        };
        resolve(&mut touches(), &mut nodes(), &until)
    };
    assert_eq!(ended(4, 50), 4);
    assert_eq!(ended(50, 6), 6);
}
