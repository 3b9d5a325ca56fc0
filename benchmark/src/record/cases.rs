//! Rows of verification cases.

use super::done::VERDICT;
use super::row::{GATE, GATE_BOUND, GATE_SIDE, GATE_VALUE};
use super::{LADDER, Record, Row, key};
use crate::measure::Spent;
use crate::suite::{CaseRun, RanRung};
use proctor_verification::case::Gate;

impl Record {
    /// Adds a row per run of a case and repetition, one per gate, and one for the verdict where anything was run.
    pub fn push_case(&mut self, ran: &CaseRun, threads: usize) {
        if ran.rungs.is_empty() {
            return;
        }
        for rung in &ran.rungs {
            for (repetition, spent) in rung.samples.iter().enumerate() {
                self.push(run_row(
                    ran.case.name(),
                    rung,
                    repetition as u64,
                    *spent,
                    threads,
                ));
            }
        }
        for gate in &ran.verdict.gates {
            self.push_gate(ran.case.name(), gate, threads);
        }
        self.push(verdict_row(ran, threads));
        self.details.push_case(ran);
    }

    /// Adds the row of a gate.
    pub(crate) fn push_gate(&mut self, of: &str, gate: &Gate, threads: usize) {
        self.push(gate_row(of, gate, threads));
    }
}

/// Time of a repetition of a run, and the counters of the run.
fn run_row(case: &str, ran: &RanRung, repetition: u64, spent: Spent, threads: usize) -> Row {
    let name = format!("{case}/{}", ran.rung.label);
    let mut row = Row::sample(name, repetition, threads).timed(spent);
    row.count("cell_size", ran.rung.cell);
    row.label(LADDER, format!("{case}/{}", ran.rung.variant));
    match &ran.solved {
        Ok(solved) => {
            row.count("particles", solved.particles as f64);
            row.count("steps", solved.steps as f64);
            row.count("time", solved.time);
            let particle_steps = solved.particles as f64 * solved.steps as f64;
            let rate = particle_steps / spent.wall.as_secs_f64();
            row.count("particle_steps_per_second", rate);
            for q in &solved.quantities {
                let key = key(q.name);
                let kind = if q.is_balance() { "balance" } else { "value" };
                row.count(format!("{kind}_{key}"), q.value);
                // What a balance should be is in its name.
                let exact = q.exact.filter(|_| !q.is_balance());
                for (kind, value) in [("exact", exact), ("error", q.error)] {
                    if let Some(value) = value {
                        row.count(format!("{kind}_{key}"), value);
                    }
                }
            }
        }
        Err(error) => row.fail(error.to_string()),
    }
    row
}

/// A gate with what it found, as numbers that two records are compared in.
fn gate_row(case: &str, gate: &Gate, threads: usize) -> Row {
    let mut row = Row::aggregate(format!("{case}: {}", gate.name), GATE, threads);
    row.count(GATE_VALUE, gate.value);
    row.count(GATE_BOUND, gate.bound);
    row.label(GATE_SIDE, gate.relation.words());
    row
}

/// Verdict and observed orders of a case.
fn verdict_row(ran: &CaseRun, threads: usize) -> Row {
    let mut row = Row::aggregate(ran.case.name(), VERDICT, threads);
    let failed = ran.verdict.gates.iter().filter(|g| !g.passed()).count();
    row.count("gates", ran.verdict.gates.len() as f64);
    row.count("gates_failed", failed as f64);
    for (title, table) in &ran.verdict.tables {
        let Some(last) = table.rows().len().checked_sub(1) else {
            continue;
        };
        for (index, quantity) in table.quantities().iter().enumerate() {
            if let Some(order) = table.order(index, last) {
                let key = key(&format!("{title} {quantity}"));
                row.count(format!("observed_order_{key}"), order);
            }
        }
    }
    if !ran.passed() {
        let names: Vec<&str> = ran
            .verdict
            .gates
            .iter()
            .filter(|gate| !gate.passed())
            .map(|gate| gate.name.as_str())
            .collect();
        row.fail(match names.as_slice() {
            [] => "a run failed, or nothing was compared".to_owned(),
            names => format!("gates failed: {}", names.join("; ")),
        });
    }
    row
}
