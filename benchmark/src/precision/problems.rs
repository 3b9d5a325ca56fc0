//! The problems of the cases for solvers that read no scene of ours: folders to be solved by hand, and frames judged without
//! running a solver.

use crate::bench::children::{Calibration, GuestScene, own};
use crate::record::key;
use proctor_files::output::atomic;
use proctor_verification::case::{Rung, Size};
use proctor_verification::guest::{ComparedField, Guest, Norm, ReadValue, Reading, Snapshot};
use proctor_verification::study::Study;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Velocities of frames are those at the time of their particles.
const CALIBRATED: Calibration = Calibration {
    velocity_ahead: Some(0.0),
    fall_ahead: 0.0,
};

/// Writes each run of the short study of some open cases into a folder `CASE/RUN`: the scene, the exact values as CSV, and a
/// README. The folders, in the order of the cases.
///
/// # Errors
/// A file that cannot be written, or the reason for which this program cannot run a scene to say where its particles begin.
pub fn write(folder: &Path, studies: &[Study], stop: &AtomicBool) -> Result<Vec<PathBuf>, String> {
    let own = own().ok_or("this program does not know its own file")?;
    let desk = tempfile::TempDir::new().map_err(|error| error.to_string())?;
    let mut folders = vec![];
    for &study in studies {
        for rung in study.path(Size::Quick) {
            let Ok(guest) = study.guest(&rung) else {
                continue;
            };
            let handed = GuestScene::new(&guest)?;
            let place = desk.path().join(study.name()).join(key(&rung.label));
            handed.run(&own, 1, &place, stop)?;
            let frames = handed.snapshots(&guest, &own, &CALIBRATED, &place)?;
            let folder = folder.join(study.name()).join(key(&rung.label));
            problem(study, &rung, &guest, &handed, &frames, &folder)
                .map_err(|error| format!("{}: {error}", folder.display()))?;
            folders.push(folder);
        }
    }
    Ok(folders)
}

/// The words for what is compared.
fn compared(guest: &Guest) -> (&'static str, &'static str) {
    match guest.compared {
        ComparedField::Displacement => ("displacement", "m"),
        ComparedField::Velocity => ("velocity", "m/s"),
        ComparedField::Stress => ("stress", "Pa"),
    }
}

fn problem(
    study: Study,
    rung: &Rung,
    guest: &Guest,
    handed: &GuestScene,
    frames: &[Snapshot],
    folder: &Path,
) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for (name, text) in handed.texts() {
        std::fs::write(folder.join(name), text)?;
    }
    if let Some(reading) = &guest.reading {
        let name = (study.name(), rung, study.case.question());
        return to_report(name, guest, reading, folder);
    }
    let (what, unit) = compared(guest);
    let mut table = format!("time_s,x_m,y_m,z_m,{what}_x,{what}_y,{what}_z");
    if guest.stress.is_some() {
        table.push_str(",stress_xx,stress_yy,stress_zz,stress_yz,stress_xz,stress_xy");
    }
    table.push('\n');
    for frame in frames {
        let exact = (guest.exact)(&frame.starts, frame.time);
        let of_stress = guest.stress.as_ref();
        let stresses = of_stress.map_or_else(Vec::new, |f| f(&frame.starts, frame.time));
        for (i, (start, exact)) in frame.starts.iter().zip(exact).enumerate() {
            let numbers: Vec<String> = [frame.time]
                .iter()
                .chain(start)
                .chain(&exact)
                .chain(stresses.get(i).into_iter().flatten())
                .map(ToString::to_string)
                .collect();
            let _ = writeln!(table, "{}", numbers.join(","));
        }
    }
    std::fs::write(folder.join("exact.csv"), table)?;
    let norm = match guest.norm {
        Norm::L2 => {
            "sqrt(sum |f - f_exact|^2 / sum |f_exact|^2) over all particles and frames".to_owned()
        }
        Norm::Mean(axis) => {
            format!("the mean over the particles along axis {axis}, less the exact one, over it")
        }
    };
    let second = if guest.stress.is_some() {
        " and the stress (Pa, tension positive)"
    } else {
        ""
    };
    let columns = if guest.stress.is_some() {
        ", and `Stress_XX` to `Stress_XY` for a second error, which has no bound"
    } else {
        ""
    };
    let text = format!(
        "# {name}, {label}\n\n{question}\n\n\
         - `scene.json`: the problem, SI units; `proctor keys WORD` explains its words.\n\
         - `exact.csv`: the exact {what} ({unit}){second} of particles that began at x, y, z, at each time.\n\
         - Norm: {norm}.\n\
         - Frames are `.vtu` files with point data `Displacement` (m) and, for velocities, `Velocity` (m/s){columns}, with a\n  \
         `.pvd` of their times.\n\
         - Judged by `proctor judge {name} FRAMES --run {key}`; bound: `--bound`, else 1 %.\n",
        name = study.name(),
        label = rung.label,
        question = study.case.question(),
        key = key(&rung.label),
    );
    std::fs::write(folder.join("README.md"), text)
}

/// The files beside the scene of a problem whose number is reported: the reference, and a README.
fn to_report(
    (name, rung, question): (&str, &Rung, &str),
    guest: &Guest,
    reading: &Reading,
    folder: &Path,
) -> std::io::Result<()> {
    let table = format!(
        "number,reference,source\n{},{},\"{}\"\n",
        reading.name, reading.reference, reading.source
    );
    std::fs::write(folder.join("reference.csv"), table)?;
    let needed = match guest.compared {
        ComparedField::Stress => {
            "`Displacement` (m) and `Stress_XX` and `Stress_YY` (Pa, tension positive)"
        }
        ComparedField::Velocity => {
            "`Displacement` (m), `Velocity` (m/s) and `Stress_XX` to `Stress_XY` (Pa, tension positive)"
        }
        ComparedField::Displacement => "`Displacement` (m)",
    };
    let text = format!(
        "# {name}, {label}\n\n{question}\n\n\
         - `scene.json`: the problem, SI units; `proctor keys WORD` explains its words.\n\
         - `reference.csv`: the number that is read off the frames, {number}, and its reference: {source}.\n\
         - Frames are `.vtu` files with point data {needed}, with a `.pvd` of their times; {count} of them.\n\
         - Reported by `proctor judge {name} FRAMES --run {key}`; no bound, but that of `--bound`.\n",
        label = rung.label,
        number = reading.name,
        source = reading.source,
        count = guest.scene.results.print,
        key = key(&rung.label),
    );
    std::fs::write(folder.join("README.md"), text)
}

/// Findings on frames that lie in a folder.
pub struct FrameErrors {
    /// Relative error.
    pub error: f64,
    /// That of the stress, where the case has one and the frames hold stresses.
    pub stress: Option<f64>,
    /// The number that is reported, where the case has no exact field.
    pub reported: Option<ReadValue>,
}

/// Judges frames that lie in a folder, on a run of a case.
///
/// # Errors
/// If they have no error.
pub fn judge(study: Study, rung: &Rung, frames: &Path) -> Result<FrameErrors, String> {
    let guest = study.guest(rung)?;
    let handed = GuestScene::new(&guest)?;
    let own = own().ok_or("this program does not know its own file")?;
    let frames = handed.read(&guest, own.time_label, &CALIBRATED, frames)?;
    let reported = guest.reading.as_ref().map(|reading| reading.of(&frames));
    Ok(FrameErrors {
        error: guest.error(&frames)?,
        stress: guest.stress_error(&frames),
        reported: reported.transpose()?,
    })
}

/// Writes exact values and the error of each particle beside the frames of a solver, for its last frame.
///
/// # Errors
/// If the file cannot be written.
pub fn keep_fields(guest: &Guest, frame: &Snapshot, path: &Path) -> Result<(), String> {
    let exact = (guest.exact)(&frame.starts, frame.time);
    let (what, _) = compared(guest);
    let vectors = |values: &[[f64; 3]]| {
        let rows: Vec<String> = values
            .iter()
            .map(|v| format!("{:e} {:e} {:e}", v[0], v[1], v[2]))
            .collect();
        rows.join("\n")
    };
    let errors: Vec<String> = frame
        .values
        .iter()
        .zip(&exact)
        .map(|(value, exact)| {
            let squares = (0..3).map(|axis| (value[axis] - exact[axis]).powi(2));
            format!("{:e}", squares.sum::<f64>().sqrt())
        })
        .collect();
    let count = frame.starts.len();
    let array = |name: &str, components: usize, text: &str| {
        format!(
            "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">\n{text}\n</DataArray>\n"
        )
    };
    let whole = |text: &str| format!("<DataArray type=\"Int64\" {text}</DataArray>\n");
    let numbers = |of: &dyn Fn(usize) -> usize| -> String {
        (0..count)
            .map(|i| of(i).to_string())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid><Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{count}\">\n<Points>{}</Points>\n\
         <PointData>{}{}{}</PointData>\n<Cells>{}{}{}</Cells>\n</Piece></UnstructuredGrid></VTKFile>\n",
        array("Position at the start", 3, &vectors(&frame.starts)),
        array(&format!("Computed {what}"), 3, &vectors(&frame.values)),
        array(&format!("Exact {what}"), 3, &vectors(&exact)),
        array("Error", 1, &errors.join("\n")),
        whole(&format!(
            "Name=\"connectivity\" format=\"ascii\">{}",
            numbers(&|i| i)
        )),
        whole(&format!(
            "Name=\"offsets\" format=\"ascii\">{}",
            numbers(&|i| i + 1)
        )),
        whole(&format!(
            "Name=\"types\" format=\"ascii\">{}",
            numbers(&|_| 1)
        )),
    );
    atomic::write(path, |file| file.write_all(text.as_bytes())).map_err(|error| error.to_string())
}
