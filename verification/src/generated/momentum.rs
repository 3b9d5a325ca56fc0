//! Balances of collisions: mass, momentum and, with an affine transfer, angular momentum.

use proctor_scene::{Scene, Transfer, TransferKind, Vector, Weighting};

use super::dice::Dice;
use super::seen::{FinalState, largest};
use super::{Deviation, Question, Trial, crowd};

/// Mass and momentum.
pub static MOMENTUM: Question = Question {
    name: "momentum",
    holds: "bodies that collide keep each its mass, and together their momentum",
    because: "action is reaction at each node; round-off of some tens of steps is left",
    foreseen: &[],
    make: momentum,
};

/// Angular momentum.
pub static SPIN: Question = Question {
    name: "spin",
    holds: "bodies that collide keep their angular momentum with APIC",
    because: "the transfer to the particles and back keeps the angular momentum of the nodes (Jiang et al. \
        2015), but for round-off",
    foreseen: &[],
    make: spin,
};

/// Largest change over the sum of the magnitudes.
const BOUND: f64 = 1e-12;

/// Bodies that meet, with nothing outside.
fn collision(dice: &mut Dice) -> Scene {
    let allowed = crowd::CrowdChoices {
        outside: false,
        ..crowd::ALL
    };
    crowd::scene(dice, allowed)
}

fn momentum(dice: &mut Dice) -> Trial {
    let scene = collision(dice);
    let judge = Box::new(|seen: &[FinalState]| {
        let [seen] = seen else { return vec![] };
        let sum = |axis: usize, end: bool| -> f64 {
            let of = |p: &super::Particle| {
                let (m, v) = if end {
                    (p.mass, p.velocity)
                } else {
                    (p.start_mass, p.start_velocity)
                };
                m * v[axis]
            };
            seen.particles.iter().map(of).sum()
        };
        let scale = seen.momentum_scale();
        let change = largest((0..3).map(|axis| sum(axis, true) - sum(axis, false)));
        let mass = largest(seen.particles.iter().map(|p| p.mass / p.start_mass - 1.0));
        vec![
            Deviation::new("change of momentum over its scale", change / scale, BOUND),
            Deviation::new("change of the mass of a particle over it", mass, 0.0),
        ]
    });
    Trial {
        runs: vec![scene.into()],
        judge,
    }
}

fn spin(dice: &mut Dice) -> Trial {
    let mut scene = collision(dice);
    // The inertia of an affine velocity is the same everywhere with B-splines alone.
    scene.weighting = Weighting::QuadraticBSpline;
    scene.transfer = Transfer::new(TransferKind::Apic);
    let cell = scene.mesh.cell;
    let judge = Box::new(move |seen: &[FinalState]| {
        let [seen] = seen else { return vec![] };
        let (start, end) = (of(seen, &cell, false), of(seen, &cell, true));
        let change = largest((0..3).map(|axis| end[axis] - start[axis]));
        let scale = seen.momentum_scale() * reach(seen);
        vec![Deviation::new(
            "change of angular momentum over its scale",
            change / scale,
            BOUND,
        )]
    });
    Trial {
        runs: vec![scene.into()],
        judge,
    }
}

/// Largest distance from the middle of the first particles \[m\].
fn reach(seen: &FinalState) -> f64 {
    let first = seen.particles[0].start;
    largest(
        seen.particles
            .iter()
            .flat_map(|p| (0..3).map(move |a| p.position[a] - first[a])),
    )
}

/// Angular momentum about where the first particle began, affine velocities with it \[kg m²/s\].
fn of(seen: &FinalState, cell: &Vector, end: bool) -> Vector {
    let about = seen.particles[0].start;
    let mut sum = [0.0; 3];
    for p in &seen.particles {
        let (x, v) = if end {
            (p.position, p.velocity)
        } else {
            (p.start, p.start_velocity)
        };
        let x: Vector = std::array::from_fn(|axis| x[axis] - about[axis]);
        for axis in 0..3 {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            // A quarter of a cell squared is the inertia of quadratic B-splines along an axis.
            let affine = if end {
                0.25 * (cell[a] * cell[a] * p.affine[b][a] - cell[b] * cell[b] * p.affine[a][b])
            } else {
                0.0
            };
            sum[axis] += p.mass * (x[a] * v[b] - x[b] * v[a] + affine);
        }
    }
    sum
}
