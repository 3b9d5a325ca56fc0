//! Numbers in messages.

use std::fmt;

/// A number as people write it: with an exponent where it would otherwise be a row of zeros.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(x) = *self;
        if x == 0.0 || !x.is_finite() || (1e-5..1e16).contains(&x.abs()) {
            write!(f, "{x}")
        } else {
            write!(f, "{x:e}")
        }
    }
}

/// `[a, b]` or `[a, b, c]`.
#[must_use]
pub fn list(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(|x| Number(*x).to_string()).collect();
    format!("[{}]", words.join(", "))
}

/// Hash of words, by which large values differ without printing them.
#[must_use]
pub fn fingerprint(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| {
        let hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^ (hash >> 32)
    })
}

/// Hash of corners and triangles.
#[must_use]
pub fn fingerprint_of(corners: &[[f64; 3]], triangles: &[[u32; 3]]) -> u64 {
    let corners = corners.iter().flatten().map(|x| x.to_bits());
    fingerprint(corners.chain(triangles.iter().flatten().map(|v| u64::from(*v))))
}

#[cfg(test)]
mod tests {
    use super::{Number, list};

    #[test]
    fn the_smallest_number_is_no_row_of_three_hundred_zeros() {
        assert_eq!(Number(5e-324).to_string(), "5e-324");
        assert_eq!(Number(-1e308).to_string(), "-1e308");
        assert_eq!(list(&[0.0, 1.0, 0.25]), "[0, 1, 0.25]");
        assert_eq!(Number(f64::NAN).to_string(), "NaN");
    }
}
