//! Histories on three meshes, reduced to differences that fall: windows in time, norms, and the gate of a scene.

use super::rule::{Estimate, LEAST, ROUND_OFF, Rule, order};

/// Part of the run's time on either side over which the largest difference counts.
const WINDOW: f64 = 0.1;

/// A quantity over the output times, on three meshes.
#[derive(Clone, Copy, Debug)]
pub struct Histories<'a> {
    /// Cell sizes, coarse to fine \[m\].
    pub cells: [f64; 3],
    /// Output times \[s\], the same on all meshes.
    pub times: &'a [f64],
    /// Values on each mesh, one for each time.
    pub values: [&'a [f64]; 3],
}

impl Histories<'_> {
    /// Number of times that all meshes reached.
    fn count(&self) -> usize {
        let lengths = self.values.iter().map(|values| values.len());
        lengths.fold(self.times.len(), usize::min)
    }

    /// Largest differences of the coarser and the finer pair over a range of times.
    fn largest(&self, range: std::ops::Range<usize>) -> [f64; 2] {
        let [coarse, middle, fine] = self.values;
        range.fold([0.0; 2], |[d1, d2]: [f64; 2], k| {
            [
                d1.max((coarse[k] - middle[k]).abs()),
                d2.max((middle[k] - fine[k]).abs()),
            ]
        })
    }

    /// Largest magnitude on any mesh.
    #[must_use]
    pub fn size(&self) -> f64 {
        let count = self.count();
        let all = self.values.iter().flat_map(|values| &values[..count]);
        all.fold(0.0, |size: f64, value| size.max(value.abs()))
    }

    /// The times that count for the one of number `k`: a tenth of the run's time on either side, at the end the last fifth.
    #[must_use]
    pub fn window(&self, k: usize) -> std::ops::Range<usize> {
        let times = &self.times[..self.count()];
        let (Some(&time), Some(&end)) = (times.get(k), times.last()) else {
            return 0..0;
        };
        let (half, slack) = (WINDOW * end, ROUND_OFF * end);
        let from = (time - half).min(end - 2.0 * half);
        let first = times.partition_point(|t| *t < from - slack);
        first..times.partition_point(|t| *t <= time + half + slack)
    }

    /// Estimates at each output time, from the largest differences in its window.
    #[must_use]
    pub fn by_time(&self) -> Vec<Estimate> {
        let scale = self.size();
        let of = |k| {
            let differences = self.largest(self.window(k));
            Rule::VALUE.estimate(self.cells, differences, scale)
        };
        (0..self.count()).map(of).collect()
    }

    /// The estimate of the largest error in time.
    #[must_use]
    pub fn norm(&self) -> Estimate {
        let differences = self.largest(0..self.count());
        Rule::NORM.estimate(self.cells, differences, self.size())
    }

    /// The gate of the history as a whole. Differences are round-off where they are small beside `scale`, the largest energy of
    /// the scene for one of its energies: before bodies touch, strain energy is nothing else.
    #[must_use]
    pub fn gate(&self, scale: f64) -> Gate {
        let count = self.count();
        let settles = |differences: [f64; 2]| {
            differences[0].max(differences[1]) <= ROUND_OFF * scale
                || order(self.cells, differences).is_some_and(|p| p >= LEAST)
        };
        let all = self.largest(0..count);
        if settles(all) {
            let same = all[0].max(all[1]) <= ROUND_OFF * scale;
            return Gate {
                order: order(self.cells, all).filter(|_| !same),
                until: None,
            };
        }
        // The last time up to which the run as a whole would have passed: what comes after it is not converged.
        let mut until = 0.0;
        let mut so_far = [0.0f64; 2];
        for k in 0..count {
            let here = self.largest(k..k + 1);
            so_far = [so_far[0].max(here[0]), so_far[1].max(here[1])];
            if settles(so_far) {
                until = self.times[k];
            }
        }
        Gate {
            order: order(self.cells, all),
            until: Some(until),
        }
    }
}

/// The fall of the largest difference in time of a history from mesh to mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    /// Order seen; `None` where the histories agree to round-off.
    pub order: Option<f64>,
    /// The time until which it falls with order 0.5 at least \[s\]; `None` where it does to the end.
    pub until: Option<f64>,
}

impl Gate {
    /// True where the history settles.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.until.is_none()
    }
}
