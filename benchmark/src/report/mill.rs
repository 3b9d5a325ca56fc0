//! Orders that the mill of manufactured solutions observed, as a histogram, with the problems that miss a gate.

use super::html::{Section, Table, escape, paragraph};
use crate::show::histogram::{Bars, svg};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// A result of `proctor verify mill --json FILE`.
#[derive(Clone, Debug, Deserialize)]
pub struct MillResult {
    seed: u64,
    misses: usize,
    refused: usize,
    problems: Vec<MilledProblem>,
}

/// A problem in it; one whose draws were all refused has a number alone.
#[derive(Clone, Debug, Deserialize)]
struct MilledProblem {
    number: u64,
    #[serde(default)]
    family: String,
    #[serde(default)]
    law: String,
    #[serde(default)]
    method: String,
    #[serde(default)]
    gates: Vec<MilledGate>,
    failed: Option<String>,
}

/// A gate of a problem.
#[derive(Clone, Debug, Deserialize)]
struct MilledGate {
    what: String,
    /// Not a number where it is missing.
    value: Option<f64>,
    bound: f64,
    holds: bool,
}

/// Quantities whose orders are drawn, the name of the gate, and the order by theory.
const ORDERS: [(&str, &str, f64); 2] = [
    ("displacement", "order of L2(u)", 2.0),
    ("stress", "order of L2(stress)", 1.0),
];

impl MillResult {
    /// Reads a result.
    ///
    /// # Errors
    /// A file that is none, with the reason.
    pub fn read(path: &Path) -> Result<Self, String> {
        let at_fault = |reason: String| format!("{}: {reason}", path.display());
        let text = std::fs::read_to_string(path).map_err(|e| at_fault(e.to_string()))?;
        serde_json::from_str(&text).map_err(|e| {
            at_fault(format!(
                "{e}; accepted: a result of `proctor verify mill --json FILE`"
            ))
        })
    }

    /// Orders of a gate with that name: of problems that hold it, and of those that miss it.
    fn orders(&self, what: &str) -> [Vec<f64>; 2] {
        let gates = self.problems.iter().flat_map(|problem| &problem.gates);
        let (held, missed): (Vec<&MilledGate>, Vec<_>) = gates
            .filter(|gate| gate.what == what)
            .partition(|gate| gate.holds);
        [held, missed].map(|gates| gates.iter().filter_map(|gate| gate.value).collect())
    }
}

/// The section.
#[must_use]
pub fn section(result: &MillResult) -> Section {
    let judged = result.problems.iter().filter(|p| !p.family.is_empty());
    let mut body = paragraph(&format!(
        "Seed {}: {} manufactured problems, of which {} miss a gate; {} draws were refused. A problem is a random motion of a \
         random law, which a body force drives, on a ladder of meshes. `proctor verify mill` runs them.",
        result.seed,
        judged.clone().count(),
        result.misses,
        result.refused
    ));
    let panels: Vec<Bars> = ORDERS
        .iter()
        .map(|(name, what, expected)| {
            let [held, missed] = result.orders(what);
            Bars {
                title: format!("Observed order of the {name}"),
                expected: *expected,
                held,
                missed,
            }
        })
        .collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        body,
        "<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>",
        svg(&panels),
        escape(
            "Each bar counts problems by the order that their two finest meshes show, in steps of 0.1; the first and the last \
             bar hold all beyond. The line is the order that theory expects."
        )
    );
    let mut families: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    let mut table = Table::new(
        "Problems that miss a gate",
        &["problem", "family", "law", "method", "missed"],
    );
    for problem in judged {
        let missed: Vec<String> = (problem.gates.iter().filter(|gate| !gate.holds))
            .map(|gate| {
                let value = gate.value.unwrap_or(f64::NAN);
                format!("{} {value:.2e}, bound {:.2e}", gate.what, gate.bound)
            })
            .chain(problem.failed.clone())
            .collect();
        let entry = families.entry(&problem.family).or_default();
        entry.0 += 1;
        if !missed.is_empty() {
            entry.1 += 1;
            table.push_as(
                "failed",
                [
                    problem.number.to_string(),
                    problem.family.clone(),
                    problem.law.clone(),
                    problem.method.clone(),
                    missed.join("; "),
                ],
            );
        }
    }
    let mut counts = Table::new("Problems by family", &["family", "problems", "misses"]);
    for (family, (all, missed)) in families {
        counts.push([family.to_owned(), all.to_string(), missed.to_string()]);
    }
    body.push_str(&counts.html());
    if !table.is_empty() {
        body.push_str(&table.html());
    }
    Section {
        id: "mill",
        title: "Manufactured solutions".to_owned(),
        body,
    }
}
