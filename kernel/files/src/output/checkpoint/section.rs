//! The named arrays of a checkpoint.

use super::super::little_endian::LittleEndian;

/// A named array.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Name, unique in the checkpoint.
    pub name: String,
    /// The numbers.
    pub data: SectionData,
}

/// The numbers of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum SectionData {
    /// Doubles, kept bit by bit.
    F64(Vec<f64>),
    /// Unsigned integers.
    U64(Vec<u64>),
    /// Signed integers.
    I64(Vec<i64>),
    /// Bytes, such as text.
    U8(Vec<u8>),
}

/// A number that a section may hold: `f64`, `u64`, `i64` or `u8`.
#[allow(private_bounds)] // Sealed: the format has these four types.
pub trait SectionNumber: LittleEndian {
    /// Name of the type in messages.
    const NAME: &'static str;
    /// `values` as the data of a section.
    fn wrap(values: Vec<Self>) -> SectionData;
    /// The values of `data`, if they are of this type.
    fn unwrap(data: &SectionData) -> Option<&[Self]>;
}

macro_rules! number {
    ($($number:ty => $variant:ident),*) => {
        $(impl SectionNumber for $number {
            const NAME: &'static str = stringify!($number);
            fn wrap(values: Vec<Self>) -> SectionData {
                SectionData::$variant(values)
            }
            fn unwrap(data: &SectionData) -> Option<&[Self]> {
                match data {
                    SectionData::$variant(values) => Some(values),
                    _ => None,
                }
            }
        })*

        impl SectionData {
            /// Name of the type of the numbers.
            #[must_use]
            pub fn type_name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => <$number as SectionNumber>::NAME,)*
                }
            }

            /// Number of values.
            #[must_use]
            pub fn len(&self) -> usize {
                match self {
                    $(Self::$variant(values) => values.len(),)*
                }
            }

            /// True if there are no values.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }
        }
    };
}

number!(f64 => F64, u64 => U64, i64 => I64, u8 => U8);
