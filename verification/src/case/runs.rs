//! The runs of a ladder, as gates and lines ask for them.

use super::gates::GateRule;
use super::wrong::Reference;
use super::{Gate, Rung, RungResult, Size};
use crate::convergence::{ConvergenceTable, Row};

/// The runs of a ladder, as they are judged. The number of a run that failed is NaN, which no gate passes.
pub struct Runs<'a> {
    /// The size of the ladder.
    pub size: Size,
    /// All rungs, those that failed among them.
    pub rungs: &'a [Rung],
    /// The rungs that were solved.
    pub solved: &'a [(Rung, RungResult)],
    /// The reference that they were compared with.
    pub reference: Reference,
}

impl Runs<'_> {
    /// The run of the rung with that label.
    #[must_use]
    pub fn run(&self, label: &str) -> Option<&RungResult> {
        let found = self.solved.iter().find(|(rung, _)| rung.label == label);
        found.map(|(_, solved)| solved)
    }

    /// Relative error of a quantity of the run of the rung with that label.
    #[must_use]
    pub fn error(&self, label: &str, name: &str) -> f64 {
        self.run(label).map_or(f64::NAN, |run| run.error(name))
    }

    /// Value of a quantity of the run of the rung with that label.
    #[must_use]
    pub fn value(&self, label: &str, name: &str) -> f64 {
        self.run(label).map_or(f64::NAN, |run| run.value(name))
    }

    /// The rungs of a variant, coarse to fine.
    #[must_use]
    pub fn of<'a>(&'a self, variant: &'a str) -> impl DoubleEndedIterator<Item = &'a Rung> {
        (self.rungs.iter()).filter(move |rung| rung.variant == variant)
    }

    /// Value of a quantity of the run of the rung with that label over its exact value.
    #[must_use]
    pub fn share(&self, label: &str, name: &str) -> f64 {
        let quantity = self.run(label).and_then(|run| run.quantity(name));
        let share = quantity.and_then(|quantity| Some(quantity.value / quantity.exact?));
        share.unwrap_or(f64::NAN)
    }

    /// Variants of the rungs, each once.
    #[must_use]
    pub fn variants(&self) -> Vec<&'static str> {
        let mut variants: Vec<&'static str> = vec![];
        for rung in self.rungs {
            if !variants.contains(&rung.variant) {
                variants.push(rung.variant);
            }
        }
        variants
    }

    /// The finest rung of a variant; of the ladder where there is none.
    #[must_use]
    pub fn finest(&self, variant: Option<&str>) -> Option<&Rung> {
        let of = |rung: &&Rung| variant.is_none_or(|variant| rung.variant == variant);
        self.rungs.iter().rfind(of)
    }

    /// Errors of the named quantities over the rungs of a variant, coarse to fine.
    #[must_use]
    pub fn table(&self, variant: Option<&str>, names: &[&'static str]) -> ConvergenceTable {
        let mut table = ConvergenceTable::new(names.iter().copied());
        let own = |rung: &Rung| variant.is_none_or(|variant| rung.variant == variant);
        for (rung, solved) in self.solved.iter().filter(|(rung, _)| own(rung)) {
            let row = Row {
                h: rung.cell,
                errors: names.iter().map(|name| solved.error(name)).collect(),
                particles: solved.particles,
                steps: solved.steps as usize,
            };
            // One error per name, by construction.
            let _ = table.push(row);
        }
        table
    }

    /// Largest value of a quantity on the rungs of a variant; NaN where one of them failed.
    #[must_use]
    pub fn worst(&self, variant: Option<&str>, name: &str) -> f64 {
        let own = |rung: &&Rung| variant.is_none_or(|variant| rung.variant == variant);
        let values = self.rungs.iter().filter(own);
        let values = values.map(|rung| self.value(&rung.label, name));
        // `max` would drop a NaN, and with it a rung that failed.
        values.fold(0.0, |worst, value| {
            if value > worst || value.is_nan() {
                value
            } else {
                worst
            }
        })
    }

    /// Gate on the error of a quantity of the run of the rung with that label.
    #[must_use]
    pub fn error_at_most(&self, label: &str, name: &str, bound: f64, reason: &'static str) -> Gate {
        let title = format!("{label}: {name}");
        Gate::at_most(title, self.error(label, name), bound, reason)
    }

    /// Gate on the value of a quantity of the run of the rung with that label.
    #[must_use]
    pub fn value_at_most(&self, label: &str, name: &str, bound: f64, reason: &'static str) -> Gate {
        let title = format!("{label}: {name}");
        Gate::at_most(title, self.value(label, name), bound, reason)
    }

    /// A gate on the finest rung and the ladder of a variant, whose name it has first.
    #[must_use]
    pub fn gate_of(&self, variant: &str, rule: &GateRule) -> Gate {
        rule.of_variant(self, self.finest(Some(variant)))
    }

    /// Order of a quantity between the two finest rungs of a variant, NaN where there is none.
    #[must_use]
    pub fn order(&self, variant: Option<&str>, name: &'static str) -> f64 {
        let table = self.table(variant, &[name]);
        let last = table.rows().len().checked_sub(1);
        let order = last.and_then(|last| table.order(0, last));
        order.unwrap_or(f64::NAN)
    }
}
