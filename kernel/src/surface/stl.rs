//! STL files, ASCII and binary.

use super::error::{SurfaceError, SurfaceErrorKind};
use super::{Point, Surface};
use std::path::Path;
use std::str::SplitWhitespace;

/// Bytes of the header of a binary file, and of each triangle.
const HEADER: usize = 84;
const RECORD: usize = 50;

/// Reads a surface from an STL file, ASCII or binary, coordinates in metres, and checks it.
///
/// # Errors
/// A file that cannot be read, is cut off or is no STL, and all that [`Surface::new`] finds.
pub fn read(path: &Path) -> Result<Surface, SurfaceError> {
    let in_file = |kind| SurfaceError {
        file: Some(path.to_owned()),
        kind,
    };
    let bytes = crate::memory::read(path)
        .map_err(|error| in_file(SurfaceErrorKind::Unreadable(error.to_string())))?;
    let corners = parse(&bytes).map_err(in_file)?;
    Surface::new(&corners).map_err(|error| in_file(error.kind))
}

/// Corners of the triangles of an STL file \[m\].
///
/// A file whose length fits the number of triangles in a binary header is binary, whatever its header says: some
/// programs write `solid` there. Several solids in an ASCII file are one surface.
///
/// # Errors
/// Bytes that are neither format, cut off, or hold no triangle.
pub fn parse(bytes: &[u8]) -> Result<Vec<[Point; 3]>, SurfaceErrorKind> {
    if bytes.is_empty() {
        return Err(SurfaceErrorKind::Empty);
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
        (Some(0), _) if is_binary => Err(SurfaceErrorKind::Empty),
        (Some(_), _) if is_binary => Ok(binary(&bytes[HEADER..])),
        (Some(triangles), Some(expected)) => Err(SurfaceErrorKind::Length {
            triangles,
            expected,
            found: bytes.len() as u64,
        }),
        _ => Err(SurfaceErrorKind::Unreadable(format!(
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

    fn fault(&self, line: Option<&str>, accepted: &'static str) -> SurfaceErrorKind {
        SurfaceErrorKind::Line {
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
    ) -> Result<SplitWhitespace<'a>, SurfaceErrorKind> {
        let line = self.next();
        line.and_then(|line| after(line, words))
            .ok_or_else(|| self.fault(line, accepted))
    }

    fn vertex(&mut self) -> Result<Point, SurfaceErrorKind> {
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

/// What follows the words at the beginning of a line.
fn after<'a>(line: &'a str, words: &[&str]) -> Option<SplitWhitespace<'a>> {
    let mut found = line.split_whitespace();
    words
        .iter()
        .all(|word| found.next().is_some_and(|f| f.eq_ignore_ascii_case(word)))
        .then_some(found)
}

fn ascii(text: &str) -> Result<Vec<[Point; 3]>, SurfaceErrorKind> {
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
        return Err(SurfaceErrorKind::Empty);
    }
    Ok(corners)
}
