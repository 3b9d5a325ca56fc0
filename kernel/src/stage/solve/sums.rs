//! Sums over planes of nodes.

use std::ops::AddAssign;

/// Sums over one plane of nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlaneSums {
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

impl PlaneSums {
    /// The sums as numbers, in the order of the fields.
    pub(crate) fn numbers(&self) -> [f64; 8] {
        [
            self.kinetic,
            self.unbalanced_squared,
            self.power,
            self.damping,
            self.friction,
            self.impact,
            self.absorbed,
            self.drag,
        ]
    }

    /// The sums that gave these numbers.
    pub(crate) fn from_numbers(numbers: [f64; 8]) -> Self {
        let [
            kinetic,
            unbalanced_squared,
            power,
            damping,
            friction,
            impact,
            absorbed,
            drag,
        ] = numbers;
        Self {
            kinetic,
            unbalanced_squared,
            power,
            damping,
            friction,
            impact,
            absorbed,
            drag,
        }
    }
}

impl AddAssign<&Self> for PlaneSums {
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
