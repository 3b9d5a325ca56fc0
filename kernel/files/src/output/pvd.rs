//! `particles.pvd`: the list of frames with their times, which is what one opens in `ParaView`.

use std::fmt::Write as _;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::vtu::{self, Compression, Frame, escape, unescape};
use super::{OutputError, OutputFolder, atomic, earlier, pieces};

/// Beginning of the names of the files that hold particles.
pub(crate) const PARTICLES: &str = "particles";
/// Beginning of the names of the files that hold nodes.
pub(crate) const GRID: &str = "grid";
/// Beginning of the names of the files that hold boundaries.
pub(crate) const BOUNDARIES: &str = "boundaries";
/// End of the name of a frame in pieces.
pub(super) const PARALLEL: &str = "pvtu";
/// Ends of the names of frames.
pub(super) const EXTENSIONS: [&str; 3] = ["vtu", "vtp", PARALLEL];

/// Name of the list of particle frames in the output folder.
pub const LIST: &str = "particles.pvd";

/// One frame in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameEntry {
    /// File name, relative to the list.
    pub file: String,
    /// Time of the frame \[s\].
    pub time: f64,
}

/// The frames of a run. Times increase strictly.
#[derive(Debug)]
pub struct Series {
    folder: OutputFolder,
    stem: &'static str,
    compression: Compression,
    entries: Vec<FrameEntry>,
}

impl Series {
    /// A new series in `folder`, and its list with no frames, so that `ParaView` never opens the list of an earlier
    /// run. Frame files of an earlier run are left alone until a frame of the same number replaces them;
    /// [`super::earlier::clear`] takes them away.
    ///
    /// # Errors
    /// [`OutputError::Write`].
    pub fn create(folder: OutputFolder, compression: Compression) -> Result<Self, OutputError> {
        Self::create_named(folder, PARTICLES, compression)
    }

    /// As [`Series::create`], with another word than `particles` at the beginning of the names of its files.
    ///
    /// # Errors
    /// [`OutputError::Write`].
    pub fn create_named(
        folder: OutputFolder,
        stem: &'static str,
        compression: Compression,
    ) -> Result<Self, OutputError> {
        let series = Self {
            folder,
            stem,
            compression,
            entries: Vec::new(),
        };
        series.write_list()?;
        Ok(series)
    }

    /// Goes on with the series in `folder` from `restart_time` \[s\]: later frames leave the list and the folder (the
    /// run makes them again as it gets there). Where there is no list yet, the series is empty.
    ///
    /// # Errors
    /// [`OutputError::Read`], [`OutputError::Malformed`] if the list is not as this program writes it,
    /// [`OutputError::Write`].
    pub fn resume(
        folder: OutputFolder,
        compression: Compression,
        restart_time: f64,
    ) -> Result<Self, OutputError> {
        Self::resume_named(folder, PARTICLES, compression, restart_time)
    }

    /// As [`Series::resume`], for a series that [`Series::create_named`] began.
    ///
    /// # Errors
    /// As [`Series::resume`].
    pub fn resume_named(
        folder: OutputFolder,
        stem: &'static str,
        compression: Compression,
        restart_time: f64,
    ) -> Result<Self, OutputError> {
        let (entries, later) = read_list(&folder.file(&list_name(stem)))?
            .into_iter()
            .partition(|entry: &FrameEntry| entry.time <= restart_time);
        let series = Self {
            folder,
            stem,
            compression,
            entries,
        };
        // The list first: a run that is killed in between has no list that names what is gone.
        series.write_list()?;
        earlier::drop_frames(&series.folder, stem, &later)?;
        Ok(series)
    }

    /// Writes `frame` as the next file and then the list with it. Returns the path of the frame.
    ///
    /// # Errors
    /// [`OutputError::Time`] if the frame is not later than the last one; else as [`vtu::write`]. The list then
    /// stays as it was.
    pub fn write_frame(&mut self, frame: &Frame) -> Result<PathBuf, OutputError> {
        self.require_later(frame.time)?;
        let file = name_of(self.stem, self.next_number(), frame.extension());
        let path = self.folder.file(&file);
        vtu::write(&path, frame, self.compression)?;
        self.list(file, frame.time)?;
        Ok(path)
    }

    /// Writes the file that names the pieces of the next frame, which lie in its folder, and then the list with it. `frame` is one
    /// of the pieces.
    ///
    /// # Errors
    /// As [`Series::write_frame`].
    pub fn list_pieces(&mut self, frame: &Frame, pieces: usize) -> Result<(), OutputError> {
        self.require_later(frame.time)?;
        let number = self.next_number();
        pieces::write_list(&self.folder, (self.stem, number), frame, pieces)?;
        self.list(name_of(self.stem, number, PARALLEL), frame.time)
    }

    fn require_later(&self, time: f64) -> Result<(), OutputError> {
        match self.last_time() {
            Some(last) if time <= last || !time.is_finite() => Err(OutputError::Time {
                path: self.list_path(),
                time,
                last: Some(last),
            }),
            _ => Ok(()),
        }
    }

    /// Adds a frame to the list.
    fn list(&mut self, file: String, time: f64) -> Result<(), OutputError> {
        self.entries.push(FrameEntry { file, time });
        // Rewritten whole each time: about 70 bytes per frame, nothing beside the frame itself.
        self.write_list().inspect_err(|_| {
            self.entries.pop();
        })
    }

    /// The frames in the list.
    #[must_use]
    pub fn entries(&self) -> &[FrameEntry] {
        &self.entries
    }

    /// Time of the last frame \[s\]. After a restart, a state that is not later is already there.
    #[must_use]
    pub fn last_time(&self) -> Option<f64> {
        self.entries.last().map(|entry| entry.time)
    }

    fn list_path(&self) -> PathBuf {
        self.folder.file(&list_name(self.stem))
    }

    /// Number of the next frame: one more than that of the last file name, so that after a restart no listed file is replaced.
    #[must_use]
    pub fn next_number(&self) -> u64 {
        self.entries
            .iter()
            .filter_map(|entry| frame_number(self.stem, &entry.file))
            .max()
            .map_or(0, |number| number + 1)
    }

    fn write_list(&self) -> Result<(), OutputError> {
        let text = list_text(&self.entries);
        atomic::write(&self.list_path(), |file| file.write_all(text.as_bytes()))
    }
}

/// The text of a list of frames.
pub(crate) fn list_text(entries: &[FrameEntry]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <Collection>\n",
    );
    for FrameEntry { file, time } in entries {
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{}\"/>",
            escape(file)
        );
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

/// File name of the frame with this number: `particles_000000.vtu`, and more digits when six are not enough.
#[must_use]
pub fn frame_name(number: u64) -> String {
    name_of(PARTICLES, number, "vtu")
}

pub(crate) fn name_of(stem: &str, number: u64, extension: &str) -> String {
    format!("{stem}_{number:06}.{extension}")
}

pub(super) fn list_name(stem: &str) -> String {
    format!("{stem}.pvd")
}

/// The number of a file that is called as a frame is.
pub(super) fn frame_number(stem: &str, file: &str) -> Option<u64> {
    let (name, extension) = file.rsplit_once('.')?;
    let number = name.strip_prefix(stem)?.strip_prefix('_')?.parse().ok()?;
    let ours = EXTENSIONS.contains(&extension) && file == name_of(stem, number, extension);
    ours.then_some(number)
}

/// Reads the list as [`Series`] writes it, one frame a line; empty where there is none.
pub(super) fn read_list(path: &Path) -> Result<Vec<FrameEntry>, OutputError> {
    let text = match crate::reading::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(OutputError::read(path, error)),
    };
    if !text.contains("type=\"Collection\"") {
        return Err(OutputError::malformed(
            path,
            1,
            "this is no list of frames (VTK collection)",
        ));
    }
    let mut entries: Vec<FrameEntry> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let Some(attributes) = line.trim_start().strip_prefix("<DataSet ") else {
            continue;
        };
        let malformed = |reason: &str| OutputError::malformed(path, index + 1, reason);
        let time = attribute(attributes, "timestep").and_then(|text| text.parse().ok());
        let time: f64 = time
            .filter(|time: &f64| time.is_finite())
            .ok_or_else(|| malformed("no valid timestep"))?;
        let file = attribute(attributes, "file").ok_or_else(|| malformed("no file name"))?;
        if entries.last().is_some_and(|last| time <= last.time) {
            return Err(malformed("the times do not increase"));
        }
        entries.push(FrameEntry {
            file: unescape(file),
            time,
        });
    }
    Ok(entries)
}

fn attribute<'a>(attributes: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = attributes.split_once(&format!("{name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}
