//! Gates and tables as data: the number that is bounded, on which rungs, the side, the bound and its reason.

pub use super::runs::Runs;
use super::{Gate, Relation, Rung, Size, Verdict};

/// The runs that a list of gates is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The whole ladder, which has one variant.
    Ladder,
    /// Each variant by itself.
    Variants,
    /// Each rung by itself.
    Rungs,
}

/// The number of a quantity that is bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    /// Its relative error.
    Error,
    /// Its value.
    Value,
    /// Its value over the exact one.
    Share,
    /// The part of that share beyond one.
    Excess,
    /// The largest of its values on all rungs of the variant.
    Worst,
    /// The observed order of its error.
    Order,
    /// One over that order.
    ReciprocalOrder,
}

/// A bound.
#[derive(Clone, Copy)]
enum Bound {
    /// One of each size.
    Of([f64; 2]),
    /// A function of the rung.
    By(fn(&Rung) -> f64),
    /// The width over which dispersion of second order spreads a front on its way along a length.
    Spread { length: f64, share: f64, power: f64 },
}

/// A gate as data.
#[derive(Clone, Copy)]
pub struct GateRule {
    number: Number,
    quantity: &'static str,
    relation: Relation,
    bound: Bound,
    reasons: [&'static str; 2],
    on: fn(&Rung) -> bool,
    /// The one variant that it judges, where it judges one alone.
    variant: Option<&'static str>,
    /// The one size that it judges, where it judges one alone.
    size: Option<Size>,
    /// True where it judges each rung of a variant.
    each: bool,
    /// True where it judges no variant of one rung alone.
    several: bool,
    /// True where its name begins with the label of the rung.
    by_rung: bool,
    /// Its name, where it has one of its own.
    name: Option<&'static str>,
}

/// A gate on the relative error of a quantity: of the finest rung, or of each.
#[must_use]
pub const fn error(quantity: &'static str) -> GateRule {
    GateRule::new(Number::Error, quantity)
}

/// A gate on the value of a quantity: of the finest rung, or of each.
#[must_use]
pub const fn value(quantity: &'static str) -> GateRule {
    GateRule::new(Number::Value, quantity)
}

/// A gate on the value of a quantity over its exact value.
#[must_use]
pub const fn share(quantity: &'static str) -> GateRule {
    GateRule::new(Number::Share, quantity)
}

/// A gate on what that share is beyond one: an error with its sign.
#[must_use]
pub const fn excess(quantity: &'static str) -> GateRule {
    GateRule::new(Number::Excess, quantity)
}

/// A gate on the largest value of a quantity on all rungs.
#[must_use]
pub const fn worst(quantity: &'static str) -> GateRule {
    GateRule::new(Number::Worst, quantity)
}

/// A gate on the observed order of a quantity between the two finest rungs.
#[must_use]
pub const fn order(quantity: &'static str) -> GateRule {
    GateRule::new(Number::Order, quantity)
}

/// A gate on one over that order, by which it is bounded from above.
#[must_use]
pub const fn reciprocal_order(quantity: &'static str) -> GateRule {
    GateRule::new(Number::ReciprocalOrder, quantity)
}

impl GateRule {
    const fn new(number: Number, quantity: &'static str) -> Self {
        Self {
            number,
            quantity,
            relation: Relation::AtMost,
            // Nothing is at most that.
            bound: Bound::Of([f64::NAN; 2]),
            reasons: [""; 2],
            on: |_| true,
            variant: None,
            size: None,
            each: false,
            several: false,
            by_rung: false,
            name: None,
        }
    }

    /// Name of the quantity that is bounded.
    pub(super) const fn quantity(&self) -> &'static str {
        self.quantity
    }

    /// An upper bound and its reason.
    #[must_use]
    pub const fn at_most(self, bound: f64, reason: &'static str) -> Self {
        self.at_most_of([bound; 2], [reason; 2])
    }

    /// Upper bounds of the short ladder and of the full one, with their reasons.
    #[must_use]
    pub const fn at_most_of(mut self, bounds: [f64; 2], reasons: [&'static str; 2]) -> Self {
        self.bound = Bound::Of(bounds);
        self.reasons = reasons;
        self
    }

    /// An upper bound that is a function of the rung, the finest one.
    #[must_use]
    pub const fn at_most_by(mut self, bound: fn(&Rung) -> f64, reason: &'static str) -> Self {
        self.bound = Bound::By(bound);
        self.reasons = [reason; 2];
        self
    }

    /// An upper bound that is a share of a power of the width w = (h/L)^(2/3), over which dispersion of second order spreads a front
    /// on a mesh of the finest rung, on a way along a length L \[m\].
    #[must_use]
    pub const fn at_most_spread(
        mut self,
        length: f64,
        [share, power]: [f64; 2],
        reason: &'static str,
    ) -> Self {
        self.bound = Bound::Spread {
            length,
            share,
            power,
        };
        self.reasons = [reason; 2];
        self
    }

    /// A lower bound and its reason.
    #[must_use]
    pub const fn at_least(self, bound: f64, reason: &'static str) -> Self {
        self.at_least_of([bound; 2], reason)
    }

    /// Lower bounds of the short ladder and of the full one, and their reason.
    #[must_use]
    pub const fn at_least_of(mut self, bounds: [f64; 2], reason: &'static str) -> Self {
        self.relation = Relation::AtLeast;
        self.bound = Bound::Of(bounds);
        self.reasons = [reason; 2];
        self
    }

    /// Restricts the gate to certain rungs, or to the variants of such.
    #[must_use]
    pub const fn on(mut self, rungs: fn(&Rung) -> bool) -> Self {
        self.on = rungs;
        self
    }

    /// Restricts the gate to a variant.
    #[must_use]
    pub const fn of(mut self, variant: &'static str) -> Self {
        self.variant = Some(variant);
        self
    }

    /// Restricts the gate to the full ladder.
    #[must_use]
    pub const fn full_alone(mut self) -> Self {
        self.size = Some(Size::Full);
        self
    }

    /// Restricts the gate to the short ladder.
    #[must_use]
    pub const fn short_alone(mut self) -> Self {
        self.size = Some(Size::Quick);
        self
    }

    /// Has the gate judge each rung of a variant, before those gates that judge the finest; its name begins with the label of the
    /// rung.
    #[must_use]
    pub const fn of_each(mut self) -> Self {
        self.each = true;
        self.by_rung()
    }

    /// Restricts the gate to variants of several rungs, which have an order.
    #[must_use]
    pub const fn of_several(mut self) -> Self {
        self.several = true;
        self
    }

    /// Gives the gate a name of its own, in which `{quantity}` stands for that of the quantity, `{variant}` and `{label}` for those
    /// of the rung.
    #[must_use]
    pub const fn named(mut self, name: &'static str) -> Self {
        self.name = Some(name);
        self
    }

    /// Gives the gate a name that begins with the label of the finest rung.
    #[must_use]
    pub const fn by_rung(mut self) -> Self {
        self.by_rung = true;
        self
    }

    /// The gate on the ladder of a variant, of which a rung is the finest one.
    pub(super) fn of_variant(&self, runs: &Runs<'_>, finest: Option<&Rung>) -> Gate {
        self.gate(runs, Scope::Variants, finest)
    }

    /// True for a rung that it judges, or for the ladder of which it is the finest one.
    fn judges(&self, runs: &Runs<'_>, rung: &Rung) -> bool {
        self.variant.is_none_or(|variant| variant == rung.variant)
            && (self.on)(rung)
            && (!self.several || runs.of(rung.variant).count() > 1)
    }

    /// The gate on a rung, or on the ladder of which it is the finest one.
    fn gate(&self, runs: &Runs<'_>, scope: Scope, rung: Option<&Rung>) -> Gate {
        let label = rung.map_or("no rung", |rung| &rung.label);
        let name = self.quantity;
        let variant = match scope {
            Scope::Ladder => None,
            Scope::Variants | Scope::Rungs => rung.map(|rung| rung.variant),
        };
        let value = match self.number {
            Number::Error => runs.error(label, name),
            Number::Value => runs.value(label, name),
            Number::Share => runs.share(label, name),
            Number::Excess => runs.share(label, name) - 1.0,
            Number::Worst => runs.worst(variant, name),
            Number::Order => runs.order(variant, name),
            Number::ReciprocalOrder => 1.0 / runs.order(variant, name),
        };
        let full = usize::from(runs.size == Size::Full);
        let bound = match self.bound {
            Bound::Of(bounds) => bounds[full],
            Bound::By(bound) => rung.map_or(f64::NAN, bound),
            Bound::Spread {
                length,
                share,
                power,
            } => rung.map_or(f64::NAN, |rung| {
                let width = libm::pow(rung.cell / length, 2.0 / 3.0);
                share * libm::pow(width, power)
            }),
        };
        let by_rung = self.by_rung || scope == Scope::Rungs;
        let mut title = match (self.number, by_rung) {
            (Number::Error | Number::Value | Number::Excess, true) => format!("{label}: {name}"),
            (Number::Share, true) => format!("{label}: {name} over the exact one"),
            (Number::Share, _) => format!("{name} over the exact one, {label}"),
            (Number::Excess, _) => format!("excess of {name}, {label}"),
            (Number::Error, _) => format!("error of {name}, {label}"),
            (Number::Value | Number::Worst, _) => format!("{name}, {label}"),
            (Number::Order, _) => format!("observed order of {name}"),
            (Number::ReciprocalOrder, _) => format!("one over the observed order of {name}"),
        };
        if let Some(template) = self.name {
            title = template.replace("{quantity}", name);
            title = title.replace("{label}", label);
            title = title.replace("{variant}", variant.unwrap_or_default());
        }
        if let (Scope::Variants, Some(variant), false) = (scope, variant, by_rung) {
            title = format!("{variant}: {title}");
        }
        Gate {
            name: title,
            value,
            relation: self.relation,
            bound,
            reason: self.reasons[full],
        }
    }
}

/// A table of errors as data.
#[derive(Clone, Copy)]
pub struct TableRule {
    /// Its title, in which `{variant}` stands for the name of the variant.
    pub title: &'static str,
    /// Its quantities.
    pub names: &'static [&'static str],
    /// The variants that have one.
    pub of: fn(&str) -> bool,
}

impl TableRule {
    /// The errors of quantities over the rungs of each variant.
    #[must_use]
    pub const fn new(title: &'static str, names: &'static [&'static str]) -> Self {
        Self {
            title,
            names,
            of: |_| true,
        }
    }

    /// The same for certain variants alone.
    #[must_use]
    pub const fn of(mut self, variants: fn(&str) -> bool) -> Self {
        self.of = variants;
        self
    }
}

/// The verdict of gates and tables on runs.
pub(crate) fn verdict(
    runs: &Runs<'_>,
    scope: Scope,
    gates: &[GateRule],
    tables: &[TableRule],
) -> Verdict {
    let mut verdict = Verdict::default();
    let on = |rung: Option<&Rung>, of: fn(&GateRule) -> bool| -> Vec<Gate> {
        let acts = |gate: &&GateRule| {
            of(gate)
                && gate.size.is_none_or(|size| size == runs.size)
                && rung.is_none_or(|rung| gate.judges(runs, rung))
        };
        let own = gates.iter().filter(acts);
        own.map(|gate| gate.gate(runs, scope, rung)).collect()
    };
    let of_ladder = |variant: Option<&str>| -> Vec<Gate> {
        let own = |rung: &&Rung| variant.is_none_or(|variant| rung.variant == variant);
        let rungs = runs.rungs.iter().filter(own);
        let each = rungs.flat_map(|rung| on(Some(rung), |gate| gate.each));
        let finest = on(runs.finest(variant), |gate| !gate.each);
        each.chain(finest).collect()
    };
    verdict.gates = match scope {
        Scope::Ladder => of_ladder(None),
        Scope::Variants => (runs.variants().into_iter())
            .flat_map(|variant| of_ladder(Some(variant)))
            .collect(),
        Scope::Rungs => (runs.rungs.iter())
            .flat_map(|rung| on(Some(rung), |_| true))
            .collect(),
    };
    for variant in runs.variants() {
        for rule in tables.iter().filter(|rule| (rule.of)(variant)) {
            let title = rule.title.replace("{variant}", variant);
            verdict
                .tables
                .push((title, runs.table(Some(variant), rule.names)));
        }
    }
    verdict
}
