//! A run: a simulation from output time to output time, with its files.
//!
//! The caller drives it (and may time it: this crate reads no clock):
//!
//! ```text
//! let mut run = Run::start(&scene, &options, Some(folder), None)?;
//! while let Some(stop) = run.next_stop() {
//!     run.advance(stop, |_| RunControl::On)?;   // steps, and rows of a history with an interval of its own
//!     run.write()?;                             // frames, history row, checkpoint
//! }
//! run.summary()
//! ```

mod boundaries;
mod changeable;
mod error;
mod files;
mod forecast;
mod frames;
mod grid;
mod history;
mod loads;
mod probes;
mod ranks;
mod restart;
mod saved_events;
mod schedule;
mod shared_state;
mod start_state;
mod state;

pub use error::RunError;
pub use forecast::{OutputForecast, StepForecast, next_stop};
pub use history::HistoryRows;

use crate::output::summary::{
    OVERLAP, Status, SummaryDrift, SummaryEnergy, SummaryEvent, SummaryMesh, VOLUME_RATIO, Warning,
    YieldingBody,
};
use crate::output::{OutputFolder, Summary};
use files::Files;
use proctor_kernel::ranks::Ranks;
use proctor_scene::Scene;
use proctor_scene::plan::Plan;
use proctor_scene::simulation::{
    BodyEnergy, Energy, Event, EventKind, Options, ResultWarning, Simulation, StartState,
    StepError, StepInfo,
};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// Decision after a step: go on, or stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunControl {
    /// Next step.
    On,
    /// Stop here; the run can be summarised as interrupted.
    Stop,
}

/// Steps between two looks at the balance of forces, each of which costs a step.
pub const STEPS_PER_LOOK: u64 = 50;

/// A simulation with its files.
pub struct Run {
    simulation: Simulation,
    /// The ranks that share the simulation, where there are several.
    ranks: Option<Arc<dyn Ranks>>,
    /// Changes of a restart, in words.
    changes: Vec<String>,
    files: Option<Files>,
    interrupted: bool,
    /// Forces came into balance, where the run ends by that.
    balanced: bool,
    failure: Option<StepError>,
}

impl Run {
    /// Sets up a simulation, and in `folder`, if given, its files with the state at the start. A start state in the options
    /// stands for the run that the scene begins from. Where the options have ranks, they share the simulation: each calls the
    /// functions of its run as the others do, and the first one has the files. With `restart`
    /// the state comes from a checkpoint of the same scene, not from the run that the scene begins from, and files in the folder are continued; without it what the
    /// lists of an earlier run name there is taken away. The folder belongs to this run until it is dropped.
    ///
    /// # Errors
    /// See [`RunError`]. Nothing is written unless the scene and the checkpoint are sound.
    pub fn start(
        scene: &Scene,
        options: &Options,
        folder: Option<&Path>,
        restart: Option<&Path>,
    ) -> Result<Self, RunError> {
        let ranks = options.ranks.clone().filter(|ranks| ranks.count() > 1);
        let started = Self::set_up(scene, options, restart);
        let (mut simulation, changes) = ranks::agree(ranks.as_deref(), started)?;
        if let Some(ranks) = ranks.as_ref().filter(|_| simulation.ranks().is_none()) {
            simulation.share_among(Arc::clone(ranks))?;
        }
        let open = |path| Files::open(&simulation, path, restart.is_some(), options.in_pieces);
        let files = folder.map(open).transpose();
        let mut files = ranks::agree(ranks.as_deref(), files)?;
        if let Some(files) = &mut files {
            files.write(&mut simulation)?;
        }
        Ok(Self {
            simulation,
            ranks,
            changes,
            files,
            interrupted: false,
            balanced: false,
            failure: None,
        })
    }

    /// Sets up the simulation, and the changes of a restart in words.
    fn set_up(
        scene: &Scene,
        options: &Options,
        restart: Option<&Path>,
    ) -> Result<(Simulation, Vec<String>), RunError> {
        let start = match restart {
            None if options.start.is_none() => start_state::read(scene)?,
            _ => None,
        };
        match (restart, start) {
            (Some(path), _) => restart::restarted(scene, options, path),
            (None, None) => Ok((Simulation::new(scene, options)?, vec![])),
            (None, Some(start)) => {
                let options = Options {
                    start: Some(Arc::new(start)),
                    ..options.clone()
                };
                Ok((Simulation::new(scene, &options)?, vec![]))
            }
        }
    }

    /// The simulation.
    #[must_use]
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Changes of a restart in words: gravity, local damping, planes, box loads.
    #[must_use]
    pub fn changes(&self) -> &[String] {
        &self.changes
    }

    /// The next output time \[s\], or `None` at the end.
    #[must_use]
    pub fn next_stop(&self) -> Option<f64> {
        if self.interrupted || self.balanced || self.failure.is_some() {
            return None;
        }
        forecast::next_stop(self.simulation.scene(), self.simulation.time())
    }

    /// Steps until the time `stop`, as [`Run::next_stop`] gives it, and writes the rows of a history that has an interval of
    /// its own. `observe` sees every step and may end the run.
    ///
    /// # Errors
    /// The first step that fails, or a row that cannot be written. The files keep the last good frame and checkpoint.
    pub fn advance(
        &mut self,
        stop: f64,
        mut observe: impl FnMut(&StepInfo) -> RunControl + Send,
    ) -> Result<(), RunError> {
        while self.step_until(stop, &mut observe)? {
            if let Some(files) = &mut self.files {
                files.write_due_row(&mut self.simulation)?;
            }
        }
        Ok(())
    }

    /// True if the run was stopped before its end.
    #[must_use]
    pub fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Steps until the time `stop`, or until a state is to have a row in the history: then true.
    fn step_until(
        &mut self,
        stop: f64,
        observe: &mut (impl FnMut(&StepInfo) -> RunControl + Send),
    ) -> Result<bool, StepError> {
        let slack = forecast::slack(self.simulation.scene());
        let files = self.files.as_ref();
        let (simulation, interrupted) = (&mut self.simulation, &mut self.interrupted);
        let (balanced, ranks) = (&mut self.balanced, self.ranks.as_deref());
        let team = simulation.team();
        let result = team.lead(|| {
            while simulation.time() + slack < stop {
                let info = simulation.step(stop)?;
                let stop = observe(&info) == RunControl::Stop;
                let row = files.is_some_and(|files| files.is_row_due(simulation));
                let [stop, row] = ranks::any(ranks, [stop, row]);
                if stop {
                    *interrupted = true;
                    return Ok(false);
                }
                if info.step % STEPS_PER_LOOK == 0 && is_balanced(simulation) {
                    *balanced = true;
                    return Ok(false);
                }
                if row {
                    return Ok(true);
                }
            }
            Ok(false)
        });
        if let Err(error) = &result {
            self.failure = Some(StepError::clone(error));
        }
        result
    }

    /// Writes frame, history row and checkpoint of the present state, where the run has files and the scene asks
    /// for them.
    ///
    /// # Errors
    /// See [`RunError`].
    pub fn write(&mut self) -> Result<(), RunError> {
        if self.failure.is_some() {
            return Ok(());
        }
        let files = self.files.as_mut();
        files.map_or(Ok(()), |files| files.write(&mut self.simulation))
    }

    /// The energy balance.
    #[must_use]
    pub fn energy(&mut self) -> Energy {
        self.simulation.energy()
    }

    fn status(&self) -> Status {
        match (&self.failure, self.interrupted) {
            (Some(_), _) => Status::Failed,
            (None, true) => Status::Interrupted,
            (None, false) => Status::Finished,
        }
    }

    /// Summary of the run and its ending; the caller adds the times of the clock. Several ranks have the same.
    #[must_use]
    pub fn summary(&mut self) -> Summary {
        let energy = self.simulation.energy();
        let simulation = &self.simulation;
        let earlier = self.files.as_ref().map(Files::cautions);
        let mut cautions = earlier.unwrap_or_default().to_vec();
        cautions.retain(|caution| simulation.still_matters(caution, &energy));
        files::worst(&mut cautions, simulation.cautions(&energy));
        let warning = |caution: &ResultWarning| Warning {
            kind: caution.word().to_owned(),
            message: caution.to_string(),
        };
        let clock = simulation.clock();
        let stepped = simulation.steps() > 0;
        let axes = simulation.plan().axes;
        let of_body = |(set, energy): (usize, BodyEnergy)| YieldingBody {
            body: simulation.body(set).id,
            stored: Some(energy.stored),
            plastic: Some(energy.plastic),
            algorithmic: Some(energy.algorithmic),
        };
        let yielding: Vec<YieldingBody> = simulation.yielding().map(of_body).collect();
        Summary {
            scene: simulation.scene().name.clone(),
            plan: plan_value(simulation.plan()),
            mesh: Some(SummaryMesh {
                origin: simulation.origin()[..axes].to_vec(),
                cell: simulation.scene().mesh.cell[..axes].to_vec(),
                cells: simulation.scene().mesh.cells[..axes]
                    .iter()
                    .map(|&n| n as u64)
                    .collect(),
                axisymmetric: simulation.scene().mesh.axisymmetric,
            }),
            particles: simulation.particles() as u64,
            nodes_active: simulation.nodes_with_mass() as u64,
            steps: simulation.steps(),
            time: Some(simulation.time()),
            dt_min: stepped.then_some(clock.dt_min),
            dt_max: stepped.then_some(clock.dt_max),
            dt_critical: stepped.then_some(clock.dt_critical),
            threads: simulation.threads(),
            ranks: self.ranks.as_ref().map(|ranks| ranks.count()),
            lanes: simulation.lanes().name().into(),
            mass: Some(simulation.mass()),
            momentum: simulation.momentum()[..axes].to_vec(),
            energy: SummaryEnergy {
                kinetic: Some(energy.kinetic),
                strain: Some(energy.strain),
                contact: Some(energy.contact),
                external_work: Some(energy.external_work),
                dissipated: Some(energy.dissipated),
                damping: Some(energy.damping),
                friction: Some(energy.friction),
                impact: Some(energy.impact),
                plastic: Some(energy.plastic),
                removed: Some(energy.removed),
                remainder: Some(energy.remainder),
                absorbed: simulation
                    .model()
                    .settings
                    .absorbs()
                    .then_some(energy.absorbed),
                algorithmic: (!yielding.is_empty()).then_some(energy.algorithmic),
            },
            yielding,
            boundary_drift: simulation.boundary_drift().map(|drift| SummaryDrift {
                body: drift.body,
                vertex: drift.vertex as u64,
                distance: Some(drift.distance),
                in_cells: Some(drift.in_cells),
            }),
            not_to_be_trusted: simulation
                .invariants()
                .violation
                .map(|violation| violation.to_string()),
            warnings: cautions.iter().map(warning).collect(),
            events: simulation.events().iter().map(event).collect(),
            state_hash: simulation.state_hash(),
            status: self.status(),
            error: self.failure.as_ref().map(ToString::to_string),
            ..Summary::default()
        }
    }

    /// The bodies as they are now, for a scene that begins from them; `keeps_velocity` is what that scene does.
    ///
    /// # Errors
    /// See [`RunError`].
    pub fn state(&self, keeps_velocity: bool) -> Result<StartState, RunError> {
        let name = &self.simulation.scene().name;
        Ok(start_state::of(&self.simulation, name, keeps_velocity)?)
    }

    /// The output folder, where there is one.
    #[must_use]
    pub fn folder(&self) -> Option<&OutputFolder> {
        self.files.as_ref().and_then(Files::folder)
    }
}

/// True once forces are in balance, where the scene ends by that.
fn is_balanced(simulation: &mut Simulation) -> bool {
    let Some(until) = simulation.scene().until else {
        return false;
    };
    let share = simulation.unbalanced_share();
    share.is_some_and(|share| share < until)
}

/// The plan as JSON: what is kept, what is left out, why, and the bytes.
#[must_use]
pub fn plan_value(plan: &Plan) -> Value {
    let list = |kept: bool| -> Vec<Value> {
        plan.entries
            .iter()
            .filter(|e| e.kept == kept)
            .map(|e| json!({ "group": e.group, "name": e.name, "because": e.because }))
            .collect()
    };
    let mut value = json!({
        "kept": list(true),
        "left_out": list(false),
        "bytes_per_particle": plan.bytes_per_particle(),
        "bytes_per_node": plan.bytes_per_node(),
    });
    if !plan.warnings.is_empty() {
        value["warnings"] = json!(plan.warnings);
    }
    value
}

fn event(event: &Event) -> SummaryEvent {
    let base = SummaryEvent {
        message: event.to_string(),
        time: Some(event.time),
        step: event.step,
        ..SummaryEvent::default()
    };
    match &event.kind {
        EventKind::Removed(at) => SummaryEvent {
            kind: "particle_removed".into(),
            particle: Some(at.id),
            position: at.position.to_vec(),
            mass: Some(at.mass),
            ..base
        },
        EventKind::RecordEnded => SummaryEvent {
            kind: "record_ended".into(),
            ..base
        },
        EventKind::WiderStencil => SummaryEvent {
            kind: "wider_stencil".into(),
            ..base
        },
        EventKind::VolumeRatio { particle, .. } => SummaryEvent {
            kind: VOLUME_RATIO.into(),
            particle: Some(particle.id),
            position: particle.position.to_vec(),
            mass: Some(particle.mass),
            ..base
        },
        EventKind::Overlap { position, .. } => SummaryEvent {
            kind: OVERLAP.into(),
            position: position.to_vec(),
            ..base
        },
    }
}
