//! Saved arrays of boundaries: their vertices with the last displacements, and the slip of each pair.

use super::boundaries::Boundaries;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::elements::Elements;
use proctor_kernel::simulation::SavedArrays;
use std::slice::Iter;

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    pub(super) fn save(&self) -> SavedArrays {
        let flat = |points: &[PointIn<D>]| points.iter().flatten().copied().collect();
        let mut saved = vec![];
        for surface in &self.surfaces {
            let of = |what: &str| format!("{what} of boundary {}", surface.id);
            saved.push((of("vertices"), flat(surface.boundary.points())));
            saved.push((of("displacements"), flat(&surface.moved)));
        }
        for pair in &self.pairs {
            let slips = pair.slip.0.as_flattened().to_vec();
            saved.push((format!("slips of contact {}", pair.id), slips));
        }
        saved
    }

    /// Takes up lists in the order in which they were saved.
    pub(super) fn restore(&mut self, saved: &mut Iter<'_, (String, Vec<f64>)>) {
        let fill = |points: &mut [PointIn<D>], values: &[f64]| {
            for (point, value) in points.iter_mut().zip(values.chunks_exact(D)) {
                *point = PointIn::from_column_slice(value);
            }
        };
        for surface in &mut self.surfaces {
            for points in [surface.boundary.points_mut(), &mut surface.moved] {
                if let Some((_, values)) = saved.next() {
                    fill(points, values);
                }
            }
        }
        for (pair, (_, values)) in self.pairs.iter_mut().zip(saved) {
            pair.slip.0.copy_from_slice(values.as_chunks().0);
        }
    }
}
