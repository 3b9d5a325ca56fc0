//! Largest deformations of a run, of which laws and particle domains bear only so much.
//!
//! Particles are looked at together with the balances (`invariants.rs`), and only those of a law or a particle domain that a large
//! deformation harms.

use crate::exact_sum::ExactSum;
use crate::laws::StrainRange;
use crate::layout::Layout;
use crate::model::{DomainUpdate, Weighting};
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::values::{Extremes, MOST_STRETCH_RATIO};

impl Cycle {
    /// Largest deformations seen so far.
    #[must_use]
    pub(crate) fn extremes(&self) -> Extremes {
        let mut all = self.state.extremes;
        for (set, body) in self.state.sets.iter().zip(&self.model.bodies) {
            if body.motion.is_some() {
                continue;
            }
            if body.law.strain_range().is_some() {
                let change = self.volume_change(set, body.density);
                if change.abs() > all.volume_change.abs() {
                    all.volume_change = change;
                }
            }
            let solid = !body.law.is_fluid();
            if solid && self.domains_do_not_follow() && set.layout.deformation.is_some() {
                let mut masses = [ExactSum::ZERO; 2];
                let [whole, beyond] = &mut masses;
                for p in self.own_particles(set).iter() {
                    let ratio = stretch_ratio(set, p).unwrap_or(0.0);
                    let mass = set.columns[Layout::MASS][p];
                    all.stretch_ratio = all.stretch_ratio.max(ratio);
                    whole.add(mass);
                    if ratio > MOST_STRETCH_RATIO {
                        beyond.add(mass);
                    }
                }
                self.join_sums(&mut masses);
                let [whole, beyond] = masses.map(|sum| sum.value());
                if whole > 0.0 {
                    all.stretched_share = all.stretched_share.max(beyond / whole);
                }
                self.join_most(std::slice::from_mut(&mut all.stretch_ratio));
            }
        }
        all
    }

    /// J - 1 of the particle where its magnitude is largest. Of two alike the expansion.
    fn volume_change(&self, set: &ParticleSet, density: f64) -> f64 {
        // Largest changes of both signs, the compression first.
        let mut largest = [0.0_f64; 2];
        let columns = (&set.columns[Layout::VOLUME], &set.columns[Layout::MASS]);
        for (volume, mass) in columns.0.iter().zip(columns.1) {
            let change = volume * density / mass - 1.0;
            largest = [largest[0].max(-change), largest[1].max(change)];
        }
        self.join_most(&mut largest);
        let [compression, expansion] = largest;
        if compression > expansion {
            -compression
        } else {
            expansion
        }
    }

    /// The range of the first law that has no energy at large strain, where the largest change of volume lies beyond it.
    pub(crate) fn exceeded_range(&self, extremes: &Extremes) -> Option<StrainRange> {
        let mut ranges = self
            .model
            .bodies
            .iter()
            .filter_map(|body| body.law.strain_range());
        ranges.find(|range| range.is_exceeded(extremes.volume_change))
    }

    /// Notes them in the state, which a checkpoint keeps.
    pub fn note_extremes(&mut self) {
        self.state.extremes = self.extremes();
    }

    /// True if particle domains, or the sizes that a weighting function has in their place, keep the ratio of their sides.
    fn domains_do_not_follow(&self) -> bool {
        matches!(
            self.model.settings.weighting,
            Weighting::ContiguousGimp(DomainUpdate::Determinant) | Weighting::QuadraticBSpline
        )
    }
}

/// Largest principal stretch over the smallest, where the largest is an extension by as much: domains part along it. In the plane those of the plane count.
fn stretch_ratio(set: &ParticleSet, p: usize) -> Option<f64> {
    let f = set.deformation(p)?;
    let [least, most] = principal_stretches(&f, set.layout.axes);
    (most > MOST_STRETCH_RATIO && least > 0.0).then(|| most / least)
}

/// The smallest and the largest principal stretch of a deformation gradient.
fn principal_stretches(f: &[[f64; 3]; 3], axes: usize) -> [f64; 2] {
    let f = nalgebra::Matrix3::from_fn(|a, b| f[a][b]);
    let square = f.transpose() * f;
    let squares = if axes == 2 {
        let (mean, half) = (
            0.5 * (square[(0, 0)] + square[(1, 1)]),
            0.5 * (square[(0, 0)] - square[(1, 1)]),
        );
        let radius = (half * half + square[(0, 1)] * square[(0, 1)]).sqrt();
        [mean - radius, mean + radius]
    } else {
        let values = square.symmetric_eigenvalues();
        [values.min(), values.max()]
    };
    squares.map(|square| square.max(0.0).sqrt())
}
