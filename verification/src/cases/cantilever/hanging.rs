//! The vertices of the beam when it hangs: where they are, and where their particles would take them.

use crate::cases::prelude::*;

pub(super) const FROM_PARTICLES: &str = "rms distance of vertices from their particles";
pub(super) const FARTHEST: &str = "the same, farthest vertex";
pub(super) const FROM_REFERENCE: &str = "vertices from the reference, rms";

/// The vertices when the beam hangs.
pub(super) struct HangingShape {
    /// Displacements from the start \[m\].
    displacements: Vec<[f64; 2]>,
    /// Distances to where their particles take them \[m\].
    distances: Vec<f64>,
}

impl HangingShape {
    /// Compares with the particles that were nearest at the start.
    pub(super) fn new(simulation: &Simulation, starts: &[[f64; 3]]) -> Result<Self, String> {
        let now = simulation
            .boundary_vertices(1)
            .ok_or("the beam has lost its boundary")?;
        let mut distances = vec![];
        for (x, start) in now.iter().zip(starts) {
            let p = nearest(simulation, [start[0], start[1]])?;
            let (Some(origin), Some(f)) = (
                simulation.initial_position(0, p),
                simulation.deformation(0, p),
            ) else {
                return Err("no deformation gradient is kept".to_owned());
            };
            let x_p = simulation.position(0, p);
            let off: [f64; 2] = std::array::from_fn(|i| {
                let arm: f64 = (0..2).map(|j| f[i][j] * (start[j] - origin[j])).sum();
                x[i] - x_p[i] - arm
            });
            distances.push(libm::hypot(off[0], off[1]));
        }
        let displacements = now
            .iter()
            .zip(starts)
            .map(|(x, start)| [x[0] - start[0], x[1] - start[1]]);
        Ok(Self {
            displacements: displacements.collect(),
            distances,
        })
    }

    /// Quantities, with the reference's displacements of the same points \[m\]. All should be zero, but for variants that
    /// show what is lost without a part of the method.
    pub(super) fn quantities(&self, reference: &[[f64; 2]], sound: bool) -> Vec<Quantity> {
        let length = |name, value| Quantity {
            name,
            value,
            exact: sound.then_some(0.0),
            error: None,
            unit: "m",
        };
        let mut quantities = vec![
            length(FROM_PARTICLES, rms(self.distances.iter().copied())),
            length(FARTHEST, self.distances.iter().copied().fold(0.0, f64::max)),
        ];
        if self.displacements.len() == reference.len() {
            let off = self.displacements.iter().zip(reference);
            let off = off.map(|(u, exact)| libm::hypot(u[0] - exact[0], u[1] - exact[1]));
            quantities.push(length(FROM_REFERENCE, rms(off)));
        }
        quantities
    }
}

/// The particle whose initial position is nearest to a point.
pub(super) fn nearest(simulation: &Simulation, point: [f64; 2]) -> Result<usize, String> {
    let distance = |p: usize| {
        let x = simulation.initial_position(0, p)?;
        Some(libm::hypot(x[0] - point[0], x[1] - point[1]))
    };
    (0..simulation.sets()[0].len())
        .filter_map(|p| Some((p, distance(p)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(p, _)| p)
        .ok_or_else(|| String::from("no particle keeps its initial position"))
}

/// Root mean square.
pub(super) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(s, n), v| (s + v * v, n + 1));
    (sum / f64::from(count)).sqrt()
}
