//! A scene on one mesh: its history, impulses of contact, and extents of the bodies that flow.

use super::dense::Dense;
use super::extent::Extents;
use super::stages;
use crate::measure::{Spent, Stopwatch};
use proctor_files::run::HistoryRows;
use proctor_scene::simulation::{Options, SetupError, Simulation};
use proctor_scene::{Probe, Scene, TimeStep, Vector};
use proctor_verification::refine::field::Snapshot;
use proctor_verification::refine::point::MaterialPoint;
use std::collections::BTreeMap;

/// Output times of a scene that writes none.
const OUTPUTS: usize = 20;
/// Components of the stress.
const STRESS: [&str; 6] = ["sxx", "syy", "szz", "syz", "sxz", "sxy"];
/// Names of the axes.
pub const LETTERS: [&str; 3] = ["x", "y", "z"];

/// A scene on one mesh, run.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshRun {
    /// Cell size \[m\].
    pub cell: f64,
    /// Number of cells along each axis.
    pub cells: Vec<usize>,
    /// Number of particles at the start.
    pub particles: usize,
    /// Number of steps.
    pub steps: u64,
    /// Time that it took.
    pub spent: Spent,
    /// Output times \[s\], the start first.
    pub times: Vec<f64>,
    /// Values by the name of their column, one for each time.
    pub columns: BTreeMap<String, Vec<f64>>,
    /// Lower and upper corner of the box that held all particles at all output times \[m\].
    pub bounds: [Vector; 2],
    /// Fields of the particles, where the caller wants them.
    pub snapshot: Option<Snapshot>,
    /// The reason why the run failed.
    pub fault: Option<String>,
    /// True where Ctrl-C ended it.
    pub interrupted: bool,
}

/// A pause of the steps.
enum Pause {
    /// A state is wanted for the history.
    Row,
    /// An output time.
    Stop,
    /// A step failed, with its reason, or the caller ended the run.
    Ended(Option<String>),
}

impl MeshRun {
    /// Run of a scene that never began, since a stage before it failed or was interrupted.
    fn without_steps(
        scene: &Scene,
        spent: Spent,
        fault: Option<String>,
        interrupted: bool,
    ) -> Self {
        let axes = scene.dimension.axes();
        Self {
            cell: scene.size_of_cell(),
            cells: scene.mesh.cells[..axes].to_vec(),
            particles: 0,
            steps: 0,
            spent,
            times: vec![],
            columns: BTreeMap::new(),
            bounds: [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
            snapshot: None,
            fault,
            interrupted,
        }
    }
}

/// Runs a scene behind the stages that come before it on the same mesh. `go` hears in every step of the share that is done
/// and answers whether to go on. The fields of the particles are kept at the last output until `snapshot_at` \[s\], where that
/// is given. A history with an interval of its own is read at its multiples, between the two states around each, so that no
/// step is cut for it.
///
/// # Errors
/// The reason why the scene cannot be set up.
pub fn run(
    scene: &Scene,
    earlier: &[Scene],
    options: &Options,
    snapshot_at: Option<f64>,
    go: &(dyn Fn(f64) -> bool + Sync),
) -> Result<MeshRun, Box<SetupError>> {
    let (scene, probes) = prepared(scene);
    let mut options = with_displacement(options);
    let mut stopwatch = Stopwatch::default();
    let stages = earlier.len() as f64 + 1.0;
    let settled =
        stopwatch.time(|| stages::run(earlier, &scene, &options, &|done| go(done / stages)));
    let (start, fault, interrupted) = match settled? {
        stages::StagesEnd::At(start) => (start, None, false),
        stages::StagesEnd::Failed(fault) => (None, Some(fault), false),
        stages::StagesEnd::Interrupted => (None, None, true),
    };
    if fault.is_some() || interrupted {
        return Ok(MeshRun::without_steps(
            &scene,
            stopwatch.spent,
            fault,
            interrupted,
        ));
    }
    options.start = start;
    let go = |share: f64| go((stages - 1.0 + share) / stages);
    let simulation = stopwatch.time(|| Simulation::new(&scene, &options));
    let mut simulation = simulation.map_err(Box::new)?;
    let mut recorder = Recorder::new(&simulation, &probes);
    let mut dense = scene.results.history_interval.map(Dense::new);
    recorder.note(&mut simulation);
    let particles = simulation.particles();
    let (mut fault, mut interrupted) = (None, false);
    let mut snapshot = None;
    let outputs = scene.results.print as f64;
    let team = simulation.team();
    for number in 1..=scene.results.print {
        let stop = scene.time * (number as f64 / outputs);
        let slack = match scene.time_step {
            TimeStep::Fixed { dt, .. } => 0.5 * dt,
            _ => 0.0,
        };
        let (simulation, recorder, dense) = (&mut simulation, &mut recorder, &mut dense);
        let ended = stopwatch.time(|| {
            loop {
                let pause = team.lead(|| {
                    while simulation.time() + slack < stop {
                        let info = match simulation.step(stop) {
                            Err(error) => return Pause::Ended(Some(error.to_string())),
                            Ok(info) => info,
                        };
                        recorder.add_impulses(simulation, info.dt);
                        if !go(simulation.time() / scene.time) {
                            return Pause::Ended(None);
                        }
                        if dense
                            .as_ref()
                            .is_some_and(|dense| dense.is_near(simulation.time(), info.dt))
                        {
                            return Pause::Row;
                        }
                    }
                    Pause::Stop
                });
                match (pause, &mut *dense) {
                    (Pause::Row, Some(dense)) => {
                        let row = recorder.row(simulation);
                        for (time, row) in dense.rows(simulation.time(), row) {
                            recorder.push(time, row);
                        }
                        recorder.add_bounds(simulation);
                    }
                    (Pause::Row, None) => {}
                    (Pause::Stop, _) => return None,
                    (Pause::Ended(fault), _) => return Some(fault),
                }
            }
        });
        match ended {
            None => {
                if dense.is_none() {
                    recorder.note(simulation);
                }
                let next = stop + scene.time / outputs;
                if snapshot_at.is_some_and(|time| (stop..next).contains(&(time * (1.0 + 1e-9)))) {
                    snapshot = Some(Snapshot::of(simulation));
                }
            }
            Some(error) => {
                interrupted = error.is_none();
                fault = error;
                break;
            }
        }
    }
    let axes = scene.dimension.axes();
    Ok(MeshRun {
        cell: scene.size_of_cell(),
        cells: scene.mesh.cells[..axes].to_vec(),
        particles,
        steps: simulation.steps(),
        spent: stopwatch.spent,
        times: recorder.times,
        columns: recorder.names.into_iter().zip(recorder.columns).collect(),
        bounds: recorder.bounds,
        snapshot,
        fault,
        interrupted,
    })
}

/// Names of the columns that a scene gives.
///
/// # Errors
/// The reason why the scene cannot be set up.
pub fn columns(scene: &Scene, options: &Options) -> Result<Vec<String>, Box<SetupError>> {
    let (scene, probes) = prepared(scene);
    let options = with_displacement(options);
    let simulation = Simulation::new(&scene, &options).map_err(Box::new)?;
    Ok(Recorder::new(&simulation, &probes).names)
}

/// The scene without the probes of points, which are read at material points instead, and with outputs; and those points, each
/// with the prefix of its columns.
fn prepared(scene: &Scene) -> (Scene, Vec<(String, Vector)>) {
    let mut scene = scene.clone();
    let probes = scene.probes.iter().flat_map(Probe::points).collect();
    scene.probes.retain(|probe| probe.points().is_empty());
    scene.results.checkpoint = false;
    if scene.results.print == 0 {
        scene.results.print = OUTPUTS;
    }
    (scene, probes)
}

fn with_displacement(options: &Options) -> Options {
    Options {
        displacement: true,
        ..options.clone()
    }
}

/// Columns of a run as they grow.
struct Recorder {
    rows: HistoryRows,
    points: Vec<(String, Option<MaterialPoint>)>,
    extents: Extents,
    /// Sets and surfaces with contact, each with its impulse so far \[N s\].
    impulses: Vec<(ContactSide, Vector)>,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    times: Vec<f64>,
    bounds: [Vector; 2],
}

/// A body or a rigid surface that contact pushes, by its place.
#[derive(Clone, Copy)]
enum ContactSide {
    Body(usize),
    Surface(usize),
}

impl Recorder {
    fn new(simulation: &Simulation, probes: &[(String, Vector)]) -> Self {
        let letters = &LETTERS[..simulation.plan().axes];
        let rows = HistoryRows::new(simulation);
        let mut names = rows.columns(simulation);
        let points: Vec<(String, Option<MaterialPoint>)> = probes
            .iter()
            .map(|(name, position)| (name.clone(), MaterialPoint::at(simulation, position)))
            .collect();
        for (name, _) in &points {
            names.extend(letters.iter().map(|l| format!("{name}_u{l}")));
            names.extend(letters.iter().map(|l| format!("{name}_v{l}")));
            names.extend(STRESS.iter().map(|s| format!("{name}_{s}")));
        }
        let bodies = 0..simulation.sets().len();
        let touched = bodies.filter(|set| simulation.has_contact(*set));
        let surfaces = 0..simulation.scene().surfaces.len();
        let impulses: Vec<(ContactSide, Vector)> = touched
            .map(ContactSide::Body)
            .chain(surfaces.map(ContactSide::Surface))
            .map(|touched| (touched, [0.0; 3]))
            .collect();
        for (touched, _) in &impulses {
            let of = match touched {
                ContactSide::Body(set) => format!("body{}", simulation.body(*set).id),
                ContactSide::Surface(surface) => format!("surface{surface}"),
            };
            names.extend(letters.iter().map(|l| format!("{of}_impulse_{l}")));
        }
        let extents = Extents::new(simulation);
        names.extend(extents.names());
        Self {
            rows,
            points,
            extents,
            impulses,
            columns: vec![vec![]; names.len()],
            names,
            times: vec![],
            bounds: [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
        }
    }

    /// Adds what contact pushed in a step of `dt` \[s\].
    fn add_impulses(&mut self, simulation: &Simulation, dt: f64) {
        for (touched, impulse) in &mut self.impulses {
            let force = match touched {
                ContactSide::Body(set) => simulation.contact_force(*set),
                ContactSide::Surface(surface) => simulation.surface_force(*surface),
            };
            *impulse = std::array::from_fn(|axis| impulse[axis] + dt * force[axis]);
        }
    }

    /// Adds a value to every column.
    fn note(&mut self, simulation: &mut Simulation) {
        let row = self.row(simulation);
        self.push(simulation.time(), row);
        self.add_bounds(simulation);
    }

    /// The values of all columns.
    fn row(&self, simulation: &mut Simulation) -> Vec<f64> {
        let energy = simulation.energy();
        let simulation = &*simulation;
        let axes = simulation.plan().axes;
        let mut row = self.rows.row(simulation, &energy);
        for (_, point) in &self.points {
            let values: [f64; 12] = point.as_ref().map_or([f64::NAN; 12], |point| {
                let particles = &simulation.sets()[point.set];
                point.values(simulation, |p| {
                    let u = simulation.displacement(point.set, p).unwrap_or_default();
                    let (v, s) = (particles.velocity(p), particles.stress(p));
                    [
                        u[0], u[1], u[2], v[0], v[1], v[2], s[0], s[1], s[2], s[3], s[4], s[5],
                    ]
                })
            });
            row.extend_from_slice(&values[..axes]);
            row.extend_from_slice(&values[3..3 + axes]);
            row.extend_from_slice(&values[6..]);
        }
        for (_, impulse) in &self.impulses {
            row.extend_from_slice(&impulse[..axes]);
        }
        row.extend(self.extents.values(simulation));
        row
    }

    /// Adds a row of a time \[s\].
    fn push(&mut self, time: f64, row: Vec<f64>) {
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
        self.times.push(time);
    }

    fn add_bounds(&mut self, simulation: &Simulation) {
        for set in 0..simulation.sets().len() {
            for p in 0..simulation.sets()[set].len() {
                let x = simulation.position(set, p);
                let [low, high] = &mut self.bounds;
                *low = std::array::from_fn(|axis| low[axis].min(x[axis]));
                *high = std::array::from_fn(|axis| high[axis].max(x[axis]));
            }
        }
    }
}
