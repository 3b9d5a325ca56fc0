//! Forecast of a run from a few steps of the scene itself: steps, time, memory, output.

use crate::forecast::{RunCost, RunCounts};
use crate::measure::{Spent, Stopwatch};
use crate::show::{bytes, grouped, number, seconds};
use crate::verbs::run::{bound_words, row};
use proctor_files::json::SourceMap;
use proctor_files::run::{HistoryRows, OutputForecast, StepForecast, next_stop};
use proctor_kernel::memory::words;
use proctor_scene::Scene;
use proctor_scene::simulation::{Bound, Simulation, StepInfo, estimate_memory};
use std::fmt;

/// Time that the steps take, unless the least number takes longer \[s\].
const ENOUGH: f64 = 0.25;
/// Least and largest number of steps.
const LEAST: usize = 5;
const MOST: usize = 500;
/// Steps that touch memory for the first time, and are not timed.
const FIRST: usize = 2;

/// Words before the forecast.
const HEADING: &str = "forecast";

/// The forecast, in rows of a name and a text.
pub(super) struct Forecast {
    rows: Vec<(&'static str, String)>,
}

impl Forecast {
    /// Takes a few steps of a scene that was set up in so much time \[s\], with a number of warnings.
    pub(super) fn new(
        scene: &Scene,
        places: &SourceMap,
        simulation: &mut Simulation,
        (set_up, warnings): (f64, usize),
    ) -> Self {
        let mut rows = vec![];
        let (infos, fault) = Self::steps(scene, places, simulation);
        if let Some((step, bound)) = typical(&infos) {
            let (dt, critical) = (number(step.dt), number(step.dt_critical));
            let text = format!(
                "{dt} s, {}; bound of stability {critical} s",
                bound_words(bound)
            );
            rows.push(("time step", text));
            let steps = StepForecast::new(scene, step.dt);
            let about = if steps.is_exact {
                String::new()
            } else {
                format!(", if they stay as long as the first {}", infos.len())
            };
            rows.push(("steps", grouped(steps.steps) + &about));
            let mut stopwatch = Stopwatch::default();
            let output = stopwatch.time(|| OutputForecast::new(simulation, &steps));
            let counts = RunCounts {
                steps: steps.steps,
                rows: output.history_rows,
                outputs: output.frames,
                files: output.files(),
                bytes: output.bytes_written(),
                has_end: scene.until.is_some(),
            };
            let one_output = stopwatch.spent.cpu.as_secs_f64();
            let cost = RunCost::new(&infos, simulation, set_up, one_output);
            let time = cost.of(&counts);
            let threads = match simulation.threads() {
                1 => "1 thread".to_owned(),
                n => format!("{n} threads"),
            };
            let about = if counts.has_end { "at most" } else { "about" };
            let text = format!(
                "{about} {} on {threads} of this machine, by its first {} steps",
                seconds(time),
                infos.len()
            );
            rows.push(("run time", text));
            let memory = words(estimate_memory(scene).bytes);
            rows.push(("memory", format!("about {memory}")));
            rows.push(("output", words_of(&output)));
            let text = match warnings {
                0 => "none".to_owned(),
                n => format!("{n}, above"),
            };
            rows.push(("warnings", text));
        }
        if let Some(fault) = fault {
            rows.push(("fault", format!("the run will stop: {fault}")));
        }
        Self { rows }
    }

    /// Steps with the time that each took \[s\], and the reason why they stopped.
    fn steps(
        scene: &Scene,
        places: &SourceMap,
        simulation: &mut Simulation,
    ) -> (Vec<(StepInfo, f64)>, Option<String>) {
        let team = simulation.team();
        let is_alone = simulation.threads() == 1;
        team.lead(|| {
            let mut infos: Vec<(StepInfo, f64)> = vec![];
            let mut spent = 0.0;
            while let Some(stop) = next_stop(scene, simulation.time()) {
                let mut stopwatch = Stopwatch::default();
                let info = match stopwatch.time_thread(|| simulation.step(stop)) {
                    Ok(info) => info,
                    Err(error) => return (infos, Some(places.of_step(&error))),
                };
                infos.push((info, own(stopwatch.spent, is_alone)));
                spent += stopwatch.spent.wall.as_secs_f64();
                let is_enough = spent > ENOUGH && infos.len() >= LEAST;
                if is_enough || infos.len() == MOST {
                    break;
                }
            }
            (infos, None)
        })
    }
}

impl fmt::Display for Forecast {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{HEADING}")?;
        self.rows
            .iter()
            .try_for_each(|(name, text)| row(f, name, text))
    }
}

/// The longest step of the later half, and the bound that ruled most of all steps but those that were shortened for an output.
fn typical(infos: &[(StepInfo, f64)]) -> Option<(StepInfo, Bound)> {
    let later = &infos[infos.len() / 2..];
    let longest = later.iter().max_by(|a, b| a.0.dt.total_cmp(&b.0.dt))?.0;
    let bounds = || later.iter().map(|(info, _)| info.bound);
    let count = |bound: Bound| bounds().filter(|other| *other == bound).count();
    let ruling = bounds().filter(|bound| *bound != Bound::OutputTime);
    let bound = ruling.max_by_key(|bound| count(*bound));
    Some((longest, bound.unwrap_or(longest.bound)))
}

/// Rows that are timed.
const ROWS: u32 = 3;

impl RunCost {
    /// Costs of the steps that were taken, of a row of the state behind them, and of what else was timed \[s\]: the set-up, and an
    /// output in memory.
    fn new(
        infos: &[(StepInfo, f64)],
        simulation: &mut Simulation,
        set_up: f64,
        output: f64,
    ) -> Self {
        let rows = HistoryRows::new(simulation);
        let is_alone = simulation.threads() == 1;
        let mut stopwatch = Stopwatch::default();
        for _ in 0..ROWS {
            stopwatch.time_thread(|| {
                let energy = simulation.energy();
                rows.row(simulation, &energy)
            });
        }
        Self {
            set_up,
            step: mean(infos),
            row: own(stopwatch.spent, is_alone) / f64::from(ROWS),
            output,
        }
    }
}

/// Time of work \[s\]: that of the processor where one thread does it, since others may keep the processor busy meanwhile.
fn own(spent: Spent, is_alone: bool) -> f64 {
    let Spent { wall, cpu } = spent;
    if is_alone { cpu } else { wall }.as_secs_f64()
}

/// Mean time of a step \[s\]: some of them sort the particles, and take longer.
fn mean(infos: &[(StepInfo, f64)]) -> f64 {
    let skipped = FIRST.min(infos.len() - 1);
    let times = infos[skipped..].iter().map(|(_, time)| time);
    times.sum::<f64>() / (infos.len() - skipped) as f64
}

/// The files of a run in words.
fn words_of(output: &OutputForecast) -> String {
    if output.bytes() == 0 {
        return "the summary alone".to_owned();
    }
    let mut parts = vec![];
    let frames = output.frame_bytes + output.other_frame_bytes;
    if output.frames > 0 {
        parts.push(format!(
            "{} frames {}",
            grouped(output.frames),
            bytes(frames)
        ));
    }
    if output.history_rows > 0 {
        let (rows, size) = (grouped(output.history_rows), bytes(output.history_bytes));
        parts.push(format!("{rows} rows of the history {size}"));
    }
    if output.checkpoint_bytes > 0 {
        parts.push(format!("checkpoint {}", bytes(output.checkpoint_bytes)));
    }
    format!("{}: {}", bytes(output.bytes()), parts.join(", "))
}
