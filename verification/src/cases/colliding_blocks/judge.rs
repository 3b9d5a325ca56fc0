//! Gates and tables of the collisions.

use super::{BALANCE, DURATION, ENERGY, IMPULSE, LOST, MOMENTUM, RESTITUTION};
use crate::cases::prelude::*;

const MOMENTUM_GATE: f64 = 1e-12; // Largest change of momentum over that of both bodies
const ENERGY_GATE: f64 = 1e-12; // Largest gain of energy over the initial one: round-off
/// Largest difference between the impulse and the momentum that it took, over it: round-off of some thousand steps.
const BALANCE_GATE: f64 = 1e-12;
const ORDER_GATE: f64 = 0.6; // Least observed order of the duration

/// Tables, gates and lines for the record.
pub fn verdict(runs: &Runs<'_>) -> Verdict {
    let rungs = runs.rungs;
    let mut verdict = Verdict::default();
    for (i, rung) in rungs.iter().enumerate() {
        let gates = &mut verdict.gates;
        let mut gate = |name, bound, reason| {
            gates.push(runs.error_at_most(&rung.label, name, bound, reason));
        };
        gate(
            MOMENTUM,
            MOMENTUM_GATE,
            "contact forces are equal and opposite; round-off is left",
        );
        gate(ENERGY, ENERGY_GATE, "contact only takes energy");
        let impact = super::variant(rung).impact();
        if impact.is_some() {
            gate(
                BALANCE,
                BALANCE_GATE,
                "between rollers contact alone changes the momentum of a bar; round-off is left",
            );
        }
        let finest = rungs
            .get(i + 1)
            .is_none_or(|next| next.variant != rung.variant);
        if !finest {
            continue;
        }
        if let Some(exact) = impact.and_then(|impact| impact.restitution()) {
            // Dispersion of second order spreads a jump over (h² L)^(1/3) on a way of 2 L.
            let spread = libm::pow(rung.cell / super::scenes::LENGTH, 2.0 / 3.0);
            let front = "dispersion spreads the front of the wave over (h² L)^(1/3)";
            gate(DURATION, 0.5 * spread, front);
            gate(RESTITUTION, spread, front);
            // J = (1 + e) m_1 m_2 / (m_1 + m_2) (v_1 - v_2), so that dJ / J = de / (1 + e).
            gate(
                IMPULSE,
                spread * exact / (1.0 + exact),
                "the impulse is off by de / (1 + e), where the front leaves de in the restitution e",
            );
            let names = [DURATION, IMPULSE, RESTITUTION];
            let table = runs.table(Some(rung.variant), &names);
            if rungs.iter().filter(|r| r.variant == rung.variant).count() > 1 {
                let rule = order(DURATION).at_least(ORDER_GATE, "2/3, as the front spreads");
                verdict.gates.push(runs.gate_of(rung.variant, &rule));
            }
            verdict.tables.push((rung.variant.to_owned(), table));
        } else if let Some(s) = runs.run(&rung.label) {
            verdict.for_the_record.push(format!(
                "{}: restitution {:.3}, energy dissipated {:.2} %",
                rung.label,
                s.value(RESTITUTION),
                100.0 * s.value(LOST)
            ));
        }
    }
    verdict
}
