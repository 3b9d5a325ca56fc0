//! The state of a simulation as frames, history rows and checkpoints.

use super::{RunError, boundaries, grid, state};
use crate::output::checkpoint::CHECKPOINT;
use crate::output::earlier;
use crate::output::pvd::{BOUNDARIES, GRID};
use crate::output::{Array, ArrayData, Compression, Frame, HistoryWriter, OutputFolder, Series};
use proctor_kernel::particles::ParticleSet;
use proctor_scene::Field;
use proctor_scene::simulation::{ResultWarning, Simulation};

/// The growing files of a run.
pub(super) struct Files {
    folder: OutputFolder,
    series: Option<Series>,
    /// Frames of the nodes, where the scene asks for nodal fields.
    grid: Option<Series>,
    /// Frames of the boundaries, where the scene has any.
    boundaries: Option<Series>,
    history: Option<HistoryWriter>,
    probes: Vec<ProbedParticle>,
    /// Reasons for caution at the outputs so far, of each kind the one that says most.
    cautions: Vec<ResultWarning>,
}

/// A probe and the particle that it follows.
struct ProbedParticle {
    name: String,
    set: usize,
    id: u64,
}

impl Files {
    /// Makes the files, or after a restart goes on with them. What an earlier run left there goes where this one begins anew.
    pub(super) fn open(
        simulation: &Simulation,
        folder: OutputFolder,
        resume: bool,
    ) -> Result<Self, RunError> {
        if !resume {
            earlier::clear(&folder)?;
        }
        let mut files = Self {
            folder,
            series: None,
            grid: None,
            boundaries: None,
            history: None,
            probes: probed(simulation),
            cautions: vec![],
        };
        if simulation.scene().results.print > 0 {
            let columns = files.columns(simulation);
            let time = simulation.time();
            if resume {
                files.series = Some(Series::resume(
                    files.folder.clone(),
                    Compression::None,
                    time,
                )?);
                files.history = Some(HistoryWriter::resume(&files.folder, &columns, time)?.0);
            } else {
                files.series = Some(Series::create(files.folder.clone(), Compression::None)?);
                files.history = Some(HistoryWriter::create(&files.folder, &columns)?);
            }
            let series = |stem| {
                let folder = files.folder.clone();
                if resume {
                    Series::resume_named(folder, stem, Compression::None, time)
                } else {
                    Series::create_named(folder, stem, Compression::None)
                }
            };
            if !simulation.scene().results.nodal_fields.is_empty() {
                files.grid = Some(series(GRID)?);
            }
            if simulation.has_boundaries() {
                files.boundaries = Some(series(BOUNDARIES)?);
            }
        }
        Ok(files)
    }

    /// Reasons for caution at the outputs so far.
    pub(super) fn cautions(&self) -> &[ResultWarning] {
        &self.cautions
    }

    pub(super) fn folder(&self) -> &OutputFolder {
        &self.folder
    }

    /// Writes frame, history row and checkpoint; what a resumed file already has is left as it is.
    pub(super) fn write(&mut self, simulation: &mut Simulation) -> Result<(), RunError> {
        let time = simulation.time();
        let history = self.history.as_ref();
        let wanted =
            history.is_some_and(|history| history.last_time().is_none_or(|last| last < time));
        let row = wanted.then(|| self.row(simulation));
        simulation.note_extremes();
        let simulation = &*simulation;
        if let Some(series) = &mut self.series
            && series.last_time().is_none_or(|last| last < time)
        {
            series.write_frame(&frame(simulation))?;
        }
        if let Some(grid) = &mut self.grid
            && grid.last_time().is_none_or(|last| last < time)
            && let Some(frame) = grid::frame(simulation)
        {
            grid.write_frame(&frame)?;
        }
        if let Some(boundaries) = &mut self.boundaries
            && boundaries.last_time().is_none_or(|last| last < time)
        {
            boundaries.write_frame(&boundaries::frame(simulation))?;
        }
        if let (Some(history), Some(row)) = (&mut self.history, row) {
            history.append(time, simulation.steps(), &row)?;
        }
        if simulation.scene().results.checkpoint && self.series.is_some() {
            state::save(simulation).write(&self.folder.file(CHECKPOINT))?;
        }
        Ok(())
    }

    /// Names of the history columns behind time and step.
    fn columns(&self, simulation: &Simulation) -> Vec<String> {
        let letters = &["x", "y", "z"][..simulation.plan().axes];
        let mut names = vec!["kinetic_energy".to_string(), "strain_energy".into()];
        names.extend(letters.iter().map(|l| format!("momentum_{l}")));
        for set in 0..simulation.sets().len() {
            let (body, _) = simulation.body_and_material(set);
            names.push(format!("body{body}_mass"));
            names.extend(letters.iter().map(|l| format!("body{body}_{l}")));
            names.extend(letters.iter().map(|l| format!("body{body}_v{l}")));
            if simulation.has_contact(set) {
                names.extend(letters.iter().map(|l| format!("body{body}_contact_f{l}")));
            }
        }
        for surface in 0..simulation.scene().surfaces.len() {
            names.extend(
                letters
                    .iter()
                    .map(|l| format!("surface{surface}_contact_f{l}")),
            );
        }
        for probe in &self.probes {
            names.extend(letters.iter().map(|l| format!("{}_u{l}", probe.name)));
            names.extend(letters.iter().map(|l| format!("{}_v{l}", probe.name)));
            names.extend(
                STRESS
                    .iter()
                    .map(|s| format!("{}_s{}", probe.name, s.to_lowercase())),
            );
            let layout = simulation.sets()[probe.set].layout;
            names.extend(layout.components().map(|(variable, i, _)| {
                format!("{}_{}", probe.name, variable.component(i).replace(' ', "_"))
            }));
        }
        names.push("velocity_time".into());
        names.extend(BALANCE.map(str::to_owned));
        if has_drift(simulation) {
            names.extend(DRIFT.map(str::to_owned));
        }
        for (set, _) in simulation.yielding() {
            let (body, _) = simulation.body_and_material(set);
            names.extend(YIELDING.map(|channel| format!("body{body}_energy_{channel}")));
        }
        names
    }

    /// One row of the history; a probed particle that was removed leaves empty cells.
    fn row(&mut self, simulation: &mut Simulation) -> Vec<f64> {
        let energy = simulation.energy();
        let simulation = &*simulation;
        worst(&mut self.cautions, simulation.cautions(&energy));
        let axes = simulation.plan().axes;
        let mut row = vec![simulation.kinetic_energy(), simulation.strain_energy()];
        row.extend_from_slice(&simulation.momentum()[..axes]);
        for set in 0..simulation.sets().len() {
            let (mass, x, v) = simulation.center(set);
            row.push(mass);
            row.extend_from_slice(&x[..axes]);
            row.extend_from_slice(&v[..axes]);
            if simulation.has_contact(set) {
                row.extend_from_slice(&simulation.contact_force(set)[..axes]);
            }
        }
        for surface in 0..simulation.scene().surfaces.len() {
            row.extend_from_slice(&simulation.surface_force(surface)[..axes]);
        }
        for probe in &self.probes {
            let set = &simulation.sets()[probe.set];
            if let Some(p) = set.id.iter().position(|id| *id == probe.id) {
                let u = simulation
                    .displacement(probe.set, p)
                    .unwrap_or([f64::NAN; 3]);
                row.extend_from_slice(&u[..axes]);
                row.extend_from_slice(&set.velocity(p)[..axes]);
                row.extend_from_slice(&set.stress(p));
                row.extend(set.variables(p));
            } else {
                let cells = 2 * axes + STRESS.len() + set.layout.components().count();
                row.extend(std::iter::repeat_n(f64::NAN, cells));
            }
        }
        row.push(simulation.velocity_time());
        row.extend([
            energy.kinetic,
            energy.contact,
            energy.external_work,
            energy.damping,
            energy.friction,
            energy.impact,
            energy.plastic,
            energy.removed,
            energy.remainder,
        ]);
        if has_drift(simulation) {
            // Between two stages all bodies with a boundary may be driven: empty cells.
            let drift = simulation.boundary_drift();
            row.extend(drift.map_or([f64::NAN; 2], |drift| [drift.distance, drift.in_cells]));
        }
        for (_, energy) in simulation.yielding() {
            row.extend([energy.stored, energy.plastic, energy.algorithmic]);
        }
        row
    }
}

/// Adds reasons for caution to others, of each kind the one that says most.
pub(super) fn worst(all: &mut Vec<ResultWarning>, more: Vec<ResultWarning>) {
    for caution in more {
        match all.iter_mut().find(|other| other.is_like(&caution)) {
            Some(other) if other.size() >= caution.size() => {}
            Some(other) => *other = caution,
            None => all.push(caution),
        }
    }
}

/// The energy balance at the time of the row; `kinetic_energy` is that of the velocities, at `velocity_time`.
const BALANCE: [&str; 9] = [
    "energy_kinetic",
    "energy_contact",
    "energy_external_work",
    "energy_damping",
    "energy_friction",
    "energy_impact",
    "energy_plastic",
    "energy_removed",
    "energy_remainder",
];

/// Where the work of the strain of a body went that yields \[J\].
const YIELDING: [&str; 3] = ["stored", "plastic", "algorithmic"];

/// How far the farthest vertex of mortar contact is off its body \[m\], and over the smallest size of a cell.
const DRIFT: [&str; 2] = ["boundary_drift", "boundary_drift_in_cells"];

/// Whether a body has a boundary, whose vertices could drift.
fn has_drift(simulation: &Simulation) -> bool {
    !simulation.scene().mortar.boundaries.is_empty()
}

const STRESS: [&str; 6] = ["XX", "YY", "ZZ", "YZ", "XZ", "XY"];

/// The particle nearest to each probe.
fn probed(simulation: &Simulation) -> Vec<ProbedParticle> {
    let scene = simulation.scene();
    let follow = |position: &[f64; 3]| {
        let mut best: Option<(f64, u64, usize)> = None;
        for (s, set) in simulation.sets().iter().enumerate() {
            for p in 0..set.len() {
                let x = simulation
                    .initial_position(s, p)
                    .unwrap_or_else(|| simulation.position(s, p));
                let square: f64 = (0..simulation.plan().axes)
                    .map(|axis| (x[axis] - position[axis]).powi(2))
                    .sum();
                // Of equally near particles the one with the smallest identifier, whatever their order.
                if best.is_none_or(|(d, id, _)| (square, set.id[p]) < (d, id)) {
                    best = Some((square, set.id[p], s));
                }
            }
        }
        best
    };
    scene
        .probes
        .iter()
        .filter_map(|probe| {
            let (_, id, set) = follow(&probe.position)?;
            Some(ProbedParticle {
                name: probe.name.clone(),
                set,
                id,
            })
        })
        .collect()
}

/// The particles in order of the identifier with the fields of the scene.
fn frame(simulation: &Simulation) -> Frame {
    let mut order: Vec<(usize, usize)> = vec![];
    for (s, set) in simulation.sets().iter().enumerate() {
        let mut own: Vec<usize> = (0..set.len()).collect();
        own.sort_unstable_by_key(|&p| set.id[p]);
        order.extend(own.into_iter().map(|p| (s, p)));
    }
    let mut fields = simulation.scene().results.fields.clone();
    fields.sort_unstable();
    fields.dedup();
    Frame {
        time: simulation.time(),
        step: simulation.steps(),
        points: order
            .iter()
            .map(|&(s, p)| simulation.position(s, p))
            .collect(),
        arrays: fields
            .into_iter()
            .flat_map(|field| arrays(simulation, &order, field))
            .collect(),
        lines: vec![],
    }
}

fn arrays(simulation: &Simulation, order: &[(usize, usize)], field: Field) -> Vec<Array> {
    let set = |s: usize| -> &ParticleSet { &simulation.sets()[s] };
    let scalar = |name: &str, of: &dyn Fn(usize, usize) -> f64| {
        vec![Array::new(
            name,
            ArrayData::Scalar(order.iter().map(|&(s, p)| of(s, p)).collect()),
        )]
    };
    let integer = |name: &str, of: &dyn Fn(usize, usize) -> i64| {
        vec![Array::new(
            name,
            ArrayData::Integer(order.iter().map(|&(s, p)| of(s, p)).collect()),
        )]
    };
    let vector = |name: &str, of: &dyn Fn(usize, usize) -> [f64; 3]| {
        vec![Array::new(
            name,
            ArrayData::Vector(order.iter().map(|&(s, p)| of(s, p)).collect()),
        )]
    };
    match field {
        Field::Id => integer("Particle Id", &|s, p| set(s).id[p] as i64),
        Field::Material => integer("Material Id", &|s, _| simulation.body_and_material(s).1),
        Field::Body => integer("Body Id", &|s, _| simulation.body_and_material(s).0),
        Field::Active => integer("Active", &|_, _| 1),
        Field::Mass => scalar("Mass", &|s, p| simulation.mass_and_volume(s, p).0),
        Field::Volume => scalar("Volume", &|s, p| simulation.mass_and_volume(s, p).1),
        Field::Density => scalar("Density", &|s, p| {
            let (mass, volume) = simulation.mass_and_volume(s, p);
            mass / volume
        }),
        Field::Displacement => vector("Displacement", &|s, p| {
            simulation.displacement(s, p).unwrap_or_default()
        }),
        Field::Velocity => vector("Velocity", &|s, p| set(s).velocity(p)),
        Field::Stress => (0..STRESS.len())
            .flat_map(|i| {
                scalar(&format!("Stress_{}", STRESS[i]), &|s, p| {
                    set(s).stress(p)[i]
                })
            })
            .collect(),
        Field::Pressure => scalar("Pressure", &|s, p| {
            let stress = set(s).stress(p);
            -(stress[0] + stress[1] + stress[2]) / 3.0
        }),
        Field::DeformationGradient => (0..9)
            .flat_map(|i| {
                let name = format!(
                    "Deformation_{}{}",
                    ["X", "Y", "Z"][i / 3],
                    ["X", "Y", "Z"][i % 3]
                );
                scalar(&name, &|s, p| {
                    simulation
                        .deformation(s, p)
                        .map_or(f64::NAN, |f| f[i / 3][i % 3])
                })
            })
            .collect(),
        Field::ExternalForce => vector("External Force", &|s, p| simulation.external_force(s, p)),
        Field::InternalVariables => (simulation.variables().iter())
            .flat_map(|name| {
                let columns: Vec<Option<&[f64]>> = simulation
                    .sets()
                    .iter()
                    .map(|set| set.column(name))
                    .collect();
                scalar(name, &|s, p| {
                    columns[s].map_or(f64::NAN, |column| column[p])
                })
            })
            .collect(),
    }
}
