//! Numbers to little-endian bytes and back, in bulk.

use std::io::{self, Write};

/// A number that is stored as its little-endian bytes.
pub(super) trait LittleEndian: Copy {
    /// Bytes per value.
    const SIZE: usize;
    /// Appends the bytes of `self`.
    fn put(self, bytes: &mut Vec<u8>);
    /// The value of `bytes`, which are `SIZE` long.
    fn get(bytes: &[u8]) -> Self;
}

macro_rules! little_endian {
    ($($number:ty),*) => {$(
        impl LittleEndian for $number {
            const SIZE: usize = size_of::<$number>();
            #[inline]
            fn put(self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_le_bytes());
            }
            #[inline]
            fn get(bytes: &[u8]) -> Self {
                let mut array = [0; size_of::<$number>()];
                array.copy_from_slice(bytes);
                Self::from_le_bytes(array)
            }
        }
    )*};
}

little_endian!(f64, u64, i64, u32, u8);

/// Values converted at a time: 64 KiB of doubles stay in the second-level cache.
const CHUNK: usize = 8192;

/// Hands the bytes of `values` to `sink`, a chunk at a time.
pub(super) fn write<T: LittleEndian>(
    values: impl IntoIterator<Item = T>,
    sink: &mut (impl Write + ?Sized),
) -> io::Result<()> {
    let mut bytes = Vec::with_capacity(CHUNK * T::SIZE);
    let mut values = values.into_iter();
    loop {
        bytes.clear();
        values
            .by_ref()
            .take(CHUNK)
            .for_each(|value| value.put(&mut bytes));
        if bytes.is_empty() {
            return Ok(());
        }
        sink.write_all(&bytes)?;
    }
}

/// The values of `bytes`; a remainder shorter than one value is ignored.
pub(super) fn read<T: LittleEndian>(bytes: &[u8]) -> Vec<T> {
    bytes.chunks_exact(T::SIZE).map(T::get).collect()
}
