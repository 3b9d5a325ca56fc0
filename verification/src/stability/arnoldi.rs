//! The largest eigenvalue of a linear map that is known by its action alone (Arnoldi 1951).

use nalgebra::{DMatrix, DVector};

use super::StabilityError;
use crate::random::mixed;

/// Vectors after which the eigenvalue is looked at again.
const LOOK_EVERY: usize = 4;
/// Relative change between two looks below which it stands.
const STANDS: f64 = 2e-5;

/// An eigenvalue with its vector.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The eigenvalue.
    pub value: f64,
    /// Its vector, of length 1.
    pub vector: Vec<f64>,
}

/// The real eigenvalue that is largest, of a map of vectors with `size` values; at most `most` vectors are kept. `None` where
/// the map gives zero.
///
/// # Errors
/// The map's own, and [`StabilityError::NoConvergence`].
pub fn largest(
    size: usize,
    most: usize,
    mut map: impl FnMut(&[f64]) -> Result<Vec<f64>, StabilityError>,
) -> Result<Option<Pair>, StabilityError> {
    let most = most.min(size);
    let mut basis: Vec<Vec<f64>> = vec![noise(size)];
    let mut h = DMatrix::<f64>::zeros(most + 1, most);
    let mut before = 0.0_f64;
    for k in 0..most {
        let mut next = map(&basis[k])?;
        // Twice, or round-off lets the vectors lean on each other.
        for _ in 0..2 {
            for (i, q) in basis.iter().enumerate() {
                let share = dot(q, &next);
                h[(i, k)] += share;
                for (slot, q) in next.iter_mut().zip(q) {
                    *slot -= share * q;
                }
            }
        }
        let rest = dot(&next, &next).sqrt();
        h[(k + 1, k)] = rest;
        let scale = h.view((0, 0), (k + 1, k + 1)).amax();
        let closed = rest <= 1e-12 * scale;
        if closed && scale < 1e-300 {
            return Ok(None);
        }
        if closed || k + 1 == most || (k + 1) % LOOK_EVERY == 0 {
            let square = h.view((0, 0), (k + 1, k + 1)).into_owned();
            let value = largest_real(&square);
            let change = (value - before).abs() / value.abs().max(f64::MIN_POSITIVE);
            if closed || change <= STANDS {
                return Ok(Some(pair(&square, value, &basis)));
            }
            if k + 1 == most {
                return if most == size {
                    Ok(Some(pair(&square, value, &basis)))
                } else {
                    Err(StabilityError::NoConvergence {
                        what: "the largest eigenvalue",
                        residual: change,
                    })
                };
            }
            before = value;
        }
        basis.push(next.iter().map(|x| x / rest).collect());
    }
    Ok(None)
}

/// The largest of the eigenvalues that are real, but for round-off.
fn largest_real(square: &DMatrix<f64>) -> f64 {
    let values = square.complex_eigenvalues();
    let scale = values
        .iter()
        .map(|value| value.re.abs())
        .fold(0.0, f64::max);
    values
        .iter()
        .filter(|value| value.im.abs() <= 1e-6 * scale)
        .map(|value| value.re)
        .fold(0.0, f64::max)
}

/// The vector by a step of inverse iteration on the small matrix.
fn pair(square: &DMatrix<f64>, value: f64, basis: &[Vec<f64>]) -> Pair {
    let n = square.nrows();
    // Off the eigenvalue by a little, so that the system can be solved.
    let shifted = square - DMatrix::identity(n, n) * (value * (1.0 + 1e-9));
    let lu = shifted.lu();
    let mut y = DVector::from_element(n, 1.0);
    for _ in 0..3 {
        if let Some(next) = lu.solve(&y) {
            let length = next.norm();
            if length.is_finite() && length > 0.0 {
                y = next / length;
            }
        }
    }
    let mut vector = vec![0.0; basis[0].len()];
    for (q, share) in basis.iter().zip(&y) {
        for (slot, q) in vector.iter_mut().zip(q) {
            *slot += share * q;
        }
    }
    Pair { value, vector }
}

/// The product of two vectors.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A vector of length 1 that is the same every time and leans on no eigenvector.
fn noise(size: usize) -> Vec<f64> {
    let mut values: Vec<f64> = (0..size as u64).map(uniform).collect();
    let length = dot(&values, &values).sqrt();
    for value in &mut values {
        *value /= length;
    }
    values
}

/// A number from -1 to 1 that belongs to `seed` (splitmix64).
#[must_use]
pub fn uniform(seed: u64) -> f64 {
    let word = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed(word) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
