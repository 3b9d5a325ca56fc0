//! Values at a material point: a linear fit through the particles that lie around it at the start.
//!
//! The particle nearest to a point moves by up to a quarter of a cell from mesh to mesh, which would be an error of order 1.

use nalgebra::DMatrix;
use proctor_scene::simulation::Simulation;
use proctor_scene::{Scene, Vector};
use std::collections::HashMap;

/// Relative singular value below which a direction has no second layer of particles.
const FLAT: f64 = 1e-6;

/// A material point, as weights of particles of one body.
#[derive(Clone, Debug)]
pub struct MaterialPoint {
    /// The body, by its place among the particle sets.
    pub set: usize,
    /// Weight of each particle, by its identifier.
    weights: HashMap<u64, f64>,
}

impl MaterialPoint {
    /// The point at `x` \[m\] of the body whose particle is nearest to it at the start; `None` where there are no particles
    /// or the simulation keeps no displacements.
    #[must_use]
    pub fn at(simulation: &Simulation, x: &Vector) -> Option<Self> {
        let axes = simulation.plan().axes;
        let square = |at: &Vector| -> f64 { (0..axes).map(|k| (at[k] - x[k]).powi(2)).sum() };
        let mut nearest: Option<(f64, usize)> = None;
        for (index, set) in simulation.sets().iter().enumerate() {
            for p in 0..set.len() {
                let distance = square(&simulation.initial_position(index, p)?);
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, index));
                }
            }
        }
        let (_, set) = nearest?;
        let reach = reach(simulation.scene(), set);
        let particles = &simulation.sets()[set];
        let near: Vec<(u64, Vector)> = (0..particles.len())
            .filter_map(|p| Some((particles.id[p], simulation.initial_position(set, p)?)))
            .filter(|(_, at)| (0..axes).all(|k| (at[k] - x[k]).abs() <= reach[k]))
            .collect();
        let places: Vec<Vector> = near.iter().map(|(_, at)| *at).collect();
        let weights = fit(&places, x, &reach, axes)?;
        let ids = near.iter().map(|(id, _)| *id);
        Some(Self {
            set,
            weights: ids.zip(weights).collect(),
        })
    }

    /// The fit of values of particles, by their place in the set; not a number where a particle has left.
    #[must_use]
    pub fn values<const N: usize>(
        &self,
        simulation: &Simulation,
        of: impl Fn(usize) -> [f64; N],
    ) -> [f64; N] {
        let particles = &simulation.sets()[self.set];
        let mut found: Vec<(u64, f64, usize)> = (particles.id.iter().enumerate())
            .filter_map(|(p, id)| Some((*id, *self.weights.get(id)?, p)))
            .collect();
        if found.len() < self.weights.len() {
            return [f64::NAN; N];
        }
        // In order of the identifiers, so that no bit hangs on how particles are stored.
        found.sort_by_key(|(id, _, _)| *id);
        let mut sums = [0.0; N];
        for (_, weight, p) in found {
            let value = of(p);
            for k in 0..N {
                sums[k] += weight * value[k];
            }
        }
        sums
    }
}

/// Distance along each axis within which particles of a body count for a point \[m\]: two layers of them at least, from a
/// point on the edge of the body.
#[must_use]
pub(super) fn reach(scene: &Scene, body: usize) -> Vector {
    let per_cell = scene.bodies[body].particles_per_cell;
    std::array::from_fn(|axis| scene.mesh.cell[axis] * (2.0 / per_cell[axis] as f64).max(1.0))
}

/// Weights with which values at `places` \[m\] give the value at `x` of their linear fit; `None` where there are none.
#[must_use]
pub(super) fn fit(places: &[Vector], x: &Vector, reach: &Vector, axes: usize) -> Option<Vec<f64>> {
    let row = |at: &Vector| {
        let slopes = (0..axes).map(|k| (at[k] - x[k]) / reach[k]);
        std::iter::once(1.0).chain(slopes).collect::<Vec<f64>>()
    };
    let matrix = DMatrix::from_row_iterator(places.len(), 1 + axes, places.iter().flat_map(row));
    if places.is_empty() {
        return None;
    }
    // The value at the point is the first coefficient of the fit.
    let inverse = matrix.pseudo_inverse(FLAT).ok()?;
    Some(inverse.row(0).iter().copied().collect())
}
