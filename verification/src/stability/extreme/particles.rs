//! Words of the rows for particles: their states, sums and largest values over them.

use super::prelude::*;

/// A particle as it is read of a simulation; its displacement is NaN where none is kept.
pub struct ParticleState {
    pub id: u64,
    pub mass: f64,
    pub volume: f64,
    pub position: Vector,
    pub velocity: Vector,
    pub displacement: Vector,
    pub stress: [f64; 6],
}

impl ParticleState {
    /// All its numbers.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let vectors = self.position.iter().chain(&self.velocity);
        vectors.chain(&self.stress).copied()
    }
}

/// All particles in order of the identifier.
pub fn particles(simulation: &Simulation) -> Vec<ParticleState> {
    let mut all: Vec<_> = unsorted(simulation).collect();
    all.sort_by_key(|seen| seen.id);
    all
}

/// All particles in the order in which the kernel has them.
pub fn unsorted(simulation: &Simulation) -> impl Iterator<Item = ParticleState> + '_ {
    (0..simulation.sets().len()).flat_map(|set| of_body(simulation, set))
}

/// The particles of a body in the order in which the kernel has them.
pub fn of_body(simulation: &Simulation, set: usize) -> impl Iterator<Item = ParticleState> + '_ {
    let columns = &simulation.sets()[set];
    (0..columns.len()).map(move |p| ParticleState {
        id: columns.id[p],
        mass: simulation.particle_mass(set, p),
        volume: simulation.particle_volume(set, p),
        position: simulation.position(set, p),
        velocity: columns.velocity(p),
        displacement: simulation.displacement(set, p).unwrap_or([f64::NAN; 3]),
        stress: columns.stress(p),
    })
}

/// Sum of a value of all particles of the first body, in that order.
pub fn sum(simulation: &Simulation, of: impl Fn(&ParticleState) -> f64) -> f64 {
    of_body(simulation, 0).map(|seen| of(&seen)).sum()
}

/// Largest difference along any axis of all particles of two lists, of what is read of each.
pub fn all_apart<const N: usize>(
    a: &[ParticleState],
    b: &[ParticleState],
    of: fn(&ParticleState) -> [f64; N],
) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| apart(&of(a), &of(b))))
}

/// Largest component of the stress of any particle of the first body \[Pa\].
pub fn largest_stress(simulation: &Simulation) -> f64 {
    largest(of_body(simulation, 0).flat_map(|seen| seen.stress))
}

/// Largest component of the velocity of any particle \[m/s\].
pub fn fastest(simulation: &Simulation) -> f64 {
    largest(unsorted(simulation).flat_map(|seen| seen.velocity))
}

/// Sum of the magnitudes of all components of all momenta \[kg m/s\].
pub fn momentum_scale(simulation: &Simulation) -> f64 {
    let of = |seen: ParticleState| seen.velocity.map(|c| (seen.mass * c).abs());
    unsorted(simulation)
        .map(|seen| of(seen).iter().sum::<f64>())
        .sum()
}

/// Distance of the nearest particle from where a quarter turn about a point brings each, over `scale` \[m\].
pub fn off_by_a_quarter_turn(simulation: &Simulation, [a, b]: [f64; 2], scale: f64) -> f64 {
    let places: Vec<Vector> = of_body(simulation, 0).map(|seen| seen.position).collect();
    let mut most = 0.0;
    for x in &places {
        let turned = [a - (x[1] - b), b + (x[0] - a), 0.0];
        let near = places.iter().map(|y| apart(y, &turned));
        most = worst(most, near.fold(f64::INFINITY, f64::min) / scale);
    }
    most
}
