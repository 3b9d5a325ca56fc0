//! Equilibrium by dynamic relaxation: steps until the nodes are at rest.

use proctor_scene::simulation::Simulation;

use super::stepping::step;
use crate::case::Run;
use crate::case::gates::{GateRule, worst};
use crate::settings::Settings;
use crate::study::{Failure, Observer, Phase};

/// Steps after which the relaxation of a case's own settings that has not come to rest is given up: twenty times what
/// the finest rung of any case takes.
const MOST_STEPS: u64 = 100_000;
/// Steps per cell along a body after which the relaxation of other settings is given up, at `c dt/h = 0.35`: until the
/// unbalanced force is 1e-8 of the load USL takes about 35.
const MOST_STEPS_PER_CELL: f64 = 100.0;

/// Steps that a relaxation with settings is given on a body of so many cells: a combination that never comes to rest
/// must not hold up a study.
pub fn most_steps(settings: &Settings, cells: f64) -> u64 {
    match settings.courant {
        None => MOST_STEPS,
        Some(courant) => (MOST_STEPS_PER_CELL * cells * (0.35 / courant).max(1.0)) as u64,
    }
}

/// The gate on the unbalanced force over the load that a relaxation leaves.
pub const fn at_rest(residual: &'static str, bound: f64) -> GateRule {
    let reason = "far below the errors that are measured, so that they are those of the mesh";
    worst(residual)
        .at_most(bound, reason)
        .named("{quantity}, unbalanced force over load, worst mesh")
}

const END: f64 = 1e6; // A time that no relaxation reaches [s]; steps do not depend on it

const REPORT_EVERY: u64 = 20; // Steps between two calls of the progress function

/// Steps, at most `most`, until the norm of the unbalanced forces on the free nodes is at most `tolerance` times
/// `load` (N); returns their ratio.
///
/// # Errors
/// As [`step`], and where the residual does not fall so far in as many steps.
pub fn relax(
    simulation: &mut Simulation,
    load: f64,
    tolerance: f64,
    most: u64,
    observer: &mut dyn Observer,
) -> Result<f64, Failure> {
    let mut least = f64::INFINITY;
    observer.phase(Phase::Stepping);
    while simulation.steps() < most {
        let info = step(simulation, END, observer)?;
        let measured = info.measured;
        let (_, force) = measured.ok_or("the simulation was not asked to measure the residual")?;
        let residual = force / load;
        least = least.min(residual);
        if residual <= tolerance {
            observer.phase(Phase::Comparing);
            observer.progress(1.0);
            return Ok(residual);
        }
        if info.step % REPORT_EVERY == 0 {
            // Residuals fall exponentially, so their logarithm measures the way.
            observer.progress((libm::log(least) / libm::log(tolerance)).clamp(0.0, 1.0));
        }
    }
    Err(format!(
        "no equilibrium in {most} steps: unbalanced force over load {least:.3e}, wanted {tolerance:.3e}"
    )
    .into())
}

impl Run<'_> {
    /// Relaxes a body of a length \[m\] until the unbalanced force is at most `tolerance` times `load` \[N\].
    ///
    /// # Errors
    /// A step that fails, and a body that is not at rest after the steps that it has.
    pub fn relax(&mut self, load: f64, tolerance: f64, length: f64) -> Result<(), Failure> {
        let most = most_steps(self.settings, length / self.rung.cell);
        self.residual = relax(self.simulation, load, tolerance, most, self.observer)?;
        Ok(())
    }
}
