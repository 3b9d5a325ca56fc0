//! One frame: points at one time, as a VTK XML file that `ParaView` and VTK read.
//!
//! Particles are an unstructured grid (`.vtu`) with one vertex cell per particle, so that it is visible without a
//! filter; points that are joined by lines are poly data (`.vtp`). The numbers follow the XML in one `AppendedData` section, raw and little-endian: each array is an 8-byte length and its
//! values, or, compressed, the block table of `vtkZLibDataCompressor` and its blocks.

use std::collections::HashSet;
use std::io::{self, Write};
use std::ops::Not;
use std::path::Path;

mod appended;

use self::appended::{AppendedArrays, Values};
use super::{OutputError, atomic};

/// The particles at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Time of the state written \[s\]; finite.
    pub time: f64,
    /// Number of steps done.
    pub step: u64,
    /// Particle positions \[m\]; in two dimensions the third component is zero.
    pub points: Vec<[f64; 3]>,
    /// Point data, each as long as `points`.
    pub arrays: Vec<Array>,
    /// Lines between two points each, by their numbers from 0; none for particles.
    pub lines: Vec<[i64; 2]>,
}

impl Frame {
    /// End of the file names with this frame: `vtp` with lines, else `vtu`.
    #[must_use]
    pub fn extension(&self) -> &'static str {
        if self.lines.is_empty() { "vtu" } else { "vtp" }
    }
}

/// A named quantity of every particle.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Name as shown in `ParaView`, unique in the frame; any text without control characters.
    pub name: String,
    /// One value per particle.
    pub data: ArrayData,
}

impl Array {
    /// The array `name`.
    #[must_use]
    pub fn new(name: impl Into<String>, data: ArrayData) -> Self {
        Self {
            name: name.into(),
            data,
        }
    }

    /// An array of the same name and kind without values.
    pub(crate) fn without_values(&self) -> Self {
        let data = match self.data {
            ArrayData::Scalar(_) => ArrayData::Scalar(vec![]),
            ArrayData::Integer(_) => ArrayData::Integer(vec![]),
            ArrayData::Vector(_) => ArrayData::Vector(vec![]),
        };
        Self::new(self.name.clone(), data)
    }
}

/// One value per particle, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum ArrayData {
    /// A real number, VTK type `Float64`, not-a-number and infinities included.
    Scalar(Vec<f64>),
    /// A whole number, VTK type `Int64`.
    Integer(Vec<i64>),
    /// A vector, three components of VTK type `Float64`.
    Vector(Vec<[f64; 3]>),
}

impl ArrayData {
    /// Number of particles it has values for.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Integer(values) => values.len(),
            Self::Vector(values) => values.len(),
        }
    }

    /// The values in another order: those at these places.
    pub(crate) fn in_order(&self, order: &[usize]) -> Self {
        match self {
            Self::Scalar(values) => Self::Scalar(order.iter().map(|&i| values[i]).collect()),
            Self::Integer(values) => Self::Integer(order.iter().map(|&i| values[i]).collect()),
            Self::Vector(values) => Self::Vector(order.iter().map(|&i| values[i]).collect()),
        }
    }

    /// True if it has no values.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Storage of the numbers of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// Plain bytes: the fastest to write and to read. Doubles of a running simulation hardly compress.
    #[default]
    None,
    /// Compressed with zlib, at a level from 1 (fast) to 9 (small); larger levels count as 9. Uses the current rayon pool; the
    /// bytes do not depend on the number of threads.
    Zlib(u32),
}

/// Writes `frame` to `path`, atomically.
///
/// # Errors
/// [`OutputError::Time`] if the time is not finite, [`OutputError::Length`] if an array is not as long as the
/// points, [`OutputError::Name`] if a name is empty, repeated or has control characters, [`OutputError::Write`] if
/// the file cannot be written. In each case the file is as it was.
pub fn write(path: &Path, frame: &Frame, compression: Compression) -> Result<(), OutputError> {
    check(path, frame)?;
    atomic::write(path, |file| fill(file, frame, compression))
}

/// Length in bytes of the file of `frame` without compression.
#[must_use]
pub fn bytes(frame: &Frame) -> u64 {
    let mut counter = ByteCounter(0);
    // Counting does not fail.
    let _ = fill(&mut counter, frame, Compression::None);
    counter.0
}

/// Counts what is written and keeps none of it.
struct ByteCounter(u64);

impl Write for ByteCounter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn check(path: &Path, frame: &Frame) -> Result<(), OutputError> {
    if !frame.time.is_finite() {
        return Err(OutputError::Time {
            path: path.to_path_buf(),
            time: frame.time,
            last: None,
        });
    }
    let n = frame.points.len();
    if let Some(k) = frame
        .lines
        .as_flattened()
        .iter()
        .find(|k| usize::try_from(**k).is_ok_and(|k| k < n).not())
    {
        return Err(OutputError::Name {
            path: path.to_path_buf(),
            name: format!("line to point {k}"),
            reason: "there is no such point",
        });
    }
    let mut names = HashSet::new();
    for array in &frame.arrays {
        let name = array.name.as_str();
        if array.data.len() != frame.points.len() {
            return Err(OutputError::Length {
                path: path.to_path_buf(),
                name: name.to_owned(),
                expected: frame.points.len(),
                found: array.data.len(),
            });
        }
        let reason = if name.is_empty() {
            "it is empty"
        } else if name
            .chars()
            .any(|c| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'))
        {
            "it has a character that XML does not allow"
        } else if names.insert(name) {
            continue;
        } else {
            "another array has it"
        };
        return Err(OutputError::Name {
            path: path.to_path_buf(),
            name: name.to_owned(),
            reason,
        });
    }
    Ok(())
}

fn fill(file: &mut dyn Write, frame: &Frame, compression: Compression) -> io::Result<()> {
    let n = frame.points.len();
    let kind = if frame.lines.is_empty() {
        "UnstructuredGrid"
    } else {
        "PolyData"
    };
    let mut appended = AppendedArrays::new(compression);
    write!(
        file,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n\
         <{kind}>\n\
         <FieldData>\n\
         <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{:?}</DataArray>\n\
         <DataArray type=\"Int64\" Name=\"Step\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n\
         </FieldData>\n\
         <Piece NumberOfPoints=\"{n}\" {}>\n",
        match compression {
            Compression::None => "",
            Compression::Zlib(_) => " compressor=\"vtkZLibDataCompressor\"",
        },
        frame.time,
        frame.step,
        if frame.lines.is_empty() {
            format!("NumberOfCells=\"{n}\"")
        } else {
            format!(
                "NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"",
                frame.lines.len()
            )
        },
    )?;
    writeln!(file, "<PointData>")?;
    for array in &frame.arrays {
        let (values, components) = match &array.data {
            ArrayData::Scalar(values) => (Values::Float(values), 1),
            ArrayData::Integer(values) => (Values::Integer(values), 1),
            ArrayData::Vector(values) => (Values::Float(values.as_flattened()), 3),
        };
        appended.declare(file, &array.name, components, values)?;
    }
    writeln!(file, "</PointData>\n<Points>")?;
    appended.declare(
        file,
        "Points",
        3,
        Values::Float(frame.points.as_flattened()),
    )?;
    let (element, connectivity, offsets) = if frame.lines.is_empty() {
        (
            "Cells",
            Values::Count {
                from: 0,
                step: 1,
                n,
            },
            Values::Count {
                from: 1,
                step: 1,
                n,
            },
        )
    } else {
        (
            "Lines",
            Values::Integer(frame.lines.as_flattened()),
            Values::Count {
                from: 2,
                step: 2,
                n: frame.lines.len(),
            },
        )
    };
    writeln!(file, "</Points>\n<{element}>")?;
    appended.declare(file, "connectivity", 1, connectivity)?;
    appended.declare(file, "offsets", 1, offsets)?;
    if frame.lines.is_empty() {
        appended.declare(file, "types", 1, Values::Vertices(n))?;
    }
    write!(
        file,
        "</{element}>\n</Piece>\n</{kind}>\n<AppendedData encoding=\"raw\">\n_"
    )?;
    appended.write(file)?;
    write!(file, "\n</AppendedData>\n</VTKFile>\n")
}

/// `text` as the value of an XML attribute in double quotes.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// The text that [`escape`] made into `text`.
pub(super) fn unescape(text: &str) -> String {
    // The ampersand last, or `&amp;lt;` would be unescaped twice.
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&apos;", "'")
        .replace("&amp;", "&")
}
