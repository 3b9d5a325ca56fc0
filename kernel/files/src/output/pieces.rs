//! Frames in pieces: `particles_000000.pvtu` names a file of each rank in the folder `particles_000000`.

use super::pvd::{PARALLEL, name_of};
use super::vtu::{self, ArrayData, Compression, Frame, escape};
use super::{OutputError, OutputFolder, atomic};
use std::fmt::Write as _;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A piece of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Beginning of the names of the frames.
    pub stem: &'static str,
    /// Number of the frame.
    pub number: u64,
    /// Number of the rank whose piece it is.
    pub rank: usize,
}

impl Piece {
    /// Its path from the folder of the frames.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        Path::new(&folder_name(self.stem, self.number)).join(file_name(self.rank))
    }
}

/// Writes a piece into its folder, atomically.
///
/// # Errors
/// As [`vtu::write`].
pub fn write(
    folder: &Path,
    piece: &Piece,
    frame: &Frame,
    compression: Compression,
) -> Result<(), OutputError> {
    let path = folder.join(piece.path());
    if let Some(own) = path.parent() {
        fs::create_dir_all(own).map_err(|source| OutputError::write(own, source))?;
    }
    vtu::write(&path, frame, compression)
}

/// Writes the file that names the pieces of a frame; `frame` is one of them, and has the arrays of all.
///
/// # Errors
/// [`OutputError::Write`].
pub(super) fn write_list(
    folder: &OutputFolder,
    (stem, number): (&str, u64),
    frame: &Frame,
    pieces: usize,
) -> Result<PathBuf, OutputError> {
    let path = folder.file(&name_of(stem, number, PARALLEL));
    let text = list_text((stem, number), frame, pieces);
    atomic::write(&path, |file| file.write_all(text.as_bytes()))?;
    Ok(path)
}

fn list_text((stem, number): (&str, u64), frame: &Frame, pieces: usize) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PUnstructuredGrid GhostLevel=\"0\">\n<PPointData>\n",
    );
    // Writing to a string does not fail.
    for array in &frame.arrays {
        let (kind, components) = match array.data {
            ArrayData::Scalar(_) => ("Float64", 1),
            ArrayData::Integer(_) => ("Int64", 1),
            ArrayData::Vector(_) => ("Float64", 3),
        };
        let _ = writeln!(
            text,
            "<PDataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\"/>",
            escape(&array.name)
        );
    }
    text.push_str(
        "</PPointData>\n<PPoints>\n\
         <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n",
    );
    for rank in 0..pieces {
        let _ = writeln!(
            text,
            "<Piece Source=\"{}/{}\"/>",
            folder_name(stem, number),
            file_name(rank)
        );
    }
    text.push_str("</PUnstructuredGrid>\n</VTKFile>\n");
    text
}

/// Takes away the pieces of a frame, and their folder where nothing else lies in it.
///
/// # Errors
/// [`OutputError::Read`], [`OutputError::Write`].
pub(super) fn remove(folder: &OutputFolder, stem: &str, number: u64) -> Result<(), OutputError> {
    let path = folder.file(&folder_name(stem, number));
    let entries = match fs::read_dir(&path) {
        Err(error) if is_absent(&error) => return Ok(()),
        entries => entries.map_err(|error| OutputError::read(&path, error))?,
    };
    for entry in entries {
        let entry = entry.map_err(|error| OutputError::read(&path, error))?;
        let name = entry.file_name();
        let ours = name.to_str().is_some_and(|name| {
            let rank = name.strip_suffix(".vtu").map(str::parse::<usize>);
            matches!(rank, Some(Ok(rank)) if name == file_name(rank)) || atomic::is_temporary(name)
        });
        if ours {
            let file = entry.path();
            fs::remove_file(&file).map_err(|error| OutputError::write(&file, error))?;
        }
    }
    match fs::remove_dir(&path) {
        Err(error) if error.kind() != ErrorKind::DirectoryNotEmpty && !is_absent(&error) => {
            Err(OutputError::write(&path, error))
        }
        _ => Ok(()),
    }
}

fn is_absent(error: &std::io::Error) -> bool {
    matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory)
}

fn folder_name(stem: &str, number: u64) -> String {
    format!("{stem}_{number:06}")
}

fn file_name(rank: usize) -> String {
    format!("{rank}.vtu")
}
