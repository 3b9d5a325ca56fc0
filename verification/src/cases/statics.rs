//! Equilibrium by dynamic relaxation: steps until the nodes are at rest.

use std::fmt;

use proctor_kernel::simulation::{Simulation, StepError};

/// Steps after which a relaxation that has not come to rest is given up: twenty times what the finest rung of any
/// case takes.
const MOST_STEPS: u64 = 100_000;

/// A time that no relaxation reaches \[s\]; steps do not depend on it.
const END: f64 = 1e6;

/// Steps between two calls of the progress function.
const REPORT_EVERY: u64 = 20;

/// Why equilibrium was not reached.
#[derive(Debug)]
pub enum Unrest {
    /// A step failed.
    Step(StepError),
    /// The residual did not fall far enough.
    Slow {
        /// Smallest norm of the unbalanced nodal forces over the load, dimensionless.
        residual: f64,
        /// What it had to reach.
        tolerance: f64,
    },
    /// The simulation measures no residual.
    NotMeasured,
}

impl fmt::Display for Unrest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Step(error) => error.fmt(f),
            Self::Slow {
                residual,
                tolerance,
            } => write!(
                f,
                "no equilibrium in {MOST_STEPS} steps: unbalanced force over load {residual:.3e}, wanted {tolerance:.3e}"
            ),
            Self::NotMeasured => {
                f.write_str("the simulation was not asked to measure the residual")
            }
        }
    }
}

/// Steps until the norm of the unbalanced forces on the free nodes is at most `tolerance` times `load` (N);
/// returns their ratio.
///
/// # Errors
/// [`Unrest`].
pub fn relax(
    simulation: &mut Simulation,
    load: f64,
    tolerance: f64,
    progress: &mut dyn FnMut(f64),
) -> Result<f64, Unrest> {
    let mut least = f64::INFINITY;
    while simulation.steps() < MOST_STEPS {
        let info = simulation.step(END).map_err(Unrest::Step)?;
        let residual = info.measured.ok_or(Unrest::NotMeasured)?.1 / load;
        least = least.min(residual);
        if residual <= tolerance {
            progress(1.0);
            return Ok(residual);
        }
        if info.step % REPORT_EVERY == 0 {
            // Residuals fall exponentially, so their logarithm measures the way.
            progress((least.ln() / tolerance.ln()).clamp(0.0, 1.0));
        }
    }
    Err(Unrest::Slow {
        residual: least,
        tolerance,
    })
}
