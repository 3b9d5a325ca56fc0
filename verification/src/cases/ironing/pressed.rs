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

/// The error of vertical forces against the reference, and both over time.
pub fn compare(label: &str, forces: &[[f64; 2]], known: &[f64]) -> Result<Measurements, Failure> {
    let pairs = || forces.iter().zip(known);
    let error = relative_l2(pairs().map(|(force, exact)| (1.0, [force[1]], [*exact])));
    let points = pairs()
        .enumerate()
        .map(|(k, (force, exact))| CurvePoint::new((k + 1) as f64 * INTERVAL, force[1], *exact));
    let title = format!("{label}: vertical force against finite elements");
    let curve = Curve::new(title, ["t in s", "force on the indenter in N"], points);
    Ok(Measurements::of([ratio(HISTORY, error)]).drawn(curve))
}

/// The force within what the figures of the whole way are held to, and half of it on the next mesh.
pub fn gates(runs: &Runs<'_>) -> Vec<Gate> {
    let reason = "5 % at the paper's cells, first order as in the other cases of contact";
    let judged = |rung: &Rung| {
        let bounds = [(CELL, 0.05), (0.5 * CELL, 0.025)];
        let bound = bounds.iter().find(|(cell, _)| *cell == rung.cell)?.1;
        let name = format!("{}: error of {HISTORY}", rung.label);
        Some(Gate::at_most(
            name,
            runs.error(&rung.label, HISTORY),
            bound,
            reason,
        ))
    };
    runs.of(VARIANT).filter_map(judged).collect()
}
