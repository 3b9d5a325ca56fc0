//! Motion to a fixed time in equal steps, and the fields at its end.

use proctor_kernel::simulation::Simulation;

use crate::case::Quantity;
use crate::convergence::relative_l2;
use crate::study::{Observer, Phase, STOPPED};

/// Number of times, about, that progress is told.
const REPORTS: u64 = 100;

/// Name of the error of the displacement among the quantities.
pub const DISPLACEMENT: &str = "L2(u)";
/// Name of the error of the stress.
pub const STRESS: &str = "L2(stress)";

/// Does `steps` equal steps.
///
/// # Errors
/// Why a step failed, in words.
pub fn advance(
    simulation: &mut Simulation,
    steps: u64,
    observer: &mut dyn Observer,
) -> Result<(), String> {
    let every = (steps / REPORTS).max(1);
    let end = simulation.scene().time;
    observer.phase(Phase::Stepping);
    while simulation.steps() < steps {
        if observer.stop() {
            return Err(STOPPED.to_owned());
        }
        simulation.step(end).map_err(|e| e.to_string())?;
        if simulation.steps().is_multiple_of(every) {
            observer.progress(simulation.steps() as f64 / steps as f64);
        }
    }
    observer.phase(Phase::Comparing);
    Ok(())
}

/// Runs to the end of the scene and looks at it at the end of each interval \[s\]; `look` also gets the number of the
/// interval, from 1.
///
/// # Errors
/// Why a step failed or what `look` says, in words.
pub fn at_intervals(
    simulation: &mut Simulation,
    interval: f64,
    observer: &mut dyn Observer,
    mut look: impl FnMut(&Simulation, usize) -> Result<(), String>,
) -> Result<(), String> {
    let count = (simulation.scene().time / interval).round() as usize;
    for k in 1..=count {
        observer.phase(Phase::Stepping);
        let time = k as f64 * interval;
        while simulation.time() < time {
            if observer.stop() {
                return Err(STOPPED.to_owned());
            }
            simulation.step(time).map_err(|e| e.to_string())?;
        }
        observer.phase(Phase::Comparing);
        observer.progress(k as f64 / count as f64);
        look(simulation, k)?;
    }
    Ok(())
}

/// A quantity that is itself a relative error; NaN, which no gate passes, where there is none.
pub fn ratio(name: &'static str, error: Option<f64>) -> Quantity {
    let error = error.unwrap_or(f64::NAN);
    Quantity {
        name,
        value: error,
        exact: Some(0.0),
        error: Some(error),
        unit: "1",
    }
}

/// Relative L2 error of a particle field, weighted by mass: `field` gives computed and exact values of a particle
/// of the first body by its number and its initial position (m).
pub fn l2<const N: usize>(
    simulation: &Simulation,
    mut field: impl FnMut(usize, [f64; 3]) -> Option<([f64; N], [f64; N])>,
) -> Option<f64> {
    let samples: Vec<_> = (0..simulation.sets()[0].len())
        .map(|p| {
            let (computed, exact) = field(p, simulation.initial_position(0, p)?)?;
            Some((simulation.mass_and_volume(0, p).0, computed, exact))
        })
        .collect::<Option<_>>()?;
    relative_l2(samples)
}

/// Errors of displacement (m) and Cauchy stress (Pa: xx, yy, zz, yz, xz, xy) against exact functions of the
/// initial position.
pub fn errors(
    simulation: &Simulation,
    displacement: impl Fn([f64; 3]) -> [f64; 3],
    stress: impl Fn([f64; 3]) -> [f64; 6],
) -> Vec<Quantity> {
    let u = l2(simulation, |p, x| {
        Some((simulation.displacement(0, p)?, displacement(x)))
    });
    let s = l2(simulation, |p, x| {
        Some((simulation.sets()[0].stress(p), stress(x)))
    });
    vec![ratio(DISPLACEMENT, u), ratio(STRESS, s)]
}
