//! The state of a simulation as frames, history rows and checkpoints.

use super::history::HistoryRows;
use super::probes::{STRESS, by_identifier};
use super::schedule::{HistorySchedule, NOMINAL_TIME};
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
    rows: HistoryRows,
    /// States with a row, where the history has an interval of its own.
    schedule: Option<HistorySchedule>,
    /// Reasons for caution at the outputs so far, of each kind the one that says most.
    cautions: Vec<ResultWarning>,
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
            rows: HistoryRows::new(simulation),
            schedule: None,
            cautions: vec![],
        };
        let results = &simulation.scene().results;
        let time = simulation.time();
        if results.writes_history() {
            let mut columns = files.rows.columns(simulation);
            columns.extend(results.history_interval.map(|_| NOMINAL_TIME.to_owned()));
            let history = if resume {
                HistoryWriter::resume(&files.folder, &columns, time)?.0
            } else {
                HistoryWriter::create(&files.folder, &columns)?
            };
            let last = history.last_time();
            files.schedule = results
                .history_interval
                .map(|interval| HistorySchedule::new(interval, simulation.clock(), last));
            files.history = Some(history);
        }
        if results.print > 0 {
            files.series = Some(if resume {
                Series::resume(files.folder.clone(), Compression::None, time)?
            } else {
                Series::create(files.folder.clone(), Compression::None)?
            });
            let series = |stem| {
                let folder = files.folder.clone();
                if resume {
                    Series::resume_named(folder, stem, Compression::None, time)
                } else {
                    Series::create_named(folder, stem, Compression::None)
                }
            };
            if !results.nodal_fields.is_empty() {
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

    /// True where the present state has a row in a history with an interval of its own.
    pub(super) fn is_row_due(&self, simulation: &Simulation) -> bool {
        let schedule = self.schedule.as_ref();
        schedule.is_some_and(|schedule| schedule.is_due(simulation.clock()))
    }

    /// Writes the row of the present state into a history with an interval of its own, where it is to have one.
    pub(super) fn write_due_row(&mut self, simulation: &mut Simulation) -> Result<(), RunError> {
        if let (Some(schedule), Some(history)) = (&mut self.schedule, &mut self.history)
            && schedule.is_due(simulation.clock())
        {
            let energy = simulation.energy();
            let mut row = self.rows.row(simulation, &energy);
            row.push(schedule.take(simulation.clock()));
            history.append(simulation.time(), simulation.steps(), &row)?;
        }
        Ok(())
    }

    /// Writes frame, history row and checkpoint; what a resumed file already has is left as it is.
    pub(super) fn write(&mut self, simulation: &mut Simulation) -> Result<(), RunError> {
        self.write_due_row(simulation)?;
        let time = simulation.time();
        let is_later = |last: Option<f64>| last.is_none_or(|last| last < time);
        let rows_are_frames = self.schedule.is_none();
        let is_new = match (&self.series, &self.history) {
            (_, Some(history)) if rows_are_frames => is_later(history.last_time()),
            (series, _) => series.as_ref().is_some_and(|s| is_later(s.last_time())),
        };
        let row = is_new.then(|| {
            let energy = simulation.energy();
            worst(&mut self.cautions, simulation.cautions(&energy));
            rows_are_frames.then(|| self.rows.row(simulation, &energy))
        });
        simulation.note_extremes();
        let simulation = &*simulation;
        if let Some(series) = &mut self.series
            && is_later(series.last_time())
        {
            series.write_frame(&frame(simulation))?;
        }
        if let Some(grid) = &mut self.grid
            && is_later(grid.last_time())
            && let Some(frame) = grid::frame(simulation)
        {
            grid.write_frame(&frame)?;
        }
        if let Some(boundaries) = &mut self.boundaries
            && is_later(boundaries.last_time())
        {
            boundaries.write_frame(&boundaries::frame(simulation))?;
        }
        if let (Some(history), Some(Some(row))) = (&mut self.history, row) {
            history.append(time, simulation.steps(), &row)?;
        }
        if simulation.scene().results.checkpoint && self.series.is_some() {
            state::save(simulation).write(&self.folder.file(CHECKPOINT))?;
        }
        Ok(())
    }
}

/// Arrays of pore water, where there is any.
fn of_water(simulation: &Simulation, arrays: impl FnOnce() -> Vec<Array>) -> Vec<Array> {
    if simulation.has_water() {
        arrays()
    } else {
        vec![]
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

/// The particles in order of the identifier with the fields of the scene.
pub(super) fn frame(simulation: &Simulation) -> Frame {
    let mut order: Vec<(usize, usize)> = vec![];
    for (s, set) in simulation.sets().iter().enumerate() {
        order.extend(by_identifier(set).into_iter().map(|p| (s, p)));
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
        Field::Material => integer("Material Id", &|s, _| simulation.body(s).material_id),
        Field::Body => integer("Body Id", &|s, _| simulation.body(s).id),
        Field::Active => integer("Active", &|_, _| 1),
        Field::Mass => scalar("Mass", &|s, p| simulation.particle_mass(s, p)),
        Field::Volume => scalar("Volume", &|s, p| simulation.particle_volume(s, p)),
        Field::Density => scalar("Density", &|s, p| {
            simulation.particle_mass(s, p) / simulation.particle_volume(s, p)
        }),
        Field::Displacement => vector("Displacement", &|s, p| {
            simulation.displacement(s, p).unwrap_or_default()
        }),
        Field::Velocity => vector("Velocity", &|s, p| set(s).velocity(p))
            .into_iter()
            .chain(of_water(simulation, || {
                vector("Water Velocity", &|s, p| {
                    let first = set(s).layout.water;
                    first.map_or([f64::NAN; 3], |first| set(s).vector(first, p))
                })
            }))
            .collect(),
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
        })
        .into_iter()
        .chain(of_water(simulation, || {
            scalar("Pore Pressure", &|s, p| {
                let column = set(s).layout.pore_pressure();
                column.map_or(f64::NAN, |column| set(s).columns[column][p])
            })
        }))
        .collect(),
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
