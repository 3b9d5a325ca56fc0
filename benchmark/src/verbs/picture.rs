//! `proctor picture`: the particles and histories of a run as pictures.

use crate::exit::{Failure, Outcome};
use crate::frames::{self, Frame};
use crate::runs::RunHistory;
use crate::show::chart::side_by_side;
use crate::show::drawing;
use crate::show::figures::runs::histories;
use crate::show::number;
use crate::show::particles::{
    MeshLines, ParticleField, ParticlePicture, View, bounds, revolved, spacing, usual,
};
use clap::Args;
use proctor_files::output::history::HISTORY;
use proctor_files::output::pvd::LIST;
use proctor_files::output::summary::SUMMARY;
use proctor_files::output::{Summary, atomic};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Names of the files that are written.
const PNG: &str = "picture.png";
const SVG: &str = "picture.svg";
const ANIMATION: &str = "animation.png";
const CURVES: &str = "history.svg";
/// Most frames of an animation; of more every second, third and so on is taken.
const MOST_FRAMES: usize = 120;
/// Time that an animation takes \[s\], and the shortest and longest time of a frame.
const PLAYS: f64 = 6.0;
const SHOWN: [f64; 2] = [0.04, 0.5];
/// Charts side by side.
const COLUMNS: usize = 2;

/// Draw the particles of a run, coloured by a field, and its histories.
///
/// Into the folder of the run go picture.png and picture.svg with the particles of the last frame, or of the one nearest to a
/// time, and history.svg with the columns of history.csv as curves. Particles in space are seen from one direction without
/// perspective, the nearest in front. Those of an axisymmetric run are half of a section; --revolve turns it about the axis
/// into a body in space, x and y horizontal and z its height, with the values of the section. With --animate goes animation.png, an animated PNG of all frames, which browsers play.
#[derive(Args)]
#[command(
    after_help = "Example: proctor run column.json --out column && proctor picture column\n\
    Another field and time: proctor picture column --field stress_yy --at 0.5 --mesh"
)]
pub struct Picture {
    /// Folder of a run
    folder: PathBuf,
    #[command(flatten)]
    choice: Choice,
}

/// Choice of frame, field, colours and view.
#[derive(Args, Default)]
struct Choice {
    /// Field that colours the particles, such as displacement, velocity_x or mises_stress [default: displacement, else velocity or pressure]
    #[arg(long, value_name = "NAME")]
    field: Option<String>,
    /// Time of the frame; the nearest one is drawn [s] [default: the last]
    #[arg(long, value_name = "TIME")]
    at: Option<f64>,
    /// Values of the first and of the last colour [default: those of the particles]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true)]
    range: Option<[f64; 2]>,
    /// Draw the lines of the mesh, in the plane
    #[arg(long, conflicts_with = "revolve")]
    mesh: bool,
    /// Turn an axisymmetric run about its axis, through so many degrees; a wedge is left open to look inside [without a number: 270]
    #[arg(long, value_name = "DEGREES", num_args = 0..=1, default_missing_value = "270", value_parser = degrees, allow_hyphen_values = true)]
    revolve: Option<f64>,
    /// Direction to look from in space, in degrees [default: -60,25]
    #[arg(long, value_name = "AZIMUTH,ELEVATION", value_parser = View::parse, allow_hyphen_values = true)]
    view: Option<View>,
    /// Draw all frames as an animated PNG, too
    #[arg(long)]
    animate: bool,
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[low, high]) if low < high && (high - low).is_finite() => Ok([low, high]),
        _ => Err(format!(
            "found {text:?}; accepted: LOW,HIGH, two numbers, the first less"
        )),
    }
}

fn degrees(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(degrees) if degrees > 0.0 && degrees <= 360.0 => Ok(degrees),
        _ => Err(format!(
            "found {text:?}; accepted: degrees above 0, up to 360"
        )),
    }
}

impl Picture {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let written = draw(&self.folder, &self.choice).map_err(Failure::BadInput)?;
        for path in written {
            writeln!(out, "picture in {}", path.display())?;
        }
        Ok(Outcome::Fine)
    }
}

/// Draws the last frame and the histories of a run as they are drawn where nobody chooses. Returns the files.
///
/// # Errors
/// The reason why there is nothing to draw, or a file that cannot be written.
pub(super) fn draw_last(folder: &Path) -> Result<Vec<PathBuf>, String> {
    draw(folder, &Choice::default())
}

fn draw(folder: &Path, choice: &Choice) -> Result<Vec<PathBuf>, String> {
    let list = frames_of(folder);
    let history = folder.join(HISTORY);
    if list.is_empty() && !history.is_file() {
        let found = if folder.is_dir() {
            "neither frames nor a history in it"
        } else {
            "there is no such folder"
        };
        return Err(format!(
            "{}: {found}; accepted: a folder that `proctor run SCENE --out FOLDER` wrote",
            folder.display()
        ));
    }
    let summary = Summary::read(&folder.join(SUMMARY)).ok();
    let scene = summary.as_ref().map_or_else(
        || {
            folder
                .file_name()
                .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
        },
        |summary| summary.scene.clone(),
    );
    let mut files: Vec<(&str, Vec<u8>)> = vec![];
    if !list.is_empty() {
        if choice.revolve.is_some() {
            check_axis(folder, summary.as_ref())?;
        }
        let mesh = choice
            .mesh
            .then(|| mesh(folder, summary.as_ref()))
            .transpose()?;
        let run = DrawnRun {
            choice,
            scene: &scene,
            mesh,
        };
        let chosen = match choice.at {
            Some(time) => nearest(&list, time),
            None => list.len() - 1,
        };
        let (frame, time) = run.read(&list[chosen])?;
        let drawn = run.drawing(&frame, time, None)?;
        files.push((PNG, drawing::png(&drawn)));
        files.push((SVG, drawing::svg(&drawn).into_bytes()));
        if choice.animate {
            files.push((ANIMATION, run.animation(&list)?));
        }
    } else if choice.field.is_some() || choice.at.is_some() || choice.animate {
        return Err(format!(
            "{}: no frames, only a history; accepted: a run whose scene has `results.print` above 0",
            folder.display()
        ));
    }
    if history.is_file() {
        let history = RunHistory::read(&history)?;
        let charts = histories(&[(scene.clone(), &history)]);
        if !charts.is_empty() {
            files.push((
                CURVES,
                side_by_side(&scene, &charts, &[], COLUMNS).into_bytes(),
            ));
        }
    }
    let mut written = vec![];
    for (name, bytes) in files {
        let path = folder.join(name);
        atomic::write(&path, |file| file.write_all(&bytes)).map_err(|error| error.to_string())?;
        written.push(path);
    }
    Ok(written)
}

/// A run whose frames are drawn in one way.
struct DrawnRun<'a> {
    choice: &'a Choice,
    scene: &'a str,
    mesh: Option<MeshLines>,
}

/// Colours and lengths of a picture, the same for all frames of an animation.
#[derive(Clone, Copy)]
struct CommonScale {
    range: [f64; 2],
    bounds: [[f64; 3]; 2],
    spacing: f64,
}

impl CommonScale {
    /// The lengths of a frame, and no range of values yet.
    fn new(frame: &Frame) -> Self {
        let spacing = spacing(frame);
        Self {
            range: [f64::INFINITY, f64::NEG_INFINITY],
            bounds: bounds(frame, spacing),
            spacing,
        }
    }
}

impl DrawnRun<'_> {
    /// A frame as it is drawn, and its time.
    fn read(&self, file: &FrameFile) -> Result<(Frame, Option<f64>), String> {
        let (frame, time) = read(file)?;
        Ok(match self.choice.revolve {
            Some(degrees) => (revolved(&frame, spacing(&frame), degrees), time),
            None => (frame, time),
        })
    }

    fn field(&self, frame: &Frame) -> Result<ParticleField, String> {
        let name = match &self.choice.field {
            Some(name) => name.clone(),
            None => usual(frame)?,
        };
        ParticleField::of(frame, &name)
    }

    fn drawing(
        &self,
        frame: &Frame,
        time: Option<f64>,
        common: Option<&CommonScale>,
    ) -> Result<drawing::Drawing, String> {
        let field = self.field(frame)?;
        let own = || CommonScale {
            range: self.choice.range.unwrap_or_else(|| field.range()),
            ..CommonScale::new(frame)
        };
        let scale = common.copied().unwrap_or_else(own);
        let picture = ParticlePicture {
            frame,
            field: &field,
            range: scale.range,
            bounds: scale.bounds,
            spacing: scale.spacing,
            view: self.choice.view.unwrap_or_default(),
            mesh: self.mesh.as_ref(),
            title: self.scene,
            caption: &time.map_or_else(String::new, |time| format!("t = {} s", number(time))),
        };
        Ok(picture.drawing())
    }

    fn animation(&self, list: &[FrameFile]) -> Result<Vec<u8>, String> {
        let every = list.len().div_ceil(MOST_FRAMES).max(1);
        // The last frame is one of them.
        let skipped = (list.len() - 1) % every;
        let frames: Vec<(Frame, Option<f64>)> = list
            .iter()
            .skip(skipped)
            .step_by(every)
            .map(|file| self.read(file))
            .collect::<Result<_, _>>()?;
        let mut common = CommonScale::new(&frames[0].0);
        for (frame, _) in &frames {
            let [low, high] = self.field(frame)?.range();
            let corners = bounds(frame, common.spacing);
            common.range = [common.range[0].min(low), common.range[1].max(high)];
            for axis in 0..3 {
                common.bounds[0][axis] = common.bounds[0][axis].min(corners[0][axis]);
                common.bounds[1][axis] = common.bounds[1][axis].max(corners[1][axis]);
            }
        }
        common.range = self.choice.range.unwrap_or(common.range);
        let drawings = frames
            .iter()
            .map(|(frame, time)| self.drawing(frame, *time, Some(&common)))
            .collect::<Result<Vec<_>, _>>()?;
        let [least, most] = SHOWN;
        Ok(drawing::animation(
            &drawings,
            (PLAYS / drawings.len() as f64).clamp(least, most),
        ))
    }
}

/// A frame and its time, where the list of frames says it.
type FrameFile = (PathBuf, Option<f64>);

/// The particle frames of a folder in the order of their times.
fn frames_of(folder: &Path) -> Vec<FrameFile> {
    let stem = LIST.trim_end_matches(".pvd");
    let mut all = frames::all(folder);
    let is_ours = |path: &Path| {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned());
        name.is_some_and(|name| name.starts_with(stem))
    };
    // Frames of nodes and of boundaries lie beside them.
    if all.iter().any(|(path, _)| is_ours(path)) {
        all.retain(|(path, _)| is_ours(path));
    }
    all
}

fn read((path, time): &FrameFile) -> Result<(Frame, Option<f64>), String> {
    let frame = frames::read(path)?;
    let time = time.or(frame.time);
    Ok((frame, time))
}

/// The frame whose time is nearest; the last of those without a time.
fn nearest(list: &[FrameFile], time: f64) -> usize {
    let off = |i: usize| list[i].1.map_or(f64::INFINITY, |own| (own - time).abs());
    (0..list.len())
        .min_by(|a, b| off(*a).total_cmp(&off(*b)))
        .unwrap_or(0)
}

/// Refuses to revolve a run that is not axisymmetric.
fn check_axis(folder: &Path, summary: Option<&Summary>) -> Result<(), String> {
    let mesh = summary.and_then(|summary| summary.mesh.as_ref());
    let found = match mesh {
        Some(mesh) if mesh.axisymmetric => return Ok(()),
        Some(_) => "--revolve of a run whose mesh is not axisymmetric".to_owned(),
        None => format!("no mesh in {SUMMARY}, which a run writes when it ends"),
    };
    Err(format!(
        "{}: {found}; accepted: a run of a scene with `\"axisymmetric\": true` in its mesh, or no --revolve",
        folder.display()
    ))
}

/// The mesh of a run.
fn mesh(folder: &Path, summary: Option<&Summary>) -> Result<MeshLines, String> {
    let mesh = summary.and_then(|summary| summary.mesh.as_ref()).ok_or_else(|| {
        format!(
            "{}: no mesh in {SUMMARY}, which a run writes when it ends; accepted: a run that ended, or no --mesh",
            folder.display()
        )
    })?;
    let three =
        |values: &[f64]| std::array::from_fn(|axis| values.get(axis).copied().unwrap_or(0.0));
    Ok(MeshLines {
        origin: three(&mesh.origin),
        cell: three(&mesh.cell),
        cells: std::array::from_fn(|axis| mesh.cells.get(axis).map_or(0, |n| *n as usize)),
    })
}
