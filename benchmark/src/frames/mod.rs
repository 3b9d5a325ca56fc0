//! Frames of any solver, read back: points and point data of VTK XML unstructured grids (`.vtu`).
//!
//! ASCII, base64 and raw, inline and appended, compressed with zlib or not, both byte orders and both header types.

mod data;
mod last;

pub use last::{all, last};

use crate::show::bytes;
use data::{Data, Encoding, Layout};
use std::collections::BTreeMap;
use std::path::Path;

/// Largest file that is read \[bytes\]: five million particles in ASCII.
const LARGEST: u64 = 1 << 30;

/// The particles of a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Positions \[m\].
    pub points: Vec<[f64; 3]>,
    /// Point data by name: components, and the values of one point after the other.
    pub arrays: BTreeMap<String, (usize, Vec<f64>)>,
    /// Time \[s\], where the file says it (`TimeValue` in its field data).
    pub time: Option<f64>,
}

impl Frame {
    /// A number of every point; the name is compared without regard to case.
    #[must_use]
    pub fn scalars(&self, name: &str) -> Option<&[f64]> {
        let mut arrays = self.arrays.iter();
        match arrays.find(|(known, _)| known.eq_ignore_ascii_case(name)) {
            Some((_, (1, values))) => Some(values),
            _ => None,
        }
    }

    /// A vector of every point; the name is compared without regard to case.
    #[must_use]
    pub fn vectors(&self, name: &str) -> Option<Vec<[f64; 3]>> {
        let found = self
            .arrays
            .iter()
            .find(|(known, _)| known.eq_ignore_ascii_case(name));
        match found {
            Some((_, (3, values))) => Some(values.as_chunks::<3>().0.to_vec()),
            _ => None,
        }
    }
}

/// Reads a frame.
///
/// # Errors
/// If it cannot be read, with the name of the file.
pub fn read(path: &Path) -> Result<Frame, String> {
    let size = std::fs::metadata(path).map_or(0, |data| data.len());
    if size > LARGEST {
        let (found, most) = (bytes(size), bytes(LARGEST));
        return Err(format!(
            "{}: a frame of {found}; at most {most} are read",
            path.display()
        ));
    }
    let bytes = proctor_files::reading::read(path)
        .map_err(|error| format!("{}: {error}", path.display()))?;
    parse(&bytes).map_err(|reason| format!("{}: {reason}", path.display()))
}

/// Reads a frame from the bytes of a file.
///
/// # Errors
/// If it cannot be read.
pub fn parse(bytes: &[u8]) -> Result<Frame, String> {
    // Raw data is no XML: everything behind the tag of the appended section is data.
    let (xml, appended) = match find(bytes, b"<AppendedData") {
        Some(at) => (&bytes[..at], Some(&bytes[at..])),
        None => (bytes, None),
    };
    let xml = std::str::from_utf8(xml).map_err(|_| "the XML is not UTF-8".to_owned())?;
    let file = tags(xml)
        .find(|tag| tag.name == "VTKFile")
        .ok_or("no VTKFile element; accepted: a VTK XML unstructured grid (.vtu)")?;
    if file.get("type") != Some("UnstructuredGrid") {
        let found = file.get("type").unwrap_or("no type");
        return Err(format!(
            "a VTKFile of type {found}; accepted: UnstructuredGrid"
        ));
    }
    let layout = Layout {
        big_endian: file.get("byte_order") == Some("BigEndian"),
        long_header: match file.get("header_type") {
            Some("UInt64") => true,
            None | Some("UInt32") => false,
            Some(other) => return Err(format!("header_type {other}; accepted: UInt32, UInt64")),
        },
        compressed: match file.get("compressor") {
            None => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                return Err(format!(
                    "compressor {other}; accepted: vtkZLibDataCompressor or none"
                ));
            }
        },
    };
    let all: Vec<Tag<'_>> = tags(xml).collect();
    let mut offsets: Vec<usize> = all
        .iter()
        .filter_map(|tag| tag.get("offset")?.parse().ok())
        .collect();
    offsets.sort_unstable();
    let section = appended.map(appended_section).transpose()?;
    let mut frame = Frame::default();
    let mut inside = "";
    for tag in &all {
        match tag.name {
            "Points" | "PointData" | "FieldData" | "CellData" | "Cells" => inside = tag.name,
            "/Points" | "/PointData" | "/FieldData" | "/CellData" | "/Cells" => inside = "",
            "DataArray" if matches!(inside, "Points" | "PointData" | "FieldData") => {
                let name = tag.get("Name").unwrap_or("").to_owned();
                let values = values(tag, layout, section.as_ref(), &offsets)
                    .map_err(|reason| format!("array {name:?}: {reason}"))?;
                let components = tag
                    .get("NumberOfComponents")
                    .map_or(Ok(1), str::parse::<usize>)
                    .map_err(|_| format!("array {name:?}: NumberOfComponents is no number"))?;
                match inside {
                    "Points" => frame.points = values.as_chunks::<3>().0.to_vec(),
                    "PointData" => {
                        frame
                            .arrays
                            .insert(unescape(&name), (components.max(1), values));
                    }
                    _ if name == "TimeValue" => frame.time = values.first().copied(),
                    _ => {}
                }
            }
            _ => {}
        }
    }
    let points = frame.points.len();
    if let Some((name, (components, values))) = frame
        .arrays
        .iter()
        .find(|(_, (components, values))| values.len() != components * points)
    {
        return Err(format!(
            "array {name:?} has {} values of {components} components for {points} points",
            values.len()
        ));
    }
    Ok(frame)
}

/// The values of an array, wherever they are.
fn values(
    tag: &Tag<'_>,
    layout: Layout,
    section: Option<&(Encoding, &[u8])>,
    offsets: &[usize],
) -> Result<Vec<f64>, String> {
    let kind = tag.get("type").ok_or("no type")?;
    match tag.get("format") {
        None | Some("ascii") => tag
            .text
            .split_ascii_whitespace()
            .map(|word| word.parse().map_err(|_| format!("{word:?} is no number")))
            .collect(),
        Some("binary") => {
            let data = Data {
                encoding: Encoding::Base64,
                bytes: tag.text.trim().as_bytes(),
            };
            data.values(layout, kind)
        }
        Some("appended") => {
            let (encoding, bytes) = *section.ok_or("appended, but there is no AppendedData")?;
            let offset: usize = tag
                .get("offset")
                .and_then(|offset| offset.parse().ok())
                .ok_or("appended without an offset")?;
            // Base64 is decoded up to where the next array begins.
            let next = offsets.iter().copied().find(|&other| other > offset);
            let end = match encoding {
                Encoding::Base64 => next.unwrap_or(bytes.len()).min(bytes.len()),
                Encoding::Raw => bytes.len(),
            };
            let bytes = bytes
                .get(offset..end)
                .ok_or("its offset lies behind the end of the file")?;
            Data { encoding, bytes }.values(layout, kind)
        }
        Some(other) => Err(format!("format {other}; accepted: ascii, binary, appended")),
    }
}

/// Encoding and bytes of the appended section, from behind its underscore.
fn appended_section(bytes: &[u8]) -> Result<(Encoding, &[u8]), String> {
    let close = find(bytes, b">").ok_or("the tag AppendedData does not end")?;
    let tag = String::from_utf8_lossy(&bytes[..close]);
    let encoding = if tag.contains("base64") {
        Encoding::Base64
    } else {
        Encoding::Raw
    };
    let start = find(&bytes[close..], b"_").ok_or("AppendedData without an underscore")?;
    let mut data = &bytes[close + start + 1..];
    if encoding == Encoding::Base64 {
        let end = find(data, b"<").unwrap_or(data.len());
        data = data[..end].trim_ascii_end();
    }
    Ok((encoding, data))
}

fn find(bytes: &[u8], what: &[u8]) -> Option<usize> {
    bytes.windows(what.len()).position(|window| window == what)
}

fn unescape(text: &str) -> String {
    // The ampersand last, or `&amp;lt;` would be unescaped twice.
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&apos;", "'")
        .replace("&amp;", "&")
}

/// A tag and the text behind it, up to the next tag.
struct Tag<'a> {
    name: &'a str,
    attributes: &'a str,
    text: &'a str,
}

impl<'a> Tag<'a> {
    /// Value of an attribute.
    fn get(&self, name: &str) -> Option<&'a str> {
        let mut rest = self.attributes;
        loop {
            let (key, behind) = rest.split_once('=')?;
            let behind = behind.trim_start();
            let quote = behind.chars().next().filter(|c| matches!(c, '"' | '\''))?;
            let (value, after) = behind[1..].split_once(quote)?;
            if key.trim() == name {
                return Some(value);
            }
            rest = after;
        }
    }
}

/// The tags of a text, in order. Comments and declarations are tags that nobody asks for.
fn tags(xml: &str) -> impl Iterator<Item = Tag<'_>> {
    xml.split('<').skip(1).map(|piece| {
        let (inside, text) = piece.split_once('>').unwrap_or((piece, ""));
        let inside = inside.trim_end_matches('/').trim();
        let (name, attributes) = inside
            .split_once(|c: char| c.is_ascii_whitespace())
            .unwrap_or((inside, ""));
        Tag {
            name,
            attributes,
            text,
        }
    })
}
