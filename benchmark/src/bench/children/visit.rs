//! A problem of a case, run by an executable: its scene as a file, and its frames as what the case compares.

use super::calibration::Calibration;
use super::compare::displacements;
use super::process;
use super::said::with_words;
use super::written::written;
use crate::bench::config::{Executable, TimeLabel};
use crate::frames::{self, Frame};
use crate::measure::Spent;
use crate::show::number;
use proctor_files::json::write;
use proctor_scene::{Field, TimeStep};
use proctor_verification::guest::{ComparedField, Guest, Snapshot};
use serde_json::Value;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Steps by which the last frame may miss the end of the scene.
const END: f64 = 1.5;

/// The file beside a scene with loads on nodes: what they are integrated from.
const TRACTIONS: &str = "tractions.csv";

/// Words of a scene that name a file, by their blocks.
const FILES: [[&str; 2]; 2] = [["earthquake", "file"], ["terrain_contact", "stl_mesh"]];

/// Names a file of the scene with its folder: not every solver looks for it beside the scene.
fn name_whole(scene: &mut Value, name: &str, folder: &Path) -> Result<(), String> {
    for [block, word] in FILES {
        if scene[block][word] == name {
            let whole =
                std::path::absolute(folder.join(name)).map_err(|error| error.to_string())?;
            scene[block][word] = whole.display().to_string().into();
        }
    }
    Ok(())
}

/// The tractions of a problem: corners of each rectangle (m) and force over area (Pa).
fn tractions(guest: &Guest) -> String {
    let mut text = "x1_m,y1_m,z1_m,x2_m,y2_m,z2_m,tx_pa,ty_pa,tz_pa\n".to_owned();
    for traction in &guest.tractions {
        let value = traction.traction.constant().unwrap_or_default();
        let numbers = traction.p1.iter().chain(&traction.p2).chain(&value);
        let numbers: Vec<String> = numbers.map(ToString::to_string).collect();
        text.push_str(&numbers.join(","));
        text.push('\n');
    }
    text
}

/// The scene of a problem as executables get it.
pub(crate) struct GuestScene {
    scene: Value,
    files: Vec<(String, String)>,
    /// The constant step \[s\].
    step: f64,
}

impl GuestScene {
    /// Scene of a problem.
    ///
    /// # Errors
    /// If a scene file cannot hold a part of its scene.
    pub(crate) fn new(guest: &Guest) -> Result<Self, String> {
        let text = write(&guest.scene).map_err(|error| error.to_string())?;
        let scene = written(text.scene, &guest.scene);
        let TimeStep::Fixed { dt, .. } = guest.scene.time_step else {
            return Err("its scene has no constant step".to_owned());
        };
        let mut files = text.files;
        if !guest.tractions.is_empty() {
            files.push((TRACTIONS.to_owned(), tractions(guest)));
        }
        Ok(Self {
            scene,
            files,
            step: dt,
        })
    }

    /// Runs the scene in `folder` with an executable, results in a folder of its own there; the time of its process.
    ///
    /// # Errors
    /// If it fails, with its last output.
    pub(crate) fn run(
        &self,
        executable: &Executable,
        threads: usize,
        folder: &Path,
        stop: &AtomicBool,
    ) -> Result<Spent, String> {
        let out = folder.join(crate::record::key(&executable.name));
        let file = folder.join(executable.scene_file());
        let run = || {
            let mut given = executable.given(&self.scene);
            for (name, _) in &self.files {
                name_whole(&mut given, name, folder)?;
            }
            process::prepare(&out, &file, &given)?;
            for (name, text) in &self.files {
                let path = folder.join(name);
                std::fs::write(&path, text)
                    .map_err(|error| format!("{}: {error}", path.display()))?;
            }
            process::run(executable, &file, threads, &out, stop)
        };
        run()
            .map(|finished| finished.spent)
            .map_err(|reason| with_words(&reason, &out))
    }

    /// Runs it once before it is timed, where its executable compiles its kernels for each scene.
    ///
    /// # Errors
    /// If it fails, with its last output.
    pub(crate) fn warm_up(
        &self,
        executable: &Executable,
        threads: usize,
        folder: &Path,
        stop: &AtomicBool,
    ) -> Result<(), String> {
        if executable.warm_up {
            self.run(executable, threads, folder, stop)?;
        }
        Ok(())
    }

    /// The frames that an executable left in `folder`, as the problem compares them; never none.
    ///
    /// # Errors
    /// If they cannot be compared, with the last output of the executable.
    pub(crate) fn snapshots(
        &self,
        guest: &Guest,
        executable: &Executable,
        calibration: &Calibration,
        folder: &Path,
    ) -> Result<Vec<Snapshot>, String> {
        let out = folder.join(crate::record::key(&executable.name));
        self.read(guest, executable.time_label, calibration, &out)
            .map_err(|reason| with_words(&reason, &out))
    }

    /// The files of the problem with their texts, the scene first.
    pub(crate) fn texts(&self) -> Vec<(String, String)> {
        let scene = ("scene.json".to_owned(), format!("{:#}\n", self.scene));
        std::iter::once(scene)
            .chain(self.files.iter().cloned())
            .collect()
    }

    /// The frames that lie in a folder, with times that mean what the label says; never none.
    ///
    /// # Errors
    /// If they cannot be compared.
    pub(crate) fn read(
        &self,
        guest: &Guest,
        label_means: TimeLabel,
        calibration: &Calibration,
        out: &Path,
    ) -> Result<Vec<Snapshot>, String> {
        let mut files = frames::all(out);
        let last = files.len().checked_sub(1);
        let last = last.ok_or_else(|| super::calibration::no_frame(out))?;
        let mut snapshots = vec![];
        let mut reached = 0.0;
        for (i, (file, said)) in files.drain(..).enumerate() {
            if guest.last_alone && i < last {
                continue;
            }
            let frame = frames::read(&file)?;
            let label = match said.or(frame.time) {
                Some(label) => label,
                // A frame without a time is of no use, but for the last, which is of the end.
                None if i == last => guest.scene.time,
                None => continue,
            };
            // The state at the start is no answer.
            if label <= 0.5 * self.step {
                continue;
            }
            reached = label + label_means.ahead() * self.step;
            snapshots.push(self.snapshot(guest, calibration, &frame, reached)?);
        }
        let ends = (reached - guest.scene.time).abs() <= END * self.step;
        if !ends {
            return Err(format!(
                "its last particles are at {} s where the scene ends at {} s",
                number(reached),
                number(guest.scene.time)
            ));
        }
        let asked = guest.scene.results.print;
        if !guest.last_alone && snapshots.len() + 1 < asked {
            return Err(format!(
                "{} frames after the start where `print` asks for {asked}",
                snapshots.len()
            ));
        }
        Ok(snapshots)
    }

    fn snapshot(
        &self,
        guest: &Guest,
        calibration: &Calibration,
        frame: &Frame,
        time: f64,
    ) -> Result<Snapshot, String> {
        let u = displacements(frame)?;
        let starts = frame.points.iter().zip(&u);
        let starts = starts.map(|(x, u)| std::array::from_fn(|axis| x[axis] - u[axis]));
        let starts = starts.collect();
        // Stresses that are a second error may be missing; a number that is read off them may not.
        let needed = guest.reading.is_some() && guest.scene.results.fields.contains(&Field::Stress);
        let stresses = if needed || guest.stress.is_some() {
            stresses(frame, needed)?
        } else {
            vec![]
        };
        let (values, time) = match guest.compared {
            ComparedField::Displacement => (u.clone(), time),
            ComparedField::Velocity => {
                let known = frame.vectors("Velocity").zip(calibration.velocity_ahead);
                let (v, ahead) = known.ok_or("no point data `Velocity` of 3 components")?;
                (v, time + ahead * self.step)
            }
            ComparedField::Stress => {
                let normal = |s: &[f64; 6]| [s[0], s[1], if s[2].is_nan() { 0.0 } else { s[2] }];
                (stresses.iter().map(normal).collect(), time)
            }
        };
        Ok(Snapshot {
            time,
            starts,
            values,
            displacements: u,
            stresses,
        })
    }
}

/// Components of the stress in the columns of a frame, the first two of which every solver has.
const STRESSES: [&str; 6] = [
    "Stress_XX",
    "Stress_YY",
    "Stress_ZZ",
    "Stress_YZ",
    "Stress_XZ",
    "Stress_XY",
];

/// Stresses of the particles \[Pa\], NaN for a component without a column; none where the frame lacks one of the first
/// two, which is an error where they are needed.
fn stresses(frame: &Frame, needed: bool) -> Result<Vec<[f64; 6]>, String> {
    let columns = STRESSES.map(|name| frame.scalars(name));
    let missing = STRESSES.iter().zip(&columns).take(2);
    let mut missing = missing.filter(|(_, column)| column.is_none());
    if let Some((name, _)) = missing.next() {
        if needed {
            return Err(format!(
                "no point data `{name}` of one component; the case reads stresses"
            ));
        }
        return Ok(vec![]);
    }
    let all = |i: usize| columns.map(|column| column.map_or(f64::NAN, |column| column[i]));
    let wrong = |column: &&[f64]| column.iter().any(|stress| !stress.is_finite());
    if columns.iter().flatten().any(wrong) {
        return Err("a stress that is not finite".to_owned());
    }
    Ok((0..frame.points.len()).map(all).collect())
}
