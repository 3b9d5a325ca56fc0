//! The way down into a neo-Hookean block without friction, against finite elements of our own.

use super::{
    APART, BLOCK, CELL, CRITICAL_GAP, DAMPING, DENSITY, DEPTH, DOWN, INTERVAL, KAPPA, POISSON,
    RADIUS, RAMP, YOUNG,
};
use crate::cases::prelude::*;
use crate::exact::fe::{Barrier, Indenter, NeoHookean};
use crate::exact::indented_block::IndentedBlock;

/// Name of the runs.
pub const VARIANT: &str = "neo-Hookean";
/// The indenter is then 0.59 m below the top of the block, and touches it along two thirds of its half circle \[s\].
pub const END: f64 = 40.0;
/// The error of the force over all times, in the L2 norm.
pub const HISTORY: &str = "L2 of the force while it goes down";

/// Elements over the height of the reference, of which the second is extrapolated with the first.
const ELEMENTS: [usize; 2] = [20, 40];
const FLOOR: f64 = 0.05; // The kernel's, as a share of the critical gap

/// Center of the indenter's circle at a time: at rest, a ramp, then steadily down.
fn center(time: f64) -> [f64; 2] {
    let speed = DEPTH / (DOWN - 0.5 * RAMP);
    let gone = if time < RAMP {
        0.5 * speed * time * time / RAMP
    } else {
        speed * (time - 0.5 * RAMP)
    };
    [APART + RADIUS, BLOCK[1] + APART + RADIUS - gone]
}

/// Forces of the reference at the end of each interval, times a factor \[N\].
pub fn reference(factor: f64) -> Result<Vec<f64>, String> {
    static GIVEN: OnceLock<Result<Vec<f64>, String>> = OnceLock::new();
    let compute = || {
        let block = IndentedBlock {
            size: BLOCK,
            material: NeoHookean::from_young(YOUNG, POISSON, DENSITY),
            // Eq. 20.
            damping: DAMPING / CELL * (YOUNG / DENSITY).sqrt(),
            indenter: Indenter {
                barrier: Barrier {
                    stiffness: KAPPA,
                    critical_gap: CRITICAL_GAP,
                    floor: FLOOR,
                },
                radius: RADIUS,
                center,
            },
        };
        let count = (END / INTERVAL).round() as usize;
        let times: Vec<f64> = (1..=count).map(|k| k as f64 * INTERVAL).collect();
        let forces = |elements| {
            block
                .forces(elements, &times)
                .map_err(|e| format!("the reference: {e}"))
        };
        let [coarse, fine] = [forces(ELEMENTS[0])?, forces(ELEMENTS[1])?];
        let pairs = coarse.iter().zip(&fine);
        Ok(pairs.map(|(c, f)| f + (f - c) / 3.0).collect())
    };
    let known = GIVEN.get_or_init(compute).as_ref();
    let known = known.map_err(Clone::clone)?;
    Ok(known.iter().map(|force| force * factor).collect())
}

/// The error of vertical forces against the reference.
pub fn quantities(forces: &[[f64; 2]], known: &[f64]) -> Vec<Quantity> {
    let (mut left, mut all) = (0.0, 0.0);
    for (force, exact) in forces.iter().zip(known) {
        left += (force[1] - exact).powi(2);
        all += exact * exact;
    }
    vec![Quantity::of_zero(HISTORY, (left / all).sqrt())]
}

/// Both forces over time.
pub fn curve(label: &str, forces: &[[f64; 2]], known: &[f64]) -> Curve {
    let pairs = forces.iter().zip(known).enumerate();
    Curve::new(
        format!("{label}: vertical force against finite elements"),
        ["t in s", "force on the indenter in N"],
        pairs.map(|(k, (force, exact))| {
            CurvePoint::new((k + 1) as f64 * INTERVAL, force[1], *exact)
        }),
    )
}

/// The force within what the figures of the whole way are held to, and half of it on the next mesh.
pub fn gates(runs: &Runs<'_>) -> Vec<Gate> {
    let own = runs.rungs.iter().filter(|rung| rung.variant == VARIANT);
    let judged = own.filter_map(|rung| {
        let bound = [(CELL, 0.05), (0.5 * CELL, 0.025)];
        let bound = bound.iter().find(|(cell, _)| *cell == rung.cell)?.1;
        let error = runs.error(&rung.label, HISTORY);
        let name = format!("{}: error of {HISTORY}", rung.label);
        let reason = "5 % at the paper's cells, first order as in the other cases of contact";
        Some(Gate::at_most(name, error, bound, reason))
    });
    judged.collect()
}
