//! Do the gates of a case react? Every number that its runs gave is moved, one at a time, and the case is judged anew.
//!
//! [`Case::judge`] is a function of what the runs gave, so this costs no run. A number is moved no further than a
//! wrong reference of twice the bound would move it: a gate that lets that pass is none.

use crate::case::{Case, Gate, Relation, Rung, RungResult, Size};

/// Factor on its bound to which a number is moved where a gate is an upper one.
const BEYOND: f64 = 2.0;
/// Share of its bound to which the number of a lower gate is brought down.
const SHORT: f64 = 0.95;
/// Value that replaces a number that must be zero.
const ANY: f64 = 1e-12;

/// Shares of a number by which it is moved where a gate is on a difference.
const STEPS: [f64; 12] = [
    1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 1.5e-2, 2e-2, 5e-2, 0.1, 0.2,
];

/// A number of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    /// Label of the rung.
    pub rung: String,
    /// Name of the quantity.
    pub quantity: &'static str,
}

/// Numbers that a gate reacts to.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The gate, as it was judged.
    pub gate: Gate,
    /// Numbers of which one alone makes it fail. Without any the gate tests nothing that was measured.
    pub to: Vec<Number>,
}

/// Numbers that each gate reacts to, in the order in which the case names them. A gate that fails already reacts to nothing
/// here.
#[must_use]
pub fn reactions(case: &Case, size: Size, solved: &[(Rung, RungResult)]) -> Vec<Reaction> {
    let gates = case.judge(size, solved).gates;
    let mut found: Vec<Reaction> = gates
        .iter()
        .map(|gate| Reaction {
            gate: gate.clone(),
            to: vec![],
        })
        .collect();
    let mut moved = solved.to_vec();
    // Pictures judge nothing.
    for (_, run) in &mut moved {
        run.curve = None;
        run.drawings.clear();
    }
    for run in 0..moved.len() {
        let refinements = refinements(solved, run);
        for at in 0..moved[run].1.quantities.len() {
            let given = moved[run].1.quantities[at].clone();
            let mut tried: Vec<(Option<f64>, f64)> = vec![];
            for gate in &gates {
                for way in ways(gate, &given, &refinements) {
                    let quantity = &mut moved[run].1.quantities[at];
                    (quantity.error, quantity.value) = way;
                    if tried.contains(&way) {
                        continue;
                    }
                    tried.push(way);
                    let judged = case.judge(size, &moved).gates;
                    for (reaction, now) in found.iter_mut().zip(&judged) {
                        // What is meant for another gate may be too far for this one.
                        if notices(&reaction.gate, now)
                            && ways(&reaction.gate, &given, &refinements).contains(&way)
                        {
                            reaction.add(&moved[run].0, given.name);
                        }
                    }
                }
            }
            // Of a small difference of large numbers another step is twice the bound.
            for step in found
                .iter()
                .any(|r| r.to.is_empty())
                .then_some(STEPS)
                .into_iter()
                .flatten()
            {
                for step in [step, -step] {
                    let quantity = &mut moved[run].1.quantities[at];
                    quantity.value = given.value * (1.0 + step);
                    let judged = case.judge(size, &moved).gates;
                    for (reaction, now) in found.iter_mut().zip(&judged) {
                        if reaction.to.is_empty() && notices(&reaction.gate, now) {
                            reaction.add(&moved[run].0, given.name);
                        }
                    }
                }
            }
            moved[run].1.quantities[at] = given;
        }
    }
    found
}

impl Reaction {
    fn add(&mut self, rung: &Rung, quantity: &'static str) {
        let number = Number {
            rung: rung.label.clone(),
            quantity,
        };
        if !self.to.contains(&number) {
            self.to.push(number);
        }
    }
}

/// True if a gate that held fails, by no more than what a number moved by twice the bound makes of it.
fn notices(before: &Gate, now: &Gate) -> bool {
    let most = match before.relation {
        Relation::AtMost if before.bound > 0.0 => {
            let by = BEYOND * before.bound;
            // A share of a number that is off itself.
            (by + before.value.abs()) * (1.0 + by.min(0.5))
        }
        _ => f64::INFINITY,
    };
    before.passed() && !now.passed() && now.value <= most
}

/// Ratio by which a run is finer than others of its variant, by which an observed order may have been formed.
fn refinements(solved: &[(Rung, RungResult)], run: usize) -> Vec<f64> {
    let own = &solved[run].0;
    solved
        .iter()
        .filter(|(rung, _)| rung.variant == own.variant && rung.cell != own.cell)
        .map(|(rung, _)| rung.cell / own.cell)
        .collect()
}

/// Error and value of a quantity, moved as far as a gate must notice.
fn ways(
    gate: &Gate,
    given: &crate::case::Quantity,
    refinements: &[f64],
) -> Vec<(Option<f64>, f64)> {
    let mut ways = vec![];
    match gate.relation {
        Relation::AtMost => {
            let by = if gate.bound == 0.0 {
                ANY
            } else {
                BEYOND * gate.bound.abs()
            };
            for by in [by, -by] {
                match (given.error, given.exact) {
                    // As against a reference that is off by so much.
                    (Some(_), Some(exact)) if exact != 0.0 => {
                        let value = given.value + by * exact;
                        ways.push((Some((value / exact - 1.0).abs()), value));
                    }
                    (Some(error), _) if by > 0.0 => ways.push((Some(error + by), given.value + by)),
                    (Some(_), _) => {}
                    (None, _) => ways.push((None, given.value + by)),
                }
                // Where two runs are compared with each other.
                if given.exact != Some(0.0) {
                    ways.push((given.error, given.value * (1.0 + by)));
                }
            }
        }
        Relation::AtLeast => {
            let share = SHORT * gate.bound / gate.value;
            ways.push((given.error, given.value * share));
            for refinement in refinements {
                let factor = libm::pow(*refinement, gate.value - SHORT * gate.bound);
                ways.push((given.error.map(|e| e * factor), given.value));
            }
        }
    }
    ways
}
