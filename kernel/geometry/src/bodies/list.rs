//! Particles given one by one.

use super::error::{FillError, mesh_range};
use super::{FilledBody, HalfLength};
use crate::mesh::Mesh;
use crate::shape::{Dimension, ParticleSeed};

/// The particles of a list, in its order. Each gets the half-lengths of a cube, in two dimensions a square,
/// of its volume: the list says nothing of their shape.
///
/// # Errors
///
/// As [`super::fill`].
pub(super) fn fill(
    seeds: &[ParticleSeed],
    mesh: &Mesh,
    dimension: Dimension,
) -> Result<FilledBody, FillError> {
    if seeds.is_empty() {
        return Err(FillError::EmptyList);
    }
    let axes = dimension.axes();
    let range = mesh_range(mesh);
    let mut x = [(); 3].map(|()| Vec::with_capacity(seeds.len()));
    let mut l_p = [(); 3].map(|()| Vec::with_capacity(seeds.len()));
    let mut volume = Vec::with_capacity(seeds.len());
    for (index, seed) in seeds.iter().enumerate() {
        FillError::require_positive("volume", Some(index), seed.volume)?;
        let half = match dimension {
            Dimension::Two => [0.5 * seed.volume.sqrt(), 0.5 * seed.volume.sqrt(), 0.5],
            Dimension::Three => [0.5 * libm::cbrt(seed.volume); 3],
        };
        let mut outside = false;
        for axis in 0..3 {
            let relative = if axis < axes {
                seed.position[axis] - mesh.origin[axis]
            } else {
                0.0
            };
            FillError::require_finite("position", Some(index), relative)?;
            let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
            outside |= axis < axes && !(0.0..=extent).contains(&relative);
            x[axis].push(relative);
            l_p[axis].push(half[axis]);
        }
        if outside {
            return Err(FillError::ParticleOutside {
                index,
                position: seed.position,
                mesh: range,
                axes,
            });
        }
        volume.push(seed.volume);
    }
    let exact_volume = sum(&volume);
    FillError::require_finite("volume of the body", None, exact_volume)?;
    Ok(FilledBody {
        x,
        volume,
        half_length: HalfLength::PerParticle(l_p),
        exact_volume,
        slices: vec![],
    })
}

/// Pairwise sum: its error grows with log n, not n.
fn sum(values: &[f64]) -> f64 {
    if values.len() <= 64 {
        return values.iter().sum();
    }
    let (left, right) = values.split_at(values.len() / 2);
    sum(left) + sum(right)
}

#[cfg(test)]
mod tests {
    use super::sum;

    #[test]
    fn pairwise_sum_of_a_million_tenths() {
        let tenths = vec![0.1; 1_000_000];
        // One after the other gives 100000.00000133288.
        assert!((sum(&tenths) - 100_000.0).abs() < 1e-9);
    }
}
