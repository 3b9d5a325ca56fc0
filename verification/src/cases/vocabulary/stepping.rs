//! Motion to a fixed time, and the fields at its end.

use std::collections::BTreeMap;

use proctor_scene::simulation::{Options, Simulation, StepInfo};
use proctor_scene::{OnImbalance, Scene, TimeStep};

use crate::case::{CurvePoint, Measurements, Quantity, Run, RungResult};
use crate::convergence::relative_l2;
use crate::study::{Failure, Observer, Phase, STOPPED};

const REPORTS: u64 = 100; // Number of times, about, that progress is told

/// Name of the error of the displacement among the quantities.
pub const DISPLACEMENT: &str = "L2(u)";
/// Name of the error of the stress.
pub const STRESS: &str = "L2(stress)";

/// Runs a step, no further than `stop` (s), unless the observer ends the run.
///
/// # Errors
/// If the step fails, the run is not to be trusted, or it was stopped.
pub fn step(
    simulation: &mut Simulation,
    stop: f64,
    observer: &dyn Observer,
) -> Result<StepInfo, Failure> {
    if observer.stop() {
        return Err(STOPPED.into());
    }
    Ok(simulation.step(stop)?)
}

/// Runs `steps` equal steps.
///
/// # Errors
/// As [`step`].
pub fn advance(
    simulation: &mut Simulation,
    steps: u64,
    observer: &mut dyn Observer,
) -> Result<(), Failure> {
    let every = (steps / REPORTS).max(1);
    let end = simulation.scene().time;
    observer.phase(Phase::Stepping);
    while simulation.steps() < steps {
        step(simulation, end, observer)?;
        if simulation.steps().is_multiple_of(every) {
            observer.progress(simulation.steps() as f64 / steps as f64);
        }
    }
    observer.phase(Phase::Comparing);
    Ok(())
}

/// Steps until `stop` (s), telling progress towards the end of the scene; `after` sees the simulation after each step.
///
/// # Errors
/// As [`step`].
pub fn run_until(
    simulation: &mut Simulation,
    stop: f64,
    observer: &mut dyn Observer,
    mut after: impl FnMut(&Simulation),
) -> Result<(), Failure> {
    let end = simulation.scene().time;
    observer.phase(Phase::Stepping);
    while simulation.time() < stop {
        step(simulation, stop, observer)?;
        after(simulation);
        if simulation.steps().is_multiple_of(50) {
            observer.progress((simulation.time() / end).min(1.0));
        }
    }
    observer.phase(Phase::Comparing);
    Ok(())
}

/// Runs to the end of the scene: `after` sees the simulation after each step, and `look` at the end of each interval
/// \[s\]; it also gets the number of the interval, from 1.
///
/// # Errors
/// As [`step`], or what `look` says.
pub fn at_intervals(
    simulation: &mut Simulation,
    interval: f64,
    observer: &mut dyn Observer,
    mut after: impl FnMut(&Simulation),
    mut look: impl FnMut(&Simulation, usize) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let count = (simulation.scene().time / interval).round() as usize;
    for k in 1..=count {
        run_until(simulation, k as f64 * interval, observer, &mut after)?;
        observer.progress(k as f64 / count as f64);
        look(simulation, k)?;
    }
    Ok(())
}

/// A quantity that is itself a relative error; NaN, which no gate passes, where there is none.
pub fn ratio(name: &'static str, error: Option<f64>) -> Quantity {
    Quantity::of_zero(name, error.unwrap_or(f64::NAN))
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
            Some((simulation.particle_mass(0, p), computed, exact))
        })
        .collect::<Option<_>>()?;
    relative_l2(samples)
}

/// The same of means over the particles of each cell at the start. With GIMP and two particles per cell and axis all of them have
/// the strain of the cell, and the stress of each is off by the slope of the field times h/4, whatever else is right.
pub fn l2_of_cells<const N: usize>(
    simulation: &Simulation,
    mut field: impl FnMut(usize, [f64; 3]) -> Option<([f64; N], [f64; N])>,
) -> Option<f64> {
    let mesh = &simulation.scene().mesh;
    let mut cells: BTreeMap<[i64; 2], (f64, [f64; N], [f64; N])> = BTreeMap::new();
    for p in 0..simulation.sets()[0].len() {
        let x = simulation.initial_position(0, p)?;
        let (computed, exact) = field(p, x)?;
        let mass = simulation.particle_mass(0, p);
        let at = [0, 1].map(|axis| ((x[axis] - mesh.origin[axis]) / mesh.cell[axis]) as i64);
        let cell = cells.entry(at).or_insert((0.0, [0.0; N], [0.0; N]));
        cell.0 += mass;
        for i in 0..N {
            cell.1[i] += mass * computed[i];
            cell.2[i] += mass * exact[i];
        }
    }
    let means = cells.into_values().map(|(mass, computed, exact)| {
        (
            mass,
            computed.map(|of| of / mass),
            exact.map(|of| of / mass),
        )
    });
    relative_l2(means.collect::<Vec<_>>())
}

/// Points of a picture along one axis, one of each layer of particles: `field` gives computed and exact values of a particle
/// of the first body by its number and its initial place (m).
pub fn along(
    simulation: &Simulation,
    axis: usize,
    field: impl Fn(usize, f64) -> [f64; 2],
) -> Option<Vec<CurvePoint>> {
    let point = |p| {
        let at = simulation.initial_position(0, p)?[axis];
        let [computed, exact] = field(p, at);
        Some(CurvePoint::new(at, computed, exact))
    };
    let points = (0..simulation.sets()[0].len()).map(point);
    let mut points: Vec<_> = points.collect::<Option<_>>()?;
    let cell = simulation.scene().mesh.cell[axis];
    CurvePoint::one_per_place(&mut points, 1e-6 * cell);
    Some(points)
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

impl Run<'_> {
    /// Number of equal steps to the end of the scene; one where steps are not equal.
    #[must_use]
    pub fn equal_steps(&self) -> u64 {
        let scene = self.simulation.scene();
        match scene.time_step {
            TimeStep::Fixed { dt, .. } => (scene.time / dt).round() as u64,
            _ => 1,
        }
    }

    /// Runs all steps of a scene with equal ones.
    ///
    /// # Errors
    /// A step that fails, and an observer that stops the run.
    pub fn advance(&mut self) -> Result<(), Failure> {
        let steps = self.equal_steps();
        advance(self.simulation, steps, self.observer)
    }

    /// Time that the simulation has reached \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// Cauchy stress of a particle of the first body \[Pa: xx, yy, zz, yz, xz, xy\].
    #[must_use]
    pub fn stress(&self, particle: usize) -> [f64; 6] {
        self.simulation.sets()[0].stress(particle)
    }

    /// Errors of displacement and stress of the first body against exact fields, over their norms.
    pub fn errors(
        &self,
        displacement: impl Fn([f64; 3]) -> [f64; 3],
        stress: impl Fn([f64; 3]) -> [f64; 6],
    ) -> Vec<Quantity> {
        errors(self.simulation, displacement, stress)
    }

    /// A curve of the first body along an axis, with the exact one.
    pub fn along(
        &self,
        axis: usize,
        field: impl Fn(usize, f64) -> [f64; 2],
    ) -> Option<Vec<CurvePoint>> {
        along(self.simulation, axis, field)
    }
}

/// Sets up a simulation of a scene, steps and compares it by `run`.
///
/// # Errors
/// If the scene is refused, or the error of `run`.
pub fn simulate(
    mut scene: Scene,
    options: &Options,
    run: impl FnOnce(&mut Simulation) -> Result<Measurements, Failure>,
) -> Result<RungResult, Failure> {
    scene.on_imbalance = OnImbalance::Stop;
    scene.check()?;
    let mut simulation = Simulation::new(&scene, options)?;
    let found = run(&mut simulation)?;
    Ok(RungResult::new(found, &simulation))
}
