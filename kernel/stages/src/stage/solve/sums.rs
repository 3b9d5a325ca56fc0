//! Sums over the nodes of a step.

use crate::exact_sum::ExactSum;
use std::ops::AddAssign;

/// Sums over nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepSums {
    /// Kinetic energy \[J\].
    pub kinetic: f64,
    /// Sum of squared unbalanced forces of free components \[N²\].
    pub unbalanced_squared: f64,
    /// Power of the nodal loads and of the moving planes \[W\].
    pub power: f64,
    /// Energy that local and viscous damping took over the kick \[J\].
    pub damping: f64,
    /// Energy that friction of contact took \[J\].
    pub friction: f64,
    /// Energy that contact took along its normal, where bodies met \[J\].
    pub impact: f64,
    /// Energy that left through absorbing planes over the kick \[J\].
    pub absorbed: f64,
    /// Energy that the drag between pore water and skeleton took over the kick \[J\].
    pub drag: f64,
}

impl AddAssign<&Self> for StepSums {
    fn add_assign(&mut self, other: &Self) {
        self.kinetic += other.kinetic;
        self.unbalanced_squared += other.unbalanced_squared;
        self.power += other.power;
        self.damping += other.damping;
        self.friction += other.friction;
        self.impact += other.impact;
        self.absorbed += other.absorbed;
        self.drag += other.drag;
    }
}

/// A quantity that is summed over nodes: a field of [`StepSums`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepSum {
    /// [`StepSums::kinetic`].
    Kinetic,
    /// [`StepSums::unbalanced_squared`].
    UnbalancedSquared,
    /// [`StepSums::power`].
    Power,
    /// [`StepSums::damping`].
    Damping,
    /// [`StepSums::friction`].
    Friction,
    /// [`StepSums::impact`].
    Impact,
    /// [`StepSums::absorbed`].
    Absorbed,
    /// [`StepSums::drag`].
    Drag,
}

/// Number of quantities.
const QUANTITIES: usize = 8;

/// Sums over nodes while they are formed. They are exact: neither the threads that share the nodes nor the ranks change a bit.
#[derive(Clone, Debug, Default)]
pub struct ExactStepSums {
    sums: [ExactSum; QUANTITIES],
    /// True for those that have terms: most steps need few of them.
    used: [bool; QUANTITIES],
}

impl ExactStepSums {
    /// Adds a term.
    #[inline]
    pub fn add(&mut self, quantity: StepSum, term: f64) {
        if term != 0.0 {
            self.used[quantity as usize] = true;
            self.sums[quantity as usize].add(term);
        }
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        for (sum, used) in self.sums.iter_mut().zip(&mut self.used) {
            if std::mem::take(used) {
                *sum = ExactSum::ZERO;
            }
        }
    }

    /// Adds other sums.
    pub fn merge(&mut self, other: &Self) {
        for (i, used) in other.used.iter().enumerate() {
            if *used {
                self.used[i] = true;
                self.sums[i].merge(&other.sums[i]);
            }
        }
    }

    /// The sums, each rounded once.
    #[must_use]
    pub fn value(&self) -> StepSums {
        let value = |quantity: StepSum| {
            let i = quantity as usize;
            if self.used[i] {
                self.sums[i].value()
            } else {
                0.0
            }
        };
        StepSums {
            kinetic: value(StepSum::Kinetic),
            unbalanced_squared: value(StepSum::UnbalancedSquared),
            power: value(StepSum::Power),
            damping: value(StepSum::Damping),
            friction: value(StepSum::Friction),
            impact: value(StepSum::Impact),
            absorbed: value(StepSum::Absorbed),
            drag: value(StepSum::Drag),
        }
    }

    /// The sums that have terms, as words: the place of each, then its digits.
    pub fn pack(&self, words: &mut Vec<u64>) {
        for (i, sum) in self.sums.iter().enumerate() {
            if self.used[i] {
                words.push(i as u64);
                words.extend(sum.words());
            }
        }
    }

    /// Adds packed sums.
    pub fn merge_packed(&mut self, words: &[u64]) {
        let (all, _) = words.as_chunks::<{ 1 + ExactSum::WORDS }>();
        for [place, digits @ ..] in all {
            let Some(sum) = self.sums.get_mut(*place as usize) else {
                continue;
            };
            self.used[*place as usize] = true;
            sum.merge(&ExactSum::from_words(digits));
        }
    }
}
