//! The second error of a problem for other solvers: that of the stress, where their frames hold stresses.

use proctor_scene::{Field, Vector};

use super::{Guest, Snapshot};

/// Exact Cauchy stresses (Pa: xx, yy, zz, yz, xz, xy) of particles by where they began \[m\], at a time \[s\].
pub type ExactStress = Box<dyn Fn(&[Vector], f64) -> Vec<[f64; 6]> + Send + Sync>;

impl Guest {
    /// The same with the exact stress, tension positive, which frames hold, too.
    #[must_use]
    pub fn with_stress(
        self,
        exact: impl Fn(&Vector, f64) -> [f64; 6] + Send + Sync + 'static,
    ) -> Self {
        self.with_stresses(Box::new(move |starts, t| {
            starts.iter().map(|x| exact(x, t)).collect()
        }))
    }

    /// The same of all particles at once.
    #[must_use]
    pub fn with_stresses(mut self, exact: ExactStress) -> Self {
        self.stress = Some(exact);
        self.scene.results.fields.push(Field::Stress);
        self
    }

    /// Relative error of the stress in the norm of L2, over the frames and particles that count for the first error;
    /// none where no exact stress is known, or frames hold no stresses. Components that frames lack do not count.
    #[must_use]
    pub fn stress_error(&self, frames: &[Snapshot]) -> Option<f64> {
        let exact = self.stress.as_ref()?;
        let first = if self.last_alone {
            frames.len().saturating_sub(1)
        } else {
            0
        };
        let (mut wrong, mut right) = (0.0, 0.0);
        for frame in &frames[first..] {
            let counted = frame.starts.iter().zip(&frame.stresses);
            let counted = counted.filter(|(start, _)| (self.counts)(start));
            let (starts, stresses): (Vec<Vector>, Vec<[f64; 6]>) = counted.unzip();
            let exact = exact(&starts, frame.time);
            for (stress, exact) in stresses.iter().flatten().zip(exact.iter().flatten()) {
                if !stress.is_nan() {
                    wrong += (stress - exact).powi(2);
                    right += exact.powi(2);
                }
            }
        }
        let error = (wrong / right).sqrt();
        error.is_finite().then_some(error)
    }
}
