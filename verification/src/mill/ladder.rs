//! Runs of a problem on a ladder of meshes: errors and observed orders.

use std::fmt;
use std::sync::Arc;

use proctor_laws::AnyLaw;
use proctor_scene::simulation::{Condition, Options, Simulation};

use super::boundary::Frame;
use super::problem::Problem;
use super::reference::Reference;

/// Errors of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// L2 of the displacement over that of the part that the field makes; of the whole displacement where there is no field.
    pub displacement: f64,
    /// L2 of the stress over that of the exact one.
    pub stress: f64,
    /// L2 of the first internal variable over that of the exact one.
    pub variable: Option<f64>,
}

/// Reason for which a run has no errors.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The problem has no solution that a ladder may be run for.
    NotSolvable(String),
    /// The kernel refuses the scene, or a step of it fails.
    Run(String),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSolvable(reason) | Self::Run(reason) => f.write_str(reason),
        }
    }
}

/// Deliberate faults of a run, to prove that gates notice.
#[derive(Clone, Default)]
pub struct Faults {
    /// Law of the kernel instead of that of the problem.
    pub law: Option<AnyLaw>,
    /// Motion of the reference that judges instead of that which drives.
    pub judged_by: Option<Problem>,
    /// Positions at which a frame is prescribed are this many steps too late.
    pub late: f64,
}

/// Runs a rung with that many cells per metre.
///
/// # Errors
/// Points that stop to yield, or a run that fails.
pub fn run(problem: &Problem, cells: usize, faults: &Faults) -> Result<Errors, Failure> {
    let refused = |e: &dyn fmt::Display| Failure::Run(e.to_string());
    let reference = Arc::new(Reference::new(problem, cells).map_err(|e| refused(&e))?);
    if let Some(reason) = reference.refused() {
        return Err(Failure::NotSolvable(reason.to_owned()));
    }
    let (dt, steps) = problem.steps(cells);
    let mut options = Options {
        threads: Some(1),
        ..reference.options(Options::default())
    };
    if problem.family.has_frame() {
        let frame: Arc<dyn Condition> = Frame::late(problem, dt, faults.late * dt);
        options.conditions.push(frame);
    }
    let mut scene = problem.scene(cells);
    if let Some(law) = &faults.law {
        scene.materials[0].law = law.clone();
    }
    let mut simulation = Simulation::new(&scene, &options).map_err(|e| refused(&e))?;
    for _ in 0..steps {
        simulation.step(problem.end).map_err(|e| refused(&e))?;
    }
    let judge = match &faults.judged_by {
        Some(other) => Arc::new(Reference::new(other, cells).map_err(|e| refused(&e))?),
        None => reference,
    };
    compare(&simulation, &judge, problem)
        .ok_or_else(|| Failure::Run("a particle has no exact value".to_owned()))
}

/// Errors of particles against exact values, weighted by mass, which is the same for all.
fn compare(simulation: &Simulation, reference: &Reference, problem: &Problem) -> Option<Errors> {
    let sets = simulation.sets();
    let all = (0..sets.len()).flat_map(|s| (0..sets[s].len()).map(move |p| (s, p)));
    let square = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>();
    let (mut off, mut whole) = ([0.0; 3], [0.0; 4]);
    for (s, p) in all {
        let set = &sets[s];
        let exact = reference.end(&simulation.initial_position(s, p)?)?;
        let found = simulation.displacement(s, p)?;
        let axes = problem.axes();
        let difference: Vec<f64> = (0..axes)
            .map(|i| found[i] - exact.displacement[i])
            .collect();
        let [stress, difference_of_stress] = [exact.stress, {
            let found = set.stress(p);
            std::array::from_fn(|i| found[i] - exact.stress[i])
        }];
        off[0] += square(&difference);
        whole[0] += square(&exact.field);
        whole[3] += square(&exact.displacement[..axes]);
        off[1] += square(&difference_of_stress);
        whole[1] += square(&stress);
        if let Some(exact) = exact.variables.first() {
            off[2] += (set.variables(p).first()? - exact).powi(2);
            whole[2] += exact * exact;
        }
    }
    let field = if whole[0] > 0.0 { whole[0] } else { whole[3] };
    Some(Errors {
        displacement: (off[0] / field).sqrt(),
        stress: (off[1] / whole[1]).sqrt(),
        variable: (problem.material.kind.yields()).then(|| (off[2] / whole[2]).sqrt()),
    })
}

/// Observed order between two errors on meshes of `coarse` and `fine` cells.
#[must_use]
pub fn order([coarse, fine]: [f64; 2], cells: [usize; 2]) -> f64 {
    libm::log(coarse / fine) / libm::log(cells[1] as f64 / cells[0] as f64)
}
