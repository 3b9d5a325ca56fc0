//! STL files, ASCII and binary.
//!
//! Of a triangle its corners are taken; the normal that a file holds beside them is redundant, often zero, and not used.
//!
//! The reader is our own. One from elsewhere gives neither the line nor the triangle of a fault and rounds ASCII
//! coordinates to 32 bits.

use proctor_contact::geometry::surface::{Point, Surface, SurfaceErrorKind};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::SplitWhitespace;

/// The surface in a file cannot be read or used. Triangles are counted from 1, as in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct StlError {
    /// The file.
    pub file: PathBuf,
    /// Kind of the fault.
    pub kind: StlErrorKind,
}

/// Kind of a fault in an STL file.
#[derive(Clone, Debug, PartialEq)]
pub enum StlErrorKind {
    /// The file could not be read.
    Unreadable(String),
    /// A binary file is shorter or longer than its number of triangles says.
    Length {
        /// Triangles that the header announces.
        triangles: u32,
        /// Bytes that such a file has.
        expected: u64,
        /// Bytes that the file has.
        found: u64,
    },
    /// A line of an ASCII file is not what the format has there.
    Line {
        /// Line, from 1.
        line: usize,
        /// Triangle that it belongs to, from 1.
        triangle: usize,
        /// Text that was found.
        found: String,
        /// Text that the format has there.
        accepted: &'static str,
    },
    /// Its triangles make no surface.
    Surface(SurfaceErrorKind),
}

impl StlErrorKind {
    /// Text that would be accepted in the place of the found one.
    #[must_use]
    pub fn accepted(&self) -> &'static str {
        match self {
            Self::Unreadable(_) => "an STL file, ASCII or binary, that can be read",
            Self::Length { .. } => "a whole file: 84 bytes and 50 for each triangle",
            Self::Line { accepted, .. } => accepted,
            Self::Surface(kind) => kind.accepted(),
        }
    }
}

impl fmt::Display for StlErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(reason) => write!(f, "{reason}"),
            Self::Length {
                triangles,
                expected,
                found,
            } => write!(
                f,
                "{found} bytes where {triangles} triangles take {expected}"
            ),
            Self::Line {
                line,
                triangle,
                found,
                ..
            } => write!(f, "line {line} (triangle {triangle}): {found}"),
            Self::Surface(kind) => kind.fmt(f),
        }
    }
}

impl fmt::Display for StlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, kind } = self;
        let (file, accepted) = (file.display(), kind.accepted());
        write!(f, "{file}: found {kind}; accepted: {accepted}")
    }
}

impl std::error::Error for StlError {}

impl From<SurfaceErrorKind> for StlErrorKind {
    fn from(kind: SurfaceErrorKind) -> Self {
        Self::Surface(kind)
    }
}

/// Bytes of the header of a binary file, and of each triangle.
const HEADER: usize = 84;
const RECORD: usize = 50;

/// Reads a surface from an STL file, ASCII or binary, coordinates in metres, and checks it.
///
/// # Errors
/// A file that cannot be read, is cut off or is no STL, and all that [`Surface::new`] finds.
pub fn read(path: &Path) -> Result<Surface, StlError> {
    let in_file = |kind| StlError {
        file: path.to_owned(),
        kind,
    };
    let bytes = crate::reading::read(path)
        .map_err(|error| in_file(StlErrorKind::Unreadable(error.to_string())))?;
    let corners = parse(&bytes).map_err(in_file)?;
    Surface::new(&corners).map_err(|error| in_file(error.kind.into()))
}

/// Corners of the triangles of an STL file \[m\].
///
/// A file whose length fits the number of triangles in a binary header is binary, whatever its header says: some
/// programs write `solid` there. Several solids in an ASCII file are one surface.
///
/// # Errors
/// Bytes that are neither format, cut off, or hold no triangle.
pub fn parse(bytes: &[u8]) -> Result<Vec<[Point; 3]>, StlErrorKind> {
    if bytes.is_empty() {
        return Err(SurfaceErrorKind::Empty.into());
    }
    let announced = bytes
        .get(HEADER - 4..HEADER)
        .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let length = announced.map(|n| HEADER as u64 + RECORD as u64 * u64::from(n));
    let is_binary = length == Some(bytes.len() as u64);
    let begins_as_text = bytes
        .trim_ascii_start()
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if !is_binary && begins_as_text {
        return match std::str::from_utf8(bytes) {
            Ok(text) => ascii(text),
            // Header and file name may hold anything; numbers are plain letters in every encoding.
            Err(_) => ascii(&String::from_utf8_lossy(bytes)),
        };
    }
    match (announced, length) {
        (Some(0), _) if is_binary => Err(SurfaceErrorKind::Empty.into()),
        (Some(_), _) if is_binary => Ok(binary(&bytes[HEADER..])),
        (Some(triangles), Some(expected)) => Err(StlErrorKind::Length {
            triangles,
            expected,
            found: bytes.len() as u64,
        }),
        _ => Err(StlErrorKind::Unreadable(format!(
            "{} bytes that neither begin with `solid` nor hold the 84 bytes of a binary header",
            bytes.len()
        ))),
    }
}

fn binary(records: &[u8]) -> Vec<[Point; 3]> {
    let number = |record: &[u8], i: usize| {
        let b = &record[4 * i..];
        f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
    };
    records
        .chunks_exact(RECORD)
        .map(|record| {
            // Twelve numbers, of which the first three are the normal.
            [3, 6, 9].map(|first| [0, 1, 2].map(|axis| number(record, first + axis)))
        })
        .collect()
}

/// The lines of an ASCII file that are not empty, with their numbers.
struct Lines<'a> {
    rest: std::iter::Enumerate<std::str::Lines<'a>>,
    last: usize,
    triangle: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Option<&'a str> {
        for (i, line) in self.rest.by_ref() {
            self.last = i + 1;
            if !line.trim().is_empty() {
                return Some(line.trim());
            }
        }
        None
    }

    fn fault(&self, line: Option<&str>, accepted: &'static str) -> StlErrorKind {
        StlErrorKind::Line {
            line: self.last,
            triangle: self.triangle,
            found: line.map_or_else(|| "the end of the file".into(), |line| format!("{line:?}")),
            accepted,
        }
    }

    /// A line that begins with the words; what follows them.
    fn expect(
        &mut self,
        words: &[&str],
        accepted: &'static str,
    ) -> Result<SplitWhitespace<'a>, StlErrorKind> {
        let line = self.next();
        line.and_then(|line| after(line, words))
            .ok_or_else(|| self.fault(line, accepted))
    }

    fn vertex(&mut self) -> Result<Point, StlErrorKind> {
        const ACCEPTED: &str = "`vertex` and three finite numbers";
        let line = self.next();
        let numbers: Option<Vec<f64>> = line
            .and_then(|line| after(line, &["vertex"]))
            .and_then(|words| words.map(|word| word.parse().ok()).collect());
        match numbers.as_deref() {
            Some(&[x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() => Ok([x, y, z]),
            _ => Err(self.fault(line, ACCEPTED)),
        }
    }
}

/// Words that follow these at the beginning of a line.
fn after<'a>(line: &'a str, words: &[&str]) -> Option<SplitWhitespace<'a>> {
    let mut found = line.split_whitespace();
    words
        .iter()
        .all(|word| found.next().is_some_and(|f| f.eq_ignore_ascii_case(word)))
        .then_some(found)
}

fn ascii(text: &str) -> Result<Vec<[Point; 3]>, StlErrorKind> {
    let mut lines = Lines {
        rest: text.lines().enumerate(),
        last: 0,
        triangle: 1,
    };
    let mut corners = vec![];
    lines.expect(&["solid"], "`solid`")?;
    loop {
        let line = lines.next();
        if line.is_some_and(|line| after(line, &["facet", "normal"]).is_some()) {
            lines.expect(&["outer", "loop"], "`outer loop`")?;
            corners.push([lines.vertex()?, lines.vertex()?, lines.vertex()?]);
            lines.expect(&["endloop"], "`endloop`")?;
            lines.expect(&["endfacet"], "`endfacet`")?;
            lines.triangle += 1;
        } else if line.is_some_and(|line| after(line, &["endsolid"]).is_some()) {
            match lines.next() {
                None => break,
                Some(line) if after(line, &["solid"]).is_some() => {}
                Some(line) => return Err(lines.fault(Some(line), "`solid` or the end of the file")),
            }
        } else {
            return Err(lines.fault(line, "`facet normal` or `endsolid`"));
        }
    }
    if corners.is_empty() {
        return Err(SurfaceErrorKind::Empty.into());
    }
    Ok(corners)
}
