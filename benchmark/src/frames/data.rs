//! The numbers of an array, as VTK XML files hold them in binary.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read;

/// Header of all binary arrays of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub big_endian: bool,
    /// Header of UInt64 rather than UInt32.
    pub long_header: bool,
    pub compressed: bool,
}

/// Encoding of the bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Raw,
    Base64,
}

/// The bytes of an array, header included; those of the arrays behind it may follow.
#[derive(Clone, Copy)]
pub(super) struct Data<'a> {
    pub encoding: Encoding,
    pub bytes: &'a [u8],
}

impl Data<'_> {
    /// The values as real numbers.
    pub(super) fn values(self, layout: Layout, kind: &str) -> Result<Vec<f64>, String> {
        let decoded;
        let bytes = match self.encoding {
            Encoding::Raw => self.bytes,
            Encoding::Base64 => {
                decoded = base64(self.bytes)?;
                &decoded
            }
        };
        let numbers = if layout.compressed {
            inflate(bytes, layout)?
        } else {
            let (length, rest) = header(bytes, layout)?;
            rest.get(..length).ok_or("the file is cut short")?.to_vec()
        };
        real(&numbers, kind, layout.big_endian)
    }
}

/// Header and data may be one stream or two, each with its own padding.
fn base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let clean: Vec<u8> = text
        .iter()
        .copied()
        .filter(|b| !b.is_ascii_whitespace())
        .collect();
    let mut bytes = vec![];
    let mut rest = clean.as_slice();
    while !rest.is_empty() {
        let padding = rest.iter().position(|&b| b == b'=');
        let end = padding.map_or(rest.len(), |at| at.next_multiple_of(4).min(rest.len()));
        STANDARD
            .decode_vec(&rest[..end], &mut bytes)
            .map_err(|error| format!("base64: {error}"))?;
        rest = &rest[end..];
    }
    Ok(bytes)
}

/// The next number of a header, and what follows it.
fn header(bytes: &[u8], layout: Layout) -> Result<(usize, &[u8]), String> {
    let short = "the file is cut short";
    let (number, rest) = if layout.long_header {
        let (word, rest) = bytes.split_first_chunk::<8>().ok_or(short)?;
        let number = if layout.big_endian {
            u64::from_be_bytes(*word)
        } else {
            u64::from_le_bytes(*word)
        };
        (number, rest)
    } else {
        let (word, rest) = bytes.split_first_chunk::<4>().ok_or(short)?;
        let number = if layout.big_endian {
            u32::from_be_bytes(*word)
        } else {
            u32::from_le_bytes(*word)
        };
        (u64::from(number), rest)
    };
    Ok((number as usize, rest))
}

/// Blocks of `vtkZLibDataCompressor`: number of blocks, bytes of a block, bytes of the last one if it is not full,
/// compressed bytes of each; then the blocks.
fn inflate(bytes: &[u8], layout: Layout) -> Result<Vec<u8>, String> {
    let (blocks, rest) = header(bytes, layout)?;
    let (_, rest) = header(rest, layout)?;
    let (_, mut rest) = header(rest, layout)?;
    if blocks > bytes.len() {
        return Err(format!("{blocks} blocks in {} bytes", bytes.len()));
    }
    let mut sizes = Vec::with_capacity(blocks);
    for _ in 0..blocks {
        let (size, after) = header(rest, layout)?;
        sizes.push(size);
        rest = after;
    }
    let mut numbers = vec![];
    for size in sizes {
        let block = rest.get(..size).ok_or("the file is cut short")?;
        ZlibDecoder::new(block)
            .read_to_end(&mut numbers)
            .map_err(|error| format!("zlib: {error}"))?;
        rest = &rest[size..];
    }
    Ok(numbers)
}

/// Numbers of a VTK type.
#[expect(
    clippy::cast_lossless,
    reason = "one macro for types with and without a loss"
)]
fn real(bytes: &[u8], kind: &str, big_endian: bool) -> Result<Vec<f64>, String> {
    macro_rules! of {
        ($type:ty) => {{
            let (words, rest) = bytes.as_chunks::<{ size_of::<$type>() }>();
            if !rest.is_empty() {
                return Err(format!(
                    "{} bytes are no whole number of {kind}",
                    bytes.len()
                ));
            }
            let number = |word: &[u8; size_of::<$type>()]| {
                (if big_endian {
                    <$type>::from_be_bytes(*word)
                } else {
                    <$type>::from_le_bytes(*word)
                }) as f64
            };
            Ok(words.iter().map(number).collect())
        }};
    }
    match kind {
        "Float64" => of!(f64),
        "Float32" => of!(f32),
        "Int64" => of!(i64),
        "UInt64" => of!(u64),
        "Int32" => of!(i32),
        "UInt32" => of!(u32),
        "Int16" => of!(i16),
        "UInt16" => of!(u16),
        "Int8" => of!(i8),
        "UInt8" => of!(u8),
        other => Err(format!(
            "type {other}; accepted: Float32, Float64, Int8 to Int64, UInt8 to UInt64"
        )),
    }
}
