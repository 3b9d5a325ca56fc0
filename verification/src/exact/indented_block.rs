//! A round rigid indenter that comes down on a soft block on a fixed base, by finite elements of our own (the first phase
//! of Liang et al. 2024, section 4.5, with a hyperelastic block and without friction).
//!
//! The barrier between them is that of the paper, so that what is compared is the method, not the law of contact.

use super::fe::{Failure, Indenter, Mesh, Model, NeoHookean};

/// The block, from the origin, and what presses on its top.
#[derive(Clone, Copy, Debug)]
pub struct IndentedBlock {
    /// Width and height \[m\].
    pub size: [f64; 2],
    /// Material.
    pub material: NeoHookean,
    /// Rate of viscous damping \[1/s\].
    pub damping: f64,
    /// The indenter.
    pub indenter: Indenter,
}

impl IndentedBlock {
    /// Forces that lift the indenter \[N/m\] at increasing times \[s\], with square elements, so many over the height.
    ///
    /// # Errors
    /// [`Failure`] if an element turns inside out.
    pub fn forces(&self, elements: usize, times: &[f64]) -> Result<Vec<f64>, Failure> {
        let [width, height] = self.size;
        let across = (width / height * elements as f64).round() as usize;
        let mut mesh = Mesh::rectangle(self.size, [across, elements]);
        let node = |i: usize, j: usize| i * (elements + 1) + j;
        mesh.outer = (0..across)
            .map(|i| [node(i + 1, elements), node(i, elements)])
            .collect();
        let mut model = Model::new(mesh, self.material)?;
        for i in 0..=across {
            model.held[node(i, 0)] = [true; 2];
        }
        model.damping = self.damping;
        model.indenter = Some(self.indenter);
        let force = |time: &f64| {
            model.advance_to(*time)?;
            Ok(model.indenter_force()[1])
        };
        times.iter().map(force).collect()
    }
}
