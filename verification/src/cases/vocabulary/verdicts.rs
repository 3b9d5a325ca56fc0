//! What verdicts are made of: numbers of the runs of a ladder, tables and gates. What a run that failed should have given is
//! NaN, which no gate passes.

use crate::case::{Gate, Rung, Solved};
use crate::convergence::{ConvergenceTable, Row};

/// The run of the rung with that label.
pub fn run_of<'a>(solved: &'a [(Rung, Solved)], label: &str) -> Option<&'a Solved> {
    let found = solved.iter().find(|(rung, _)| rung.label == label);
    found.map(|(_, solved)| solved)
}

/// Relative error of a quantity of the run of the rung with that label.
pub fn error_of(solved: &[(Rung, Solved)], label: &str, name: &str) -> f64 {
    run_of(solved, label).map_or(f64::NAN, |run| run.error(name))
}

/// Value of a quantity of the run of the rung with that label.
pub fn value_of(solved: &[(Rung, Solved)], label: &str, name: &str) -> f64 {
    run_of(solved, label).map_or(f64::NAN, |run| run.value(name))
}

/// Gate on the error of a quantity of the run of the rung with that label.
pub fn error_at_most(
    solved: &[(Rung, Solved)],
    label: &str,
    name: &str,
    bound: f64,
    reason: &'static str,
) -> Gate {
    let error = error_of(solved, label, name);
    Gate::at_most(format!("{label}: {name}"), error, bound, reason)
}

/// Gate on the error of a quantity on the finest rung that a ladder has.
pub fn error_gate(
    rungs: &[Rung],
    solved: &[(Rung, Solved)],
    quantity: &str,
    bound: f64,
    reason: &'static str,
) -> Gate {
    let finest = rungs.last().map_or("no rung", |rung| &rung.label);
    let error = error_of(solved, finest, quantity);
    Gate::at_most(
        format!("error of {quantity}, {finest}"),
        error,
        bound,
        reason,
    )
}

/// Order of a quantity between the two finest rungs of a table, NaN where there is none.
fn finest_order(table: &ConvergenceTable, quantity: &str) -> f64 {
    let column = table.quantities().iter().position(|q| q == quantity);
    let last = table.rows().len().checked_sub(1);
    let order = column
        .zip(last)
        .and_then(|(column, last)| table.order(column, last));
    order.unwrap_or(f64::NAN)
}

/// Gate on the order of a quantity between the two finest rungs of a table.
pub fn order_gate(
    table: &ConvergenceTable,
    quantity: &str,
    bound: f64,
    reason: &'static str,
) -> Gate {
    let name = format!("observed order of {quantity}");
    Gate::at_least(name, finest_order(table, quantity), bound, reason)
}

/// Gates on that order from below and, by its reciprocal, from above.
pub fn order_within(
    table: &ConvergenceTable,
    quantity: &str,
    [least, most]: [f64; 2],
    reason: &'static str,
) -> [Gate; 2] {
    let reciprocal = 1.0 / finest_order(table, quantity);
    let name = format!("one over the observed order of {quantity}");
    let above = Gate::at_least(name, reciprocal, 1.0 / most, reason);
    [order_gate(table, quantity, least, reason), above]
}

/// Errors of the named quantities over the rungs of a variant, coarse to fine.
pub fn table(solved: &[(Rung, Solved)], variant: &str, names: &[&'static str]) -> ConvergenceTable {
    let mut table = ConvergenceTable::new(names.iter().copied());
    for (rung, solved) in solved.iter().filter(|(rung, _)| rung.variant == variant) {
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

/// A gate of a variant, which its name says first.
pub fn of_variant(variant: &str, mut gate: Gate) -> Gate {
    gate.name = format!("{variant}: {}", gate.name);
    gate
}
