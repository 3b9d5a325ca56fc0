//! Gates of the rows: a name, a bound and its reason, and the worst value of several runs.

use super::prelude::*;
use crate::case::Relation;

/// The beginning of a gate: its name.
pub struct GateName(String);

/// A gate by its name; a bound with its reason follows.
pub fn gate(name: impl Into<String>) -> GateName {
    GateName(name.into())
}

impl GateName {
    /// An upper bound and its reason.
    pub fn at_most(self, bound: f64, reason: &'static str) -> Gate {
        Gate::at_most(self.0, 0.0, bound, reason)
    }

    /// A lower bound and its reason.
    pub fn at_least(self, bound: f64, reason: &'static str) -> Gate {
        Gate::at_least(self.0, f64::INFINITY, bound, reason)
    }

    /// Nothing of what is counted, and the reason.
    pub fn none(self, reason: &'static str) -> Gate {
        self.at_most(0.0, reason)
    }
}

impl Gate {
    /// Keeps a value where it is worse than all before, or is not a number.
    pub(super) fn see(&mut self, value: f64) {
        let worse = match self.relation {
            Relation::AtMost => value > self.value,
            Relation::AtLeast => value < self.value,
        };
        if worse || value.is_nan() {
            self.value = value;
        }
    }

    /// Counts what should not be.
    pub(super) fn count(&mut self, found: bool) {
        self.value += f64::from(u8::from(found));
    }

    /// Sets the value that was found.
    pub(super) fn found(self, value: f64) -> Self {
        Self { value, ..self }
    }
}

/// Momentum and energy of runs on which nothing acts from outside, and what must hold of the worst of them.
pub struct Conservation {
    momentum: Vector,
    scale: f64,
    energy: f64,
    /// Change of momentum, over that of all particles in all directions.
    pub drift: Gate,
    /// Energy over that at the start.
    pub grown: Gate,
}

impl Conservation {
    /// Conservation of that name, of no step yet.
    pub fn named(what: &str) -> Self {
        Self {
            momentum: [0.0; 3],
            scale: 0.0,
            energy: 0.0,
            drift: gate(format!(
                "{what}: change of momentum, over the momentum in all directions"
            ))
            .at_most(ROUND_OFF, ONLY_ROUND_OFF),
            grown: gate(format!("{what}: highest energy over that at the start"))
                .at_most(GROWN, NO_GROWTH),
        }
    }

    /// Sets the next run in motion, and takes what it begins with.
    pub fn start(&mut self, scene: &Scene, options: &Options) -> Result<Simulation, RowFault> {
        let simulation = start(scene, options)?;
        self.momentum = simulation.momentum();
        self.scale = momentum_scale(&simulation);
        self.energy = energy(&simulation);
        Ok(simulation)
    }

    /// Looks at a run again.
    pub fn look(&mut self, simulation: &Simulation) {
        let drift = apart(&simulation.momentum(), &self.momentum) / self.scale;
        self.drift.see(drift);
        self.grown.see(energy(simulation) / self.energy);
    }

    /// The condition that must hold.
    pub fn gates(self) -> [Gate; 2] {
        [self.drift, self.grown]
    }
}
