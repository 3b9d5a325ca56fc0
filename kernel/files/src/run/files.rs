//! The state of a simulation as frames, history rows and checkpoints.

use super::frames::{self, FramePart, FrameTarget};
use super::history::HistoryRows;
use super::schedule::{HistorySchedule, NOMINAL_TIME};
use super::{RunError, boundaries, grid, ranks, state};
use crate::output::checkpoint::CHECKPOINT;
use crate::output::earlier;
use crate::output::pvd::{BOUNDARIES, GRID, PARTICLES};
use crate::output::{Compression, HistoryWriter, OutputFolder, Series};
use proctor_scene::simulation::{ResultWarning, Simulation};
use std::path::{Path, PathBuf};

/// The outputs of a run. Each rank has them; the first one has the files that grow.
pub(super) struct Files {
    path: PathBuf,
    /// The growing files, on the first rank.
    growing: Option<GrowingFiles>,
    rows: HistoryRows,
    /// Reasons for caution at the outputs so far, of each kind the one that says most.
    cautions: Vec<ResultWarning>,
    /// True for frames in a piece of each rank, whatever their number of points.
    in_pieces: bool,
}

/// The growing files of a run.
struct GrowingFiles {
    folder: OutputFolder,
    series: Option<Series>,
    /// Frames of the nodes, where the scene asks for nodal fields.
    grid: Option<Series>,
    /// Frames of the boundaries, where the scene has any.
    boundaries: Option<Series>,
    history: Option<HistoryWriter>,
    /// States with a row, where the history has an interval of its own.
    schedule: Option<HistorySchedule>,
}

/// Outputs of the present state that the files do not have yet.
struct OutputsDue {
    /// A state that is later than the last output.
    output: bool,
    row: bool,
    particles: bool,
    grid: bool,
    boundaries: bool,
    checkpoint: bool,
}

impl Files {
    /// Makes the files in a folder, or after a restart goes on with them. What an earlier run left there goes where this one begins
    /// anew. All ranks call this at the same time, as they call the other functions; the errors are those of this rank.
    pub(super) fn open(
        simulation: &Simulation,
        path: &Path,
        resume: bool,
        in_pieces: bool,
    ) -> Result<Self, RunError> {
        let rows = HistoryRows::new(simulation);
        let first = simulation.ranks().is_none_or(|ranks| ranks.rank() == 0);
        let growing = first.then(|| GrowingFiles::open(simulation, &rows, path, resume));
        Ok(Self {
            path: path.to_path_buf(),
            growing: growing.transpose()?,
            rows,
            cautions: vec![],
            in_pieces,
        })
    }

    /// Reasons for caution at the outputs so far.
    pub(super) fn cautions(&self) -> &[ResultWarning] {
        &self.cautions
    }

    /// The folder, on the first rank.
    pub(super) fn folder(&self) -> Option<&OutputFolder> {
        self.growing.as_ref().map(|growing| &growing.folder)
    }

    /// True where the present state has a row in a history with an interval of its own; of ranks the first one knows.
    pub(super) fn is_row_due(&self, simulation: &Simulation) -> bool {
        let schedule = self
            .growing
            .as_ref()
            .and_then(|growing| growing.schedule.as_ref());
        schedule.is_some_and(|schedule| schedule.is_due(simulation.clock()))
    }

    /// Writes the row of the present state into a history with an interval of its own, where it is to have one.
    pub(super) fn write_due_row(&mut self, simulation: &mut Simulation) -> Result<(), RunError> {
        let [due] = ranks::any(simulation.ranks(), [self.is_row_due(simulation)]);
        if !due {
            return Ok(());
        }
        let energy = simulation.energy();
        let mut row = self.rows.row(simulation, &energy);
        let growing = self.growing.as_mut();
        let written = growing.map_or(Ok(()), |growing| {
            let schedule = growing.schedule.as_mut();
            row.extend(schedule.map(|schedule| schedule.take(simulation.clock())));
            growing.append(simulation, &row)
        });
        ranks::agree(simulation.ranks(), written)
    }

    /// Writes frame, history row and checkpoint; what a resumed file already has is left as it is.
    pub(super) fn write(&mut self, simulation: &mut Simulation) -> Result<(), RunError> {
        self.write_due_row(simulation)?;
        let due = self.due(simulation);
        let row = due.output.then(|| {
            let energy = simulation.energy();
            worst(&mut self.cautions, simulation.cautions(&energy));
            due.row.then(|| self.rows.row(simulation, &energy))
        });
        simulation.note_extremes();
        let simulation = &*simulation;
        if due.particles {
            self.write_frame(PARTICLES, &frames::of_particles(simulation), simulation)?;
        }
        if due.grid {
            self.write_frame(GRID, &grid::frame(simulation), simulation)?;
        }
        if due.boundaries {
            let frame = FramePart::whole(boundaries::frame(simulation));
            self.write_frame(BOUNDARIES, &frame, simulation)?;
        }
        if let Some(Some(row)) = row {
            let growing = self.growing.as_mut();
            let written = growing.map_or(Ok(()), |growing| growing.append(simulation, &row));
            ranks::agree(simulation.ranks(), written)?;
        }
        if due.checkpoint {
            state::write(simulation, &self.path.join(CHECKPOINT))?;
        }
        Ok(())
    }

    /// Outputs that the files lack. The first rank tells the others.
    fn due(&self, simulation: &Simulation) -> OutputsDue {
        let here = self.growing.as_ref();
        let here = here.map_or([false; 6], |growing| growing.due(simulation));
        let [output, row, particles, grid, boundaries, checkpoint] =
            ranks::any(simulation.ranks(), here);
        OutputsDue {
            output,
            row,
            particles,
            grid,
            boundaries,
            checkpoint,
        }
    }

    fn write_frame(
        &mut self,
        stem: &'static str,
        part: &FramePart,
        simulation: &Simulation,
    ) -> Result<(), RunError> {
        let growing = self.growing.as_mut();
        let series = growing.and_then(|growing| match stem {
            GRID => growing.grid.as_mut(),
            BOUNDARIES => growing.boundaries.as_mut(),
            _ => growing.series.as_mut(),
        });
        let target = FrameTarget {
            stem,
            folder: &self.path,
            series,
            in_pieces: self.in_pieces,
        };
        frames::write(part, target, simulation.ranks())
    }
}

impl GrowingFiles {
    fn open(
        simulation: &Simulation,
        rows: &HistoryRows,
        path: &Path,
        resume: bool,
    ) -> Result<Self, RunError> {
        let folder = OutputFolder::claim(path)?;
        if !resume {
            earlier::clear(&folder)?;
        }
        let mut files = Self {
            folder,
            series: None,
            grid: None,
            boundaries: None,
            history: None,
            schedule: None,
        };
        let results = &simulation.scene().results;
        let time = simulation.time();
        if results.writes_history() {
            let mut columns = rows.columns(simulation);
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
            let series = |stem| {
                let folder = files.folder.clone();
                if resume {
                    Series::resume_named(folder, stem, Compression::None, time)
                } else {
                    Series::create_named(folder, stem, Compression::None)
                }
            };
            files.series = Some(series(PARTICLES)?);
            if !results.nodal_fields.is_empty() {
                files.grid = Some(series(GRID)?);
            }
            if simulation.has_boundaries() {
                files.boundaries = Some(series(BOUNDARIES)?);
            }
        }
        Ok(files)
    }

    /// Outputs that the files lack: any at all, a row, frames of particles, nodes and boundaries, a checkpoint.
    fn due(&self, simulation: &Simulation) -> [bool; 6] {
        let time = simulation.time();
        let is_later = |last: Option<f64>| last.is_none_or(|last| last < time);
        let is_missing =
            |series: &Option<Series>| series.as_ref().is_some_and(|s| is_later(s.last_time()));
        let rows_are_frames = self.schedule.is_none();
        let output = match &self.history {
            Some(history) if rows_are_frames => is_later(history.last_time()),
            _ => is_missing(&self.series),
        };
        [
            output,
            rows_are_frames && self.history.is_some(),
            is_missing(&self.series),
            is_missing(&self.grid),
            is_missing(&self.boundaries),
            simulation.scene().results.checkpoint && self.series.is_some(),
        ]
    }

    fn append(&mut self, simulation: &Simulation, row: &[f64]) -> Result<(), RunError> {
        if let Some(history) = &mut self.history {
            history.append(simulation.time(), simulation.steps(), row)?;
        }
        Ok(())
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
