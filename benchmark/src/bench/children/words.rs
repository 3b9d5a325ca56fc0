//! A problem of a few cells for each word of a scene that changes it: a solver that reads over the word is found before its runs.
//!
//! The answer to each is known in closed form, or so far from the motion without the word that no method is mistaken for one
//! that does not know it.

use super::calibration::{AIR, CELL, CELLS, GRAVITY, PER_CELL, STEP, STEPS};
use super::compare::displacements;
use super::process;
use crate::bench::config::Executable;
use crate::frames::{self, Frame};
use crate::show::number;
use proctor_scene::{Damping, Scene};
use serde_json::{Map, Value, json};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Way of a body that is thrown along x over that of another one, below which the other is held.
const HELD: f64 = 0.25;
/// Share by which a way may differ from one that is known.
const KNOWN: f64 = 0.15;
/// Forces on the nodes \[N\], twice each along the first two axes: every subset of them has another sum.
const FORCES: [f64; 2] = [20.0, 40.0];
/// Velocity with which bodies are thrown \[m/s\]: a tenth of a cell in the whole time.
const THROWN: f64 = 0.25;
/// Velocity upwards where kinetic damping is to stop it \[m/s\].
const UPWARDS: f64 = 1.0;
/// Acceleration of the base \[m/s²\].
const SHAKEN: f64 = 2.0;
/// Density \[kg/m³\].
const DENSITY: f64 = 1000.0;
/// Files beside a scene: the record of the base, and the triangles of a surface, one cell above the lower plane.
const RECORD: &str = "word-base.csv";
const SURFACE: &str = "word-surface.stl";

/// A word of scenes that changes the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Word {
    /// The planes of the mesh, `sliding` and `fixed`, and a second body.
    Planes,
    /// `nodal_point_load`, several of them.
    NodalLoads,
    /// `damping` of the type `kinetic`.
    KineticDamping,
    /// `earthquake`.
    MovingBase,
    /// `contact`.
    Contact,
    /// `terrain_contact`.
    Surface,
}

impl Word {
    /// Those that a scene uses.
    #[must_use]
    pub fn of(scene: &Scene) -> Vec<Self> {
        let used = [
            (Self::Planes, true),
            (Self::NodalLoads, !scene.point_loads.is_empty()),
            (
                Self::KineticDamping,
                matches!(scene.damping, Damping::Kinetic),
            ),
            (Self::MovingBase, scene.base_motion.is_some()),
            (Self::Contact, !scene.contacts.is_empty()),
            (Self::Surface, !scene.surfaces.is_empty()),
        ];
        let used = used.into_iter().filter(|(_, is)| *is);
        used.map(|(word, _)| word).collect()
    }

    /// Its key in a scene file.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Planes => "boundary_conditions",
            Self::NodalLoads => "nodal_point_load",
            Self::KineticDamping => "damping",
            Self::MovingBase => "earthquake",
            Self::Contact => "contact",
            Self::Surface => "terrain_contact",
        }
    }

    /// The file beside its scene, where it has one: the word of its block that names it, its name and its text.
    #[must_use]
    pub fn file(self) -> Option<(&'static str, &'static str, String)> {
        match self {
            Self::MovingBase => {
                let rows = format!("t,ax,ay,az\n0,{SHAKEN},0,0\n1,{SHAKEN},0,0\n");
                Some(("file", RECORD, rows))
            }
            Self::Surface => Some(("stl_mesh", SURFACE, plane_of_triangles())),
            Self::Planes | Self::NodalLoads | Self::KineticDamping | Self::Contact => None,
        }
    }

    /// Its problem in two or three dimensions, as in a scene file; none where the word has none in the plane.
    #[must_use]
    pub fn scene(self, axes: usize) -> Option<Value> {
        let side = CELLS + 2 * AIR;
        let mut scene = json!({
            "dimension": axes,
            "time": STEP * STEPS,
            "time_step": STEP,
            "particles_per_cell": PER_CELL,
            "gravity": vec![0.0; axes],
            "results": { "print": 4, "material_point_results": ["id", "displacement", "velocity"] },
            "mesh": {
                "cells_dimension": vec![CELL; axes],
                "cells_number": vec![side; axes],
                "origin": vec![0.0; axes],
                "boundary_conditions": sliding(axes),
            },
            "material": [{
                "type": "elastic", "id": 1, "young": 5e5, "density": DENSITY, "poisson": 0.25,
            }],
        });
        let middle = (AIR, AIR + CELLS);
        let all = vec![middle; axes];
        // Up is the second axis, as in the slabs of the cases.
        let at = |low: usize, high: usize| {
            let mut extent = all.clone();
            extent[1] = (low, high);
            extent
        };
        match self {
            Self::Planes => {
                scene["mesh"]["boundary_conditions"]["plane_Yn"] = "fixed".into();
                let thrown = along(0, THROWN, axes);
                scene["body"] = json!([
                    body(1, &at(0, 1), &thrown),
                    body(2, &at(side - 1, side), &thrown),
                ]);
            }
            Self::NodalLoads => {
                // Nodes within the body, where every weighting function has mass.
                let node = |i: usize, j: usize| {
                    let mut cells = vec![AIR + 1; axes];
                    (cells[0], cells[1]) = (AIR + i, AIR + j);
                    lengths(&cells)
                };
                scene["nodal_point_load"] = json!([
                    [node(1, 1), along(0, FORCES[0], axes)],
                    [node(2, 1), along(0, FORCES[1], axes)],
                    [node(1, 2), along(1, FORCES[0], axes)],
                    [node(2, 2), along(1, FORCES[1], axes)],
                ]);
                scene["body"] = json!([body(1, &all, &along(0, 0.0, axes))]);
            }
            Self::KineticDamping => {
                scene["damping"] = json!({ "type": "kinetic" });
                scene["gravity"] = along(1, -GRAVITY, axes).into();
                scene["body"] = json!([body(1, &all, &along(1, UPWARDS, axes))]);
            }
            Self::MovingBase => {
                if axes != 3 {
                    return None;
                }
                scene["earthquake"] = json!({
                    "active": true, "file": RECORD, "header": true, "quantity": "acceleration",
                });
                let low = [middle, middle, (0, 1)];
                scene["body"] = json!([body(1, &low, &along(0, 0.0, axes))]);
            }
            Self::Contact => {
                scene["mesh"]["boundary_conditions"]["plane_Y0"] = "fixed".into();
                let mut wide = at(0, 1);
                wide[0] = (AIR - 1, AIR + CELLS + 1);
                scene["contact"] = json!([{
                    "id": 1, "master_id": 1, "slave_id": 2, "friction": 0.0,
                    "normal_type": "collinear",
                }]);
                scene["body"] = json!([
                    body(1, &wide, &along(0, 0.0, axes)),
                    body(2, &at(1, 2), &along(0, THROWN, axes)),
                ]);
            }
            Self::Surface => {
                if axes != 3 {
                    return None;
                }
                scene["terrain_contact"] = json!({
                    "active": true, "stl_mesh": SURFACE, "friction": 0.0, "distance_threshold": CELL,
                });
                scene["gravity"] = along(1, -GRAVITY, axes).into();
                scene["body"] = json!([body(1, &at(1, 2), &along(0, THROWN, axes))]);
            }
        }
        Some(scene)
    }

    /// Checks that the last frame of its problem shows the word at work.
    ///
    /// # Errors
    /// The reason.
    pub fn judge(self, frame: &Frame, axes: usize) -> Result<(), String> {
        let u = displacements(frame)?;
        let height = |i: usize| frame.points[i][1] - u[i][1];
        // Mean along an axis of the particles that began where `counts` holds.
        let way = |axis: usize, counts: &dyn Fn(usize) -> bool| {
            let chosen: Vec<f64> = (0..u.len())
                .filter(|i| counts(*i))
                .map(|i| u[i][axis])
                .collect();
            chosen.iter().sum::<f64>() / chosen.len() as f64
        };
        let end = STEP * STEPS;
        let flown = THROWN * end;
        // What is not a number is within nothing.
        let near = |found: f64, due: f64| (found / due - 1.0).abs() <= KNOWN;
        let metres = |way: f64| format!("{} m", number(way));
        match self {
            Self::Planes => {
                let half = 0.5 * CELL * (CELLS + 2 * AIR) as f64;
                let (low, high) = (
                    way(0, &|i| height(i) < half),
                    way(0, &|i| height(i) >= half),
                );
                if !near(low, flown) {
                    return Err(format!(
                        "`sliding` does not act: a body that is thrown along such a plane goes {} where {} are due",
                        metres(low),
                        metres(flown)
                    ));
                }
                if high.is_nan() || high.abs() > HELD * flown {
                    return Err(format!(
                        "`fixed` does not act: a body at such a plane goes {} where a free one goes {}",
                        metres(high),
                        metres(flown)
                    ));
                }
            }
            Self::NodalLoads => {
                let mass = DENSITY * (CELL * CELLS as f64).powi(axes as i32);
                let due = 0.5 * FORCES.iter().sum::<f64>() / mass * end * end;
                for (axis, name) in ["x", "y"].into_iter().enumerate() {
                    let found = way(axis, &|_| true);
                    if !near(found, due) {
                        return Err(format!(
                            "not every `nodal_point_load` acts: two of them along {name} move a free body by {} where {} are due",
                            metres(found),
                            metres(due)
                        ));
                    }
                }
            }
            Self::KineticDamping => {
                let risen = way(1, &|_| true);
                let free = UPWARDS * end - 0.5 * GRAVITY * end * end;
                if risen.is_nan() || risen > HELD * free {
                    return Err(format!(
                        "`damping` of the type `kinetic` does not act: a body that is thrown up stands {} higher at the end, \
                         where it is to stop at once and fall",
                        metres(risen)
                    ));
                }
            }
            Self::MovingBase => {
                let (found, due) = (way(0, &|_| true), 0.5 * SHAKEN * end * end);
                if !near(found, due) {
                    return Err(format!(
                        "`earthquake` does not act: a body on the base goes {} where the base goes {}",
                        metres(found),
                        metres(due)
                    ));
                }
            }
            Self::Contact => {
                let found = way(0, &|i| height(i) > CELL);
                if !near(found, flown) {
                    return Err(format!(
                        "`contact` does not act: a body that slides on another one without friction goes {} where {} are due",
                        metres(found),
                        metres(flown)
                    ));
                }
            }
            Self::Surface => {
                let (found, fallen) = (way(0, &|_| true), -way(1, &|_| true));
                let free = 0.5 * GRAVITY * end * end;
                if fallen.is_nan() || fallen > HELD * free {
                    return Err(format!(
                        "`terrain_contact` does not act: a body on triangles falls by {} where a free one falls by {}",
                        metres(fallen),
                        metres(free)
                    ));
                }
                if !near(found, flown) {
                    return Err(format!(
                        "`terrain_contact` holds a body that slides without friction: it goes {} where {} are due",
                        metres(found),
                        metres(flown)
                    ));
                }
            }
        }
        Ok(())
    }

    /// Has a solver run the problem below `folder`, in two or three dimensions, and judges its last frame. A solver that refuses
    /// the problem, or leaves no frame of it, is judged by the cases alone.
    pub(crate) fn fault(
        self,
        executable: &Executable,
        threads: usize,
        folder: &Path,
        stop: &AtomicBool,
    ) -> Option<String> {
        let axes = executable.space.axes();
        let scene = self.scene(axes)?;
        let folder = folder.join(format!("calibration-{}", self.key()));
        let out = folder.join(crate::record::key(&executable.name));
        let file = folder.join(executable.scene_file());
        let run = || -> Result<Frame, String> {
            let mut given = executable.given(&scene);
            let beside = self.file();
            if let Some((word, name, _)) = &beside {
                let whole = std::path::absolute(folder.join(name)).map_err(|e| e.to_string())?;
                given[self.key()][word] = whole.display().to_string().into();
            }
            process::prepare(&out, &file, &given)?;
            if let Some((_, name, text)) = beside {
                std::fs::write(folder.join(name), text).map_err(|error| error.to_string())?;
            }
            process::run(executable, &file, threads, &out, stop)?;
            let (last, _) = frames::last(&out).ok_or("no frame")?;
            frames::read(&last)
        };
        let frame = run().ok()?;
        let fault = self.judge(&frame, axes).err()?;
        Some(format!("{BEGIN}{fault}"))
    }
}

/// Begin of the reason of a run that is not made since a word of its scene does not act.
const BEGIN: &str = "calibration of words: ";

/// True for such a reason: a finer run has it, too.
#[must_use]
pub fn is_word_fault(reason: &str) -> bool {
    reason.starts_with(BEGIN)
}

/// Two triangles over the whole mesh and a cell around it, one cell above its lower plane, with their normals up.
fn plane_of_triangles() -> String {
    let (low, high) = (-CELL, CELL * (CELLS + 2 * AIR + 1) as f64);
    let mut text = "solid plane\n".to_owned();
    for corners in [
        [(low, low), (low, high), (high, low)],
        [(high, low), (low, high), (high, high)],
    ] {
        text.push_str("facet normal 0 1 0\nouter loop\n");
        for (x, z) in corners {
            text.extend([format!("vertex {x} {CELL} {z}\n")]);
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid plane\n");
    text
}

/// All planes as rollers.
fn sliding(axes: usize) -> Map<String, Value> {
    let planes = ["X0", "Xn", "Y0", "Yn", "Z0", "Zn"];
    let named = planes[..2 * axes].iter();
    named
        .map(|plane| (format!("plane_{plane}"), Value::from("sliding")))
        .collect()
}

/// A vector of one axis.
fn along(axis: usize, value: f64, axes: usize) -> Vec<f64> {
    let mut vector = vec![0.0; axes];
    vector[axis] = value;
    vector
}

/// Cells as lengths \[m\]: short decimals.
fn lengths(cells: &[usize]) -> Vec<f64> {
    cells.iter().map(|&cells| cells as f64 / 10.0).collect()
}

/// A cuboid between cells of each axis, with a velocity (m/s).
fn body(id: usize, extent: &[(usize, usize)], velocity: &[f64]) -> Value {
    let (low, high): (Vec<usize>, Vec<usize>) = extent.iter().copied().unzip();
    json!({
        "type": "cuboid", "id": id, "material_id": 1, "point_p1": lengths(&low),
        "point_p2": lengths(&high), "initial_velocity": velocity,
    })
}
