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

/// Momentum and energy of a run as it begins, against which those of later steps are held.
#[derive(Default)]
pub struct Balance {
    momentum: Vector,
    scale: f64,
    /// Energy \[J\].
    pub energy: f64,
}

impl Balance {
    /// The balance of a run from now on.
    pub fn of(simulation: &Simulation) -> Self {
        Self {
            momentum: simulation.momentum(),
            scale: momentum_scale(simulation),
            energy: energy(simulation),
        }
    }

    /// Change of momentum, over that of all particles in all directions.
    pub fn lost(&self, simulation: &Simulation) -> f64 {
        apart(&simulation.momentum(), &self.momentum) / self.scale
    }

    /// Energy over that at the start.
    pub fn grown(&self, simulation: &Simulation) -> f64 {
        energy(simulation) / self.energy
    }
}

/// Gates of runs on which nothing acts from outside: the worst of them keeps momentum, and its energy does not grow.
pub struct Conservation {
    /// Balance of the run that was set in motion last.
    pub balance: Balance,
    /// Change of momentum.
    pub drift: Gate,
    /// Energy over that at the start.
    pub grown: Gate,
}

impl Conservation {
    /// Conservation of that name, of no step yet.
    pub fn named(what: &str) -> Self {
        let drift = format!("{what}: change of momentum, over the momentum in all directions");
        let grown = format!("{what}: highest energy over that at the start");
        Self {
            balance: Balance::default(),
            drift: gate(drift).at_most(ROUND_OFF, ONLY_ROUND_OFF),
            grown: gate(grown).at_most(GROWN, NO_GROWTH),
        }
    }

    /// Sets the next run in motion, and takes what it begins with.
    pub fn start(&mut self, scene: &Scene, options: &Options) -> Result<Simulation> {
        let simulation = start(scene, options)?;
        self.balance = Balance::of(&simulation);
        Ok(simulation)
    }

    /// Looks at a run again.
    pub fn look(&mut self, simulation: &Simulation) {
        self.drift.see(self.balance.lost(simulation));
        self.grown.see(self.balance.grown(simulation));
    }

    /// The condition that must hold.
    pub fn gates(self) -> [Gate; 2] {
        [self.drift, self.grown]
    }
}

/// Gates of [`Conservation`] on a scene with each scheme and each weighting function that has a stable step; `steps` are the
/// steps of a run, and the number that divides those which are looked at.
pub fn conserved(
    what: &str,
    scene: &Scene,
    options: &Options,
    steps: [u64; 2],
) -> Result<[Gate; 2]> {
    let mut kept = Conservation::named(what);
    for scene in each_scheme(scene, &SAFE) {
        let mut simulation = kept.start(&scene, options)?;
        each_of(&mut simulation, steps, |s| kept.look(s))?;
    }
    Ok(kept.gates())
}
