//! Gates and tables of the shaken column and of the manual's block.

use super::{BASE, L2, LOWEST, TOP, UPPERMOST};
use crate::cases::prelude::*;

const TOP_GATE: f64 = 0.01; // Largest relative error of the top velocity at H/h = 32
const ORDER_GATE: f64 = 1.7; // Least observed order of the L2 error with a smooth start
/// Largest distance of the base velocity from the record, over its amplitude.
const BASE_GATE: f64 = 1e-3;
const JUDGED: &str = "H/h=32"; // The mesh on which the top velocity is judged

/// Tables, gates and lines for the record.
pub fn verdict(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for (variant, title) in [
        (
            "p-wave",
            "base-acceleration, sine of 15 Hz, APIC, MUSL, c dt/h = 0.6",
        ),
        (
            "smooth",
            "base-acceleration, smooth start, FLIP, USL, dt like h²",
        ),
    ] {
        verdict.tables.push((
            title.to_owned(),
            runs.table(Some(variant), &[TOP, UPPERMOST, L2]),
        ));
    }
    let columns: &[&str] = match runs.size {
        Size::Quick => &["p-wave"],
        Size::Full => &["p-wave", "p-wave-3d"],
    };
    for variant in columns {
        verdict.gates.push(Gate::at_most(
            format!("{variant}: error of {TOP}, {JUDGED}"),
            runs.error(&format!("{variant} {JUDGED}"), TOP),
            TOP_GATE,
            "the project promises one percent at 32 cells",
        ));
    }
    let why = "order 2 is expected of uGIMP at small strain with dt like h²; 0.3 is left for coarse meshes";
    let rule = order(L2).at_least(ORDER_GATE, why);
    verdict.gates.push(runs.gate_of("smooth", &rule));
    for variant in ["text", "input"] {
        let label = format!("manual's {variant}");
        let reason = "the base is prescribed: a time label wrong by half a step alone is 0.16 % of A with the input";
        verdict
            .gates
            .push(runs.error_at_most(&label, BASE, BASE_GATE, reason));
        if let Some(s) = runs.run(&label) {
            verdict.for_the_record.push(format!(
                "{label}: {LOWEST} {:.3} % (h/4 above the base; the block is elastic)",
                100.0 * s.error(LOWEST)
            ));
        }
    }
    for (variant, what) in [
        ("flip", "FLIP with USL, c dt/h = 0.1"),
        ("linear", "the base shaken with 3e-4 m/s, scaled to 0.3 m/s"),
    ] {
        if let Some(s) = runs.run(&format!("{variant} {JUDGED}")) {
            verdict.for_the_record.push(format!(
                "{what}, {JUDGED}: {TOP} off by {:.2} %, {L2} {:.2} %",
                100.0 * s.error(TOP),
                100.0 * s.error(L2)
            ));
        }
    }
    verdict
}
