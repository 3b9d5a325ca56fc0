//! A free fall that a solver runs before anything else: what its frames mean is found here, not believed.
//!
//! A cuboid of three cells a side flies along x with a constant velocity and falls along the last axis, clear of all
//! walls. Its way along x is `v t` for every scheme, which tells the time of the particles whatever the label of the frame;
//! the other way then tells gravity, and where the particles began tells the unit of length and their number.

use super::compare::displacements;
use super::finding::{Finding, findings};
use super::process::{self, ProcessUsage};
use super::said::with_words;
use crate::bench::config::{Executable, TimeLabel};
use crate::frames::{self, Frame};
use serde_json::{Value, json};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Edge of a cell \[m\].
pub(super) const CELL: f64 = 0.1;
/// Cells along an edge of the body, and empty ones on each side of it.
pub(super) const CELLS: usize = 3;
pub(super) const AIR: usize = 3;
/// Particles per cell and axis.
pub(super) const PER_CELL: usize = 2;
/// Step \[s\], and number of steps.
pub(super) const STEP: f64 = 0.001;
pub(super) const STEPS: f64 = 40.0;
/// Velocity along x \[m/s\], and gravity against the last axis \[m/s²\].
pub(super) const VELOCITY: f64 = 1.0;
pub(super) const GRAVITY: f64 = 9.81;

/// Findings on a solver that was calibrated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Calibration {
    /// Steps by which the velocities in a frame are ahead of its particles, where it has velocities: half a step behind
    /// with a leapfrog that starts by half a kick.
    pub velocity_ahead: Option<f64>,
    /// Number of steps by which the fall leads that of a leapfrog; it is one where the first kick is a whole one.
    pub fall_ahead: f64,
}

impl Calibration {
    /// A hint for a solver whose first kick is a whole one, which leaves it of first order in time.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        (0.75..1.25).contains(&self.fall_ahead).then_some(
            "its first step kicks by a whole step where half of one is due: it is of first order in time",
        )
    }
}

/// Reason for which a solver is not to be trusted.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// It did not run, or left nothing that can be read.
    Run(String),
    /// Findings on frames that do not say what they mean.
    Found(Vec<Finding>),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "calibration: ")?;
        match self {
            Self::Run(reason) => write!(f, "{reason}"),
            Self::Found(findings) => {
                let words: Vec<String> = findings.iter().map(Finding::to_string).collect();
                write!(f, "{}", words.join("; "))
            }
        }
    }
}

/// The free fall in two or three dimensions, as in a scene file.
#[must_use]
pub fn scene(axes: usize) -> Value {
    let corner = |cells: usize| vec![cells as f64 / 10.0; axes];
    let mut velocity = vec![0.0; axes];
    velocity[0] = VELOCITY;
    let mut gravity = vec![0.0; axes];
    gravity[axes - 1] = -GRAVITY;
    let planes = ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"];
    let sliding = planes[..2 * axes]
        .iter()
        .map(|plane| (format!("plane_{plane}"), Value::from("sliding")));
    json!({
        "dimension": axes,
        "time": 0.04,
        "time_step": STEP,
        "particles_per_cell": PER_CELL,
        "gravity": gravity,
        "results": { "print": 4, "material_point_results": ["id", "displacement", "velocity"] },
        "mesh": {
            "cells_dimension": vec![CELL; axes],
            "cells_number": vec![CELLS + 2 * AIR; axes],
            "origin": vec![0.0; axes],
            "boundary_conditions": sliding.collect::<serde_json::Map<_, _>>(),
        },
        "material": [{
            "type": "elastic", "id": 1, "young": 1e4, "density": 1000.0, "poisson": 0.25,
        }],
        "body": [{
            "type": "cuboid", "id": 1, "material_id": 1, "point_p1": corner(AIR),
            "point_p2": corner(AIR + CELLS), "initial_velocity": velocity,
        }],
    })
}

/// Runs the free fall with a solver in a folder below `folder`, and judges its frames.
///
/// # Errors
/// That it did not run, or all that is wrong with its frames.
pub(crate) fn calibrate(
    executable: &Executable,
    axes: usize,
    threads: usize,
    folder: &Path,
    stop: &AtomicBool,
) -> Result<(ProcessUsage, Calibration), Fault> {
    let folder = folder.join(format!("calibration-{axes}d"));
    let out = folder.join(crate::record::key(&executable.name));
    let file = folder.join(executable.scene_file());
    let run = || -> Result<(ProcessUsage, Frame, Option<f64>), String> {
        process::prepare(&out, &file, &executable.given(&scene(axes)))?;
        let finished = process::run(executable, &file, threads, &out, stop)?;
        let (frame, label) = last_frame(&out)?;
        Ok((finished, frame, label))
    };
    let (finished, frame, label) = run().map_err(|reason| Fault::Run(with_words(&reason, &out)))?;
    let calibration = judge(&frame, label, executable.time_label, axes)?;
    Ok((finished, calibration))
}

/// The last frame of a folder with its label \[s\], where a list or the frame itself has one.
fn last_frame(out: &Path) -> Result<(Frame, Option<f64>), String> {
    let (file, said): (PathBuf, Option<f64>) = frames::last(out).ok_or_else(|| no_frame(out))?;
    let frame = frames::read(&file)?;
    let label = said.or(frame.time);
    Ok((frame, label))
}

/// Message that a solver left nothing.
pub(super) fn no_frame(out: &Path) -> String {
    format!("no .vtu frame below {}", out.display())
}

/// Judges the last frame of the free fall with its label \[s\]; where it has none, it is taken to be of the end.
///
/// # Errors
/// All that is wrong with it.
pub fn judge(
    frame: &Frame,
    label: Option<f64>,
    declared: TimeLabel,
    axes: usize,
) -> Result<Calibration, Fault> {
    let u = displacements(frame).map_err(Fault::Run)?;
    if frame.points.is_empty() {
        return Err(Fault::Run("its last frame has no particles".to_owned()));
    }
    let (found, time) = findings(&frame.points, &u, label, declared, axes);
    if !found.is_empty() {
        return Err(Fault::Found(found));
    }
    let velocity_ahead = frame.vectors("Velocity").map(|v| {
        let mean = v.iter().map(|v| v[axes - 1]).sum::<f64>() / v.len() as f64;
        (-mean / GRAVITY - time) / STEP
    });
    let fallen = -u.iter().map(|u| u[axes - 1]).sum::<f64>() / u.len() as f64;
    let due = 0.5 * GRAVITY * time * time;
    let fall_ahead = (fallen / due - 1.0) * time / STEP;
    Ok(Calibration {
        velocity_ahead,
        fall_ahead,
    })
}
