//! The meaning of a number of a row, as its key says.

use super::row::{GATE_BOUND, GATE_SIDE, GATE_VALUE, VERDICT};

/// Meaning of a counter or a label of a row, which decides how two records are compared in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meaning {
    /// Relative error (`error_…`): less is better.
    Error,
    /// Observed order of convergence (`observed_order…`): more is better.
    Order,
    /// Half-width of the bar of a refined quantity (`uncertainty_…`): less is better.
    Uncertainty,
    /// Convergence of a refined quantity (the label `verdict` of a bar): a quantity that leaves `asymptotic` is worse.
    Settling,
    /// Number that should be zero and has no scale to be relative to (`balance_…`): less is better.
    Balance,
    /// Result (`value_…`, the time that was reached, the time step): neither side is better.
    Figure,
    /// Exact value of a result (`exact_…`): neither side is better.
    Reference,
    /// Value that a gate found (`gate_value`): the gate's side decides which is better.
    GateValue,
    /// The bound of a gate (`gate_bound`): the tighter, the better.
    GateBound,
    /// Side of its bound on which a gate's value must lie (the label `gate_side`).
    GateSide,
    /// Count of work or bytes (`instructions…`, `steps`, `bytes_per_…`, `node_bytes`): less is better.
    Count,
    /// Problem that is solved (`particles`, `cell_size`, settings): another value is another case.
    Setting,
    /// Hash of the final state (the label `state_hash`).
    Hash,
    /// Times, rates and sizes that belong to a machine, and words that describe a row: not judged as numbers.
    Information,
}

impl Meaning {
    /// Every meaning that is judged, in the order in which it is told.
    pub const JUDGED: [Self; 13] = [
        Self::Error,
        Self::Order,
        Self::Uncertainty,
        Self::Settling,
        Self::Balance,
        Self::Figure,
        Self::Reference,
        Self::GateValue,
        Self::GateBound,
        Self::GateSide,
        Self::Count,
        Self::Setting,
        Self::Hash,
    ];

    /// Meaning of a counter.
    #[must_use]
    pub fn of(key: &str) -> Self {
        match key {
            GATE_VALUE => Self::GateValue,
            GATE_BOUND => Self::GateBound,
            "steps" | "node_bytes" => Self::Count,
            "particles" | "cell_size" | "courant" | "particles_per_cell" => Self::Setting,
            "smallest_error" => Self::Error,
            "time" | "dt" | "dt_over_critical" => Self::Figure,
            _ if key.starts_with("error_") => Self::Error,
            _ if key.starts_with("observed_order") => Self::Order,
            _ if key.starts_with("uncertainty_") => Self::Uncertainty,
            _ if key.starts_with("balance_") => Self::Balance,
            _ if key.starts_with("value_") => Self::Figure,
            _ if key.starts_with("exact_") => Self::Reference,
            _ if key.starts_with("instructions") || key.starts_with("bytes_per_") => Self::Count,
            _ => Self::Information,
        }
    }

    /// Meaning of a label.
    #[must_use]
    pub fn of_label(key: &str) -> Self {
        match key {
            "state_hash" => Self::Hash,
            GATE_SIDE => Self::GateSide,
            VERDICT => Self::Settling,
            _ => Self::Information,
        }
    }

    /// The word for several of its kind.
    #[must_use]
    pub fn plural(self) -> &'static str {
        match self {
            Self::Error => "errors",
            Self::Order => "orders",
            Self::Uncertainty => "bars",
            Self::Settling => "verdicts of bars",
            Self::Balance => "balances",
            Self::Figure => "figures",
            Self::Reference => "references",
            Self::GateValue => "gates",
            Self::GateBound => "bounds",
            Self::GateSide => "sides of gates",
            Self::Count => "counts",
            Self::Setting => "settings",
            Self::Hash => "hashes",
            Self::Information => "pieces of information",
        }
    }
}
