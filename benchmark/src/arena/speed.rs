//! The speed problem of the arena: a flying block of neo-Hookean material, the same steps for every solver.
//!
//! Each solver runs a short and a long form of one scene. What the long one takes more is the work of its further steps alone:
//! start, compilation, reading and writing are the same in both. No solver has to say its own time.

use super::run::{SOLVER, Solvers};
use crate::bench::children::GuestScene;
use crate::bench::config::{Method, SceneChoice};
use crate::bench::scenes;
use crate::precision::Peer;
use crate::precision::peers::Visit;
use crate::record::{Record, Row, key};
use proctor_scene::{Scene, SceneError};
use proctor_verification::guest::Guest;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Steps of the short and of the long run.
const STEPS: [u32; 2] = [10, 40];
/// Scene that is flown.
const SCENE: &str = "moving-3d";
/// First part of the names of the rows.
const NAME: &str = "arena-speed/";
/// Counters of a row.
const PARTICLES: &str = "particles";
const NS: &str = "cpu_ns_per_particle_step";
const ERROR: &str = "error_l2_displacement";

/// Cost of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed {
    /// Name of the solver.
    pub solver: String,
    /// Its method, where its configuration says it.
    pub method: String,
    /// Number of particles that it left in its frame.
    pub particles: u64,
    /// CPU per particle and step \[ns\] and error of the displacement against free flight, or why there are none.
    pub found: Result<(f64, f64), String>,
}

/// A form of the problem as other solvers get it.
fn problem(particles: usize, steps: u32) -> Result<Guest, SceneError> {
    let built_in = scenes::find(SCENE);
    let (scene, axes) = built_in.unwrap_or((&scenes::BUILT_IN[0], 3));
    let choice = SceneChoice::BuiltIn(scene, axes);
    let mut made = choice.make(particles, &Method::default()).scene;
    made["material"][0]["type"] = "neo_hookean".into();
    let step = made["time_step"].as_f64().unwrap_or_default();
    made["time"] = (step * f64::from(steps)).into();
    let checked: Scene = choice.checked(&made)?;
    let velocity = checked.bodies[0].velocity;
    Ok(Guest::new(checked, move |_, t| velocity.map(|v| v * t)).at_the_end())
}

/// Runs the problem with all solvers whose calibration passed, and adds a row for each number of particles. True if no run
/// failed.
pub fn run(solvers: &Solvers, particles: &[usize], visit: &Visit<'_>, record: &mut Record) -> bool {
    let mut sound = true;
    for &wanted in particles {
        for peer in &solvers.peers {
            if peer.calibration.is_err() {
                continue;
            }
            let name = &peer.executable.name;
            let of_solver = format!("{NAME}{}/{wanted}", key(name));
            let mut row = Row::aggregate(of_solver, "speed", visit.threads);
            row.label(SOLVER, name.clone());
            if let Some(method) = &peer.executable.method {
                row.label("method", method.clone());
            }
            row.count(PARTICLES, wanted as f64);
            let folder = visit.folder.join(format!("speed-{wanted}"));
            let visit = Visit {
                folder: &folder,
                ..*visit
            };
            let found = timed(peer, wanted, &visit);
            if visit.stop.load(Ordering::Relaxed) {
                return sound;
            }
            match found {
                Ok((ns, count, error)) => {
                    row.count(PARTICLES, count as f64);
                    row.count(NS, ns);
                    row.count(ERROR, error);
                }
                Err(reason) => {
                    sound = false;
                    row.fail(reason);
                }
            }
            record.push(row);
        }
    }
    sound
}

/// CPU per particle and step \[ns\], the number of particles and the error of a solver.
fn timed(peer: &Peer, particles: usize, visit: &Visit<'_>) -> Result<(f64, usize, f64), String> {
    let mut least = [Duration::MAX; 2];
    let mut last = None;
    for round in 0..visit.effort.repetitions.max(1) {
        // In turn, so that what slows the machine down does not meet one form alone.
        for (steps, least) in STEPS.into_iter().zip(&mut least) {
            let guest = problem(particles, steps).map_err(|error| error.to_string())?;
            let handed = GuestScene::new(&guest)?;
            let folder = visit.folder.join(steps.to_string());
            let (threads, stop) = (visit.threads, visit.stop);
            if round == 0 {
                handed.warm_up(&peer.executable, threads, &folder, stop)?;
            }
            let spent = handed.run(&peer.executable, threads, &folder, stop)?;
            *least = spent.cpu.min(*least);
            let calibration = peer.calibration.clone()?;
            let frames = handed.snapshots(&guest, &peer.executable, &calibration, &folder)?;
            let count = frames.last().map_or(0, |frame| frame.starts.len());
            last = Some((count, guest.error(&frames)?));
        }
    }
    let (count, error) = last.ok_or("no run was made")?;
    let more = least[1].saturating_sub(least[0]).as_secs_f64();
    if more <= 0.0 {
        return Err("its long run took no longer than its short one".to_owned());
    }
    let steps = f64::from(STEPS[1] - STEPS[0]);
    Ok((more * 1e9 / (count as f64 * steps), count, error))
}

/// Rows of the problem in a record, in the order in which they were measured.
#[must_use]
pub fn speeds(record: &Record) -> Vec<Speed> {
    let rows = record.rows.iter().filter(|row| row.name.starts_with(NAME));
    rows.map(|row| {
        let count = |key: &str| row.counters.get(key).copied().unwrap_or(f64::NAN);
        let label = |key: &str| row.labels.get(key).cloned().unwrap_or_default();
        Speed {
            solver: label(SOLVER),
            method: label("method"),
            particles: count(PARTICLES) as u64,
            found: match &row.error {
                Some(reason) => Err(reason.clone()),
                None => Ok((count(NS), count(ERROR))),
            },
        }
    })
    .collect()
}
