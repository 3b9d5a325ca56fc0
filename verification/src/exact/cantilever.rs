//! A cantilever under gravity that is switched on at once, by finite elements of our own: under its weight it bends so
//! far that no beam theory holds (Liang et al. 2024, section 4.1, with a neo-Hookean material).
//!
//! The beam is held at x = 0. The history of two meshes, one twice as fine as the other, is extrapolated to an element
//! size of zero with the error of second order of the elements; what the extrapolation changes says how well the
//! reference is known. There is a limit of what can be known: at 10 m/s² the strains at the root are near one, where
//! finer meshes crush their elements in the corner of the support, and the histories of different meshes part.

use super::fe::{Failure, Mesh, Model, NeoHookean};

/// The beam and its load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cantilever {
    /// Length \[m\].
    pub length: f64,
    /// Height \[m\].
    pub height: f64,
    /// Material.
    pub material: NeoHookean,
    /// Gravity, downwards \[m/s²\].
    pub gravity: f64,
}

impl Cantilever {
    /// Displacements \[m\] of points of the beam, given where they are at the start (the support is x = 0, the lower
    /// edge y = 0), at the end of each of `count` intervals \[s\], with that many elements over the height.
    ///
    /// # Errors
    /// [`Failure`] if an element turns inside out.
    pub fn history(
        &self,
        elements: usize,
        points: &[[f64; 2]],
        interval: f64,
        count: usize,
    ) -> Result<Vec<Vec<[f64; 2]>>, Failure> {
        let size = [self.length, self.height];
        let along = (elements as f64 * self.length / self.height).round() as usize;
        let cells = [along, elements];
        let mut model = Model::new(Mesh::rectangle(size, cells), self.material)?;
        for held in &mut model.held[..=elements] {
            *held = [true; 2];
        }
        model.gravity = [0.0, -self.gravity];
        let shapes: Vec<_> = points
            .iter()
            .map(|point| Mesh::shape_in_rectangle(size, cells, *point))
            .collect();
        let mut history = Vec::with_capacity(count);
        for k in 1..=count {
            model.advance_to(interval * k as f64)?;
            let moved =
                |n: usize, axis: usize| model.positions[n][axis] - model.mesh.nodes[n][axis];
            let displacements = shapes.iter().map(|(nodes, shape)| {
                std::array::from_fn(|axis| {
                    let parts = nodes.iter().zip(shape).map(|(n, s)| s * moved(*n, axis));
                    parts.sum()
                })
            });
            history.push(displacements.collect());
        }
        Ok(history)
    }

    /// The same, extrapolated from `elements` over the height and half of them.
    ///
    /// # Errors
    /// [`Failure`] if an element turns inside out.
    pub fn extrapolated(
        &self,
        elements: usize,
        points: &[[f64; 2]],
        interval: f64,
        count: usize,
    ) -> Result<Vec<Vec<[f64; 2]>>, Failure> {
        let coarse = self.history(elements / 2, points, interval, count)?;
        let mut history = self.history(elements, points, interval, count)?;
        let pairs = history.iter_mut().flatten().flatten();
        for (fine, coarse) in pairs.zip(coarse.iter().flatten().flatten()) {
            *fine += (*fine - coarse) / 3.0;
        }
        Ok(history)
    }
}
