//! The numbers of a frame, which follow its XML in one section.

use std::io::{self, Write};

use flate2::write::ZlibEncoder;
use rayon::prelude::*;

use super::super::little_endian;
use super::{Compression, escape};

/// Bytes per zlib block. Large enough for the ratio, small enough to give every thread some.
const BLOCK: usize = 1 << 20;

/// VTK's number for a cell of one point.
const VTK_VERTEX: u8 = 1;

/// The arrays that follow the XML, in the order in which they were declared.
pub(super) struct AppendedArrays<'a> {
    compression: Compression,
    blocks: Vec<AppendedArray<'a>>,
    /// Bytes from the underscore that opens the section to where the next array starts.
    offset: usize,
}

impl<'a> AppendedArrays<'a> {
    pub(super) fn new(compression: Compression) -> Self {
        Self {
            compression,
            blocks: Vec::new(),
            offset: 0,
        }
    }

    /// Writes the XML of an array that will follow.
    pub(super) fn declare(
        &mut self,
        file: &mut dyn Write,
        name: &str,
        components: usize,
        values: Values<'a>,
    ) -> io::Result<()> {
        writeln!(
            file,
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{}\"/>",
            values.vtk_type(),
            escape(name),
            self.offset
        )?;
        // Offsets stand before the data, so compressed arrays have to be held; raw ones have a known size and
        // are converted while they are written.
        let block = match self.compression {
            Compression::None => AppendedArray::Raw(values),
            Compression::Zlib(level) => AppendedArray::Encoded(compress(&values, level)?),
        };
        self.offset += block.bytes();
        self.blocks.push(block);
        Ok(())
    }

    /// Writes the arrays that were declared.
    pub(super) fn write(&self, file: &mut dyn Write) -> io::Result<()> {
        self.blocks.iter().try_for_each(|block| block.write(file))
    }
}

/// One array of the appended section.
enum AppendedArray<'a> {
    Raw(Values<'a>),
    Encoded(Vec<u8>),
}

impl AppendedArray<'_> {
    fn bytes(&self) -> usize {
        match self {
            Self::Raw(values) => size_of::<u64>() + values.bytes(),
            Self::Encoded(bytes) => bytes.len(),
        }
    }

    fn write(&self, file: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Raw(values) => {
                file.write_all(&(values.bytes() as u64).to_le_bytes())?;
                values.write(file)
            }
            Self::Encoded(bytes) => file.write_all(bytes),
        }
    }
}

/// The numbers of one array.
pub(super) enum Values<'a> {
    Float(&'a [f64]),
    Integer(&'a [i64]),
    /// `from`, `from + step`, … (`n` of them).
    Count {
        from: usize,
        step: usize,
        n: usize,
    },
    /// The type of `n` vertex cells.
    Vertices(usize),
}

impl Values<'_> {
    fn vtk_type(&self) -> &'static str {
        match self {
            Self::Float(_) => "Float64",
            Self::Integer(_) | Self::Count { .. } => "Int64",
            Self::Vertices(_) => "UInt8",
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Float(values) => size_of_val(*values),
            Self::Integer(values) => size_of_val(*values),
            Self::Count { n, .. } => n * size_of::<i64>(),
            Self::Vertices(n) => *n,
        }
    }

    fn write(&self, file: &mut (impl Write + ?Sized)) -> io::Result<()> {
        match *self {
            Self::Float(values) => little_endian::write(values.iter().copied(), file),
            Self::Integer(values) => little_endian::write(values.iter().copied(), file),
            Self::Count { from, step, n } => {
                little_endian::write((0..n).map(|i| (from + step * i) as i64), file)
            }
            Self::Vertices(n) => little_endian::write(std::iter::repeat_n(VTK_VERTEX, n), file),
        }
    }
}

/// The array as `vtkZLibDataCompressor` lays it out: number of blocks, bytes of a block, bytes of the last block
/// if it is not full (else 0), compressed bytes of every block; then the blocks.
fn compress(values: &Values<'_>, level: u32) -> io::Result<Vec<u8>> {
    let mut raw = Vec::with_capacity(values.bytes());
    values.write(&mut raw)?;
    let blocks: Vec<Vec<u8>> = raw
        .par_chunks(BLOCK)
        .map(|chunk| {
            let mut encoder =
                ZlibEncoder::new(Vec::new(), flate2::Compression::new(level.clamp(1, 9)));
            encoder.write_all(chunk)?;
            encoder.finish()
        })
        .collect::<io::Result<_>>()?;
    let mut bytes = Vec::new();
    let sizes = blocks.iter().map(|block| block.len() as u64);
    let table = [
        blocks.len() as u64,
        BLOCK as u64,
        (raw.len() % BLOCK) as u64,
    ];
    little_endian::write(table.into_iter().chain(sizes), &mut bytes)?;
    bytes.extend(blocks.concat());
    Ok(bytes)
}
