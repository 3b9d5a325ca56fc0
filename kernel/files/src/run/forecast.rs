//! Forecast of a run: its steps, the states that it writes, and the bytes of its files.

use super::history::HistoryRows;
use super::schedule::{self, NOMINAL_TIME};
use super::{boundaries, frames, grid, state};
use crate::output::history::row;
use crate::output::pvd::{BOUNDARIES, FrameEntry, GRID, PARTICLES, list_text, name_of};
use crate::output::vtu;
use proctor_scene::simulation::{Clock, Simulation};
use proctor_scene::{Scene, TimeStep};

/// The next output time of a run at a time \[s\], or `None` at its end.
#[must_use]
pub fn next_stop(scene: &Scene, time: f64) -> Option<f64> {
    let intervals = scene.results.print.max(1) as f64;
    // Half a constant step, or round-off, may separate the state from the output time that it stands for.
    let slack = match scene.time_step {
        TimeStep::Fixed { dt, .. } => 0.5 * dt,
        _ => 1e-9 * scene.time / intervals,
    };
    let reached = time + slack;
    if reached >= scene.time {
        return None;
    }
    let done = (reached / scene.time * intervals).floor();
    if done + 1.0 >= intervals {
        return Some(scene.time);
    }
    let next = scene.time * ((done + 1.0) / intervals);
    // Outputs may be closer than the digits of the time: the next one is later than the state in any case.
    Some(next.max(reached.next_up()))
}

/// Time by which a state may be before an output time and stand for it \[s\].
pub(super) fn slack(scene: &Scene) -> f64 {
    match scene.time_step {
        TimeStep::Fixed { dt, .. } => 0.5 * dt,
        _ => 0.0,
    }
}

/// The steps of a run and the states of its outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct StepForecast {
    /// Number of steps.
    pub steps: u64,
    /// True where the step is constant, so that the number is that of the run.
    pub is_exact: bool,
    /// Time \[s\] and step of the outputs, the start first.
    pub outputs: Vec<(f64, u64)>,
    /// The step \[s\].
    dt: f64,
}

impl StepForecast {
    /// Forecast of a scene whose steps are as long as `dt` \[s\], unless the scene has a constant one. Other steps are
    /// shortened so that outputs fall on their times.
    #[must_use]
    pub fn new(scene: &Scene, dt: f64) -> Self {
        let (dt, is_exact) = match scene.time_step {
            TimeStep::Fixed { dt, .. } => (dt, true),
            _ => (dt, false),
        };
        let slack = slack(scene);
        let (mut time, mut steps) = (0.0, 0_u64);
        let mut outputs = vec![(0.0, 0)];
        while let Some(stop) = next_stop(scene, time) {
            if is_exact {
                let reaches = |steps: u64| steps as f64 * dt + slack >= stop;
                let mut after = (((stop - slack) / dt).ceil() as u64).max(steps);
                while after > steps && reaches(after - 1) {
                    after -= 1;
                }
                while !reaches(after) {
                    after += 1;
                }
                (time, steps) = (after as f64 * dt, after);
            } else {
                steps += ((stop - time) / dt * (1.0 - 1e-12)).ceil().max(1.0) as u64;
                time = stop;
            }
            outputs.push((time, steps));
        }
        Self {
            steps,
            is_exact,
            outputs,
            dt,
        }
    }
}

/// The files of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutputForecast {
    /// Frames of the particles.
    pub frames: u64,
    /// Bytes of these and of their list.
    pub frame_bytes: u64,
    /// Bytes of frames of nodes and boundaries, and of their lists; those of nodes as many as the present state has.
    pub other_frame_bytes: u64,
    /// Rows of the history.
    pub history_rows: u64,
    /// Bytes of the history, each row as long as one of the present state.
    pub history_bytes: u64,
    /// Bytes of the checkpoint.
    pub checkpoint_bytes: u64,
}

impl OutputForecast {
    /// Forecast of a simulation with so many steps, as long as no particle leaves it.
    #[must_use]
    pub fn new(simulation: &mut Simulation, steps: &StepForecast) -> Self {
        let results = simulation.scene().results.clone();
        let mut found = Self::default();
        if results.print > 0 {
            found.frames = steps.outputs.len() as u64;
            found.frame_bytes = series(
                PARTICLES,
                &frames::of_particles(simulation).frame,
                &steps.outputs,
            );
            if !results.nodal_fields.is_empty() {
                let nodes = grid::frame(simulation).frame;
                // Nodes have values from the first step on.
                if !nodes.points.is_empty() {
                    found.other_frame_bytes += series(GRID, &nodes, &steps.outputs[1..]);
                }
            }
            if simulation.has_boundaries() {
                let frame = boundaries::frame(simulation);
                found.other_frame_bytes += series(BOUNDARIES, &frame, &steps.outputs);
            }
            if results.checkpoint {
                found.checkpoint_bytes = state::save(simulation).checkpoint.bytes();
            }
        }
        if results.writes_history() {
            let end = steps.outputs.last().map_or(0.0, |(time, _)| *time);
            let clock = Clock {
                time: end,
                dt_before: steps.dt,
                ..*simulation.clock()
            };
            found.history_rows = match results.history_interval {
                Some(interval) => schedule::rows(interval, &clock).min(steps.steps + 1),
                None => found.frames,
            };
            let rows = HistoryRows::new(simulation);
            let mut names = rows.columns(simulation);
            let energy = simulation.energy();
            let mut values = rows.row(simulation, &energy);
            if results.history_interval.is_some() {
                names.push(NOMINAL_TIME.to_owned());
                values.push(simulation.time());
            }
            let line = row(simulation.time(), simulation.steps(), &values);
            let head: usize = names.iter().map(|name| name.len() + 1).sum();
            let lines = found.history_rows * line.len() as u64;
            found.history_bytes = "time,step\n".len() as u64 + head as u64 + lines;
        }
        found
    }

    /// Files that are written, each time anew: at each output a frame of each kind, its list, and the checkpoint.
    #[must_use]
    pub fn files(&self) -> u64 {
        let of_particles = u64::from(self.frame_bytes > 0);
        let of_others = u64::from(self.other_frame_bytes > 0);
        let checkpoint = u64::from(self.checkpoint_bytes > 0);
        self.frames * (2 * of_particles + 2 * of_others + checkpoint)
    }

    /// Bytes of all files, the checkpoint as often as it is written.
    #[must_use]
    pub fn bytes_written(&self) -> u64 {
        self.bytes() + self.checkpoint_bytes * self.frames.saturating_sub(1)
    }

    /// Bytes of all files.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.frame_bytes + self.other_frame_bytes + self.history_bytes + self.checkpoint_bytes
    }
}

/// Bytes of frames as long as this one at these times and steps, and of their list.
fn series(stem: &str, frame: &vtu::Frame, outputs: &[(f64, u64)]) -> u64 {
    let words = |time: f64, step: u64| (format!("{time:?}").len() + step.to_string().len()) as u64;
    let body = vtu::bytes(frame) - words(frame.time, frame.step);
    let frames: u64 = outputs
        .iter()
        .map(|(time, step)| body + words(*time, *step))
        .sum();
    let entries: Vec<FrameEntry> = (0..)
        .zip(outputs)
        .map(|(number, (time, _))| FrameEntry {
            file: name_of(stem, number, frame.extension()),
            time: *time,
        })
        .collect();
    frames + list_text(&entries).len() as u64
}
